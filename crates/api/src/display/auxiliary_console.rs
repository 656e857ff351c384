//! `sim.*`: auxiliary consoles, messages of the user interface, semaphores.
//!
//! The text of a console goes to a window that pages show, and to the log at a high verbosity. There is no input.

use api_macro::api;

use crate::files::semaphores;
use crate::{ApiFn, Cx, Result, functions};
use scene::Data;
use scene::numbers;
use script::log::verbosity;
use script::{AuxiliaryConsole, Bytes, Number};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    auxiliary_console_open,
    auxiliary_console_print,
    auxiliary_console_show,
    auxiliary_console_close,
    get_simulator_message,
    system_semaphore,
];

/// Bit of the mode of a console: it closes at the end of the simulation.
const CLOSES_AT_END: i64 = 1;

/// Opens a console. Pages show it; what is printed to it goes to the log too, under its title, at the level infos: `--verbosity infos` shows it.
///
/// @param title of the window
/// @param maxLines how many lines stay
/// @param mode 1: it closes at the end of the simulation; other bits have no effect
/// @param position of the window, pixels
/// @param size of the window, pixels
/// @param textColor the window's, without effect
/// @param backgroundColor the window's, without effect
/// @return consoleHandle
#[api("sim.auxiliaryConsoleOpen")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn auxiliary_console_open(
    cx: &mut Cx,
    title: String,
    #[default(0)] max_lines: Number,
    #[default(0)] mode: Number,
    #[default(None)] position: Option<[f64; 2]>,
    #[default(None)] size: Option<[f64; 2]>,
    #[default(None)] _text_color: Option<[f64; 3]>,
    #[default(None)] _background_color: Option<[f64; 3]>,
) -> Result<i64> {
    let pixels = |pair: Option<[f64; 2]>| pair.map(|pair| pair.map(numbers::truncated));
    let window = cx.change_ui(|ui| ui.open_console(&title, pixels(position), pixels(size)));
    let lines = usize::try_from(max_lines.0).unwrap_or(0);
    let console = AuxiliaryConsole {
        title,
        closes_at_end: mode.0 & CLOSES_AT_END != 0,
        lines,
        window,
    };
    Ok(cx.app_mut().consoles.open(console))
}

/// Prints to a console.
///
/// @param consoleHandle from sim.auxiliaryConsoleOpen
/// @param text nil to clear the window
/// @return result 1, or 0 if there is no such console
#[api("sim.auxiliaryConsolePrint")]
fn auxiliary_console_print(
    cx: &mut Cx,
    console_handle: i64,
    #[default(None)] text: Option<Bytes>,
) -> Result<i64> {
    let Some(console) = cx.app().consoles.get(console_handle).cloned() else {
        return Ok(0);
    };
    let text = text.map(|Bytes(text)| String::from_utf8_lossy(&text).into_owned());
    cx.change_ui(|ui| ui.print_to_console(&console.window, text.as_deref(), console.lines))?;
    if let Some(text) = text {
        let title = console.title;
        cx.env().log(
            verbosity::INFOS,
            &format!("{title}: {}", text.trim_end_matches('\n')),
        );
    }
    Ok(1)
}

/// Shows or hides a console.
///
/// @param consoleHandle from sim.auxiliaryConsoleOpen
/// @param showState true to show it
/// @return result 0, as in the original without a display
#[api("sim.auxiliaryConsoleShow")]
fn auxiliary_console_show(cx: &mut Cx, console_handle: Number, show_state: bool) -> Result<i64> {
    let window = cx
        .app()
        .consoles
        .get(console_handle.0)
        .map(|console| console.window.clone());
    if let Some(window) = window {
        cx.change_ui(|ui| ui.set_visible(&window, show_state))?;
    }
    Ok(0)
}

/// Closes a console.
///
/// @param consoleHandle from sim.auxiliaryConsoleOpen
/// @return result 0, as in the original without a display
#[api("sim.auxiliaryConsoleClose")]
fn auxiliary_console_close(cx: &mut Cx, console_handle: Number) -> Result<i64> {
    let closed = cx.app_mut().consoles.close(console_handle.0);
    if let Some(console) = closed {
        cx.change_ui(|ui| ui.destroy(&console.window))?;
    }
    Ok(0)
}

/// The next message of the user interface. There is none without a window.
///
/// @return messageID -1: nothing
/// @return auxiliaryData four zeros
/// @return auxiliaryData2 empty
#[api("sim.getSimulatorMessage")]
fn get_simulator_message(_cx: &Cx) -> Result<(i64, Vec<i64>, Data)> {
    Ok((-1, vec![0; 4], Data::Array(Vec::new())))
}

/// Acquires or releases a semaphore shared by all programs on the machine. Acquiring waits until it is free.
///
/// @param key its name
/// @param acquire true to acquire it, false to release it
#[api("sim.systemSemaphore")]
fn system_semaphore(cx: &mut Cx, key: Bytes, acquire: bool) -> Result<()> {
    if acquire {
        return semaphores::acquire(cx, &key.0);
    }
    semaphores::release(cx, &key.0);
    Ok(())
}
