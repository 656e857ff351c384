//! `sim.*`: auxiliary consoles, messages of the user interface, semaphores.
//!
//! There are no windows: the text of a console goes to the log at a high verbosity, and there is no input.

use api_macro::api;

use crate::api::files::semaphores;
use crate::api::{ApiFn, Cx, Result, functions};
use crate::scene::Data;
use crate::script::log::verbosity;
use crate::script::{AuxiliaryConsole, Bytes, Number};

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

/// Opens a console. What is printed to it goes to the log under its title, at the level infos: `--verbosity infos` shows it.
///
/// @param title of the window
/// @param maxLines the window's, without effect
/// @param mode 1: it closes at the end of the simulation; other bits are the window's
/// @param position the window's, without effect
/// @param size the window's, without effect
/// @param textColor the window's, without effect
/// @param backgroundColor the window's, without effect
/// @return consoleHandle
#[api("sim.auxiliaryConsoleOpen")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn auxiliary_console_open(
    cx: &mut Cx,
    title: String,
    #[default(0)] _max_lines: Number,
    #[default(0)] mode: Number,
    #[default(None)] _position: Option<[f64; 2]>,
    #[default(None)] _size: Option<[f64; 2]>,
    #[default(None)] _text_color: Option<[f64; 3]>,
    #[default(None)] _background_color: Option<[f64; 3]>,
) -> Result<i64> {
    let console = AuxiliaryConsole { title, closes_at_end: mode.0 & CLOSES_AT_END != 0 };
    Ok(cx.app_mut().consoles.open(console))
}

/// Prints to a console.
///
/// @param consoleHandle from sim.auxiliaryConsoleOpen
/// @param text nil to clear the window
/// @return result 1, or 0 if there is no such console
#[api("sim.auxiliaryConsolePrint")]
fn auxiliary_console_print(cx: &Cx, console_handle: i64, #[default(None)] text: Option<Bytes>) -> Result<i64> {
    let Some(title) = cx.app().consoles.title(console_handle) else { return Ok(0) };
    if let Some(Bytes(text)) = text {
        let text = String::from_utf8_lossy(&text);
        cx.env().log(verbosity::INFOS, &format!("{title}: {}", text.trim_end_matches('\n')));
    }
    Ok(1)
}

/// Shows or hides a console, which has no effect here.
///
/// @param consoleHandle from sim.auxiliaryConsoleOpen
/// @param showState true to show it
/// @return result 1, or 0 if there is no such console
#[api("sim.auxiliaryConsoleShow")]
fn auxiliary_console_show(cx: &Cx, console_handle: Number, _show_state: bool) -> Result<i64> {
    Ok(i64::from(cx.app().consoles.title(console_handle.0).is_some()))
}

/// Closes a console.
///
/// @param consoleHandle from sim.auxiliaryConsoleOpen
/// @return result 1, or 0 if there is no such console
#[api("sim.auxiliaryConsoleClose")]
fn auxiliary_console_close(cx: &mut Cx, console_handle: Number) -> Result<i64> {
    Ok(i64::from(cx.app_mut().consoles.close(console_handle.0)))
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
