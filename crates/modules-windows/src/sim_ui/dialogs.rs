//! `simUI.*`: dialogs, banners, keyboard and clipboard. A dialog is answered as a test has left it, else by a person at a page of the viewer,
//! else at once by its default button.

use api_macro::api;

use super::arguments::Texts;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::Data;
use script::Table;
use script::log::verbosity;
use ui::{Banner, DialogKind, Question, QuestionDetails};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    msg_box,
    sim_msg_box,
    sim_file_dialog,
    file_dialog,
    color_dialog,
    input_dialog,
    banner_create,
    banner_destroy,
    get_keyboard_modifiers,
    set_clipboard_text,
    qt_version,
];

/// simUI.msgbox_result, in the order of their numbers.
const RESULTS: [&str; 4] = ["cancel", "no", "yes", "ok"];
const OK: i64 = 3;
/// By simUI.msgbox_buttons: the default answer, and those there are.
const BUTTONS: [(i64, &[i64]); 4] = [(3, &[3]), (1, &[2, 1]), (0, &[2, 1, 0]), (0, &[3, 0])];

/// The answer that was left for a dialog, if there is one.
fn left_answer(cx: &mut Cx, kind: DialogKind) -> Option<Data> {
    cx.change_ui(|ui| ui.dialogs.take_answer(kind))
}

/// The answer that was left for a dialog, else that of a person.
fn answer(cx: &mut Cx, title: &str, text: &str, details: QuestionDetails) -> Option<Data> {
    let question = Question {
        title: title.to_owned(),
        text: text.to_owned(),
        details,
    };
    left_answer(cx, question.kind()).or_else(|| cx.ask_person(&question))
}

/// Notes a dialog for pages and tests.
fn note_silently(cx: &mut Cx, kind: DialogKind, title: &str, text: &str, answer: &str) {
    cx.change_ui(|ui| {
        ui.dialogs.note(kind, title, text, answer.to_owned());
        ui.touch();
    });
}

/// Notes a dialog for pages and tests, and logs it.
fn note(cx: &mut Cx, kind: DialogKind, title: &str, text: &str, answer: &str) {
    note_silently(cx, kind, title, text, answer);
    cx.env().log(
        verbosity::SCRIPT_INFOS,
        &format!("{} '{title}': {text} (answer: {answer})", kind.name()),
    );
}

/// Shows a message and waits for a button. Without a person at a page of the viewer, the answer is the default one: ok; no; cancel; cancel. The message goes to the log.
///
/// @param type simUI.msgbox_type
/// @param buttons simUI.msgbox_buttons
/// @param title
/// @param message
/// @return result simUI.msgbox_result
#[api("simUI.msgBox")]
fn msg_box(cx: &mut Cx, r#type: i64, buttons: i64, title: String, message: String) -> Result<i64> {
    let place = usize::try_from(buttons).ok();
    let (default, possible) = place
        .and_then(|place| BUTTONS.get(place))
        .copied()
        .unwrap_or(BUTTONS[0]);
    let result = pressed_button(cx, r#type, (default, possible), &title, &message)?;
    note(
        cx,
        DialogKind::Message,
        &title,
        &message,
        RESULTS[result as usize],
    );
    Ok(result)
}

/// The button that was left as the answer to a message, else that a person presses, else the default one.
fn pressed_button(
    cx: &mut Cx,
    level: i64,
    (default, possible): (i64, &[i64]),
    title: &str,
    text: &str,
) -> Result<i64> {
    if let Some(answer) = left_answer(cx, DialogKind::Message) {
        return button_of(&answer, possible);
    }
    let buttons = possible
        .iter()
        .map(|number| RESULTS[*number as usize])
        .collect();
    let details = QuestionDetails::Message {
        buttons,
        default_button: RESULTS[default as usize],
        level,
    };
    let question = Question {
        title: title.to_owned(),
        text: text.to_owned(),
        details,
    };
    Ok(cx
        .ask_person(&question)
        .and_then(|answer| button_of(&answer, possible).ok())
        .unwrap_or(default))
}

/// The message of `sim.msgBox`: without a person the answer is ok, and nothing is logged.
///
/// @param type sim.msgbox_type_*
/// @param buttons sim.msgbox_buttons_*
/// @param title
/// @param message
/// @return result sim.msgbox_return_*
#[api("simUI._simMsgBox")]
fn sim_msg_box(
    cx: &mut Cx,
    r#type: i64,
    buttons: i64,
    title: String,
    message: String,
) -> Result<i64> {
    let (_, possible) = usize::try_from(buttons)
        .ok()
        .and_then(|at| BUTTONS.get(at))
        .copied()
        .unwrap_or(BUTTONS[0]);
    let result = pressed_button(cx, r#type, (OK, possible), &title, &message)?;
    note_silently(
        cx,
        DialogKind::Message,
        &title,
        &message,
        RESULTS[result as usize],
    );
    Ok(result)
}

/// The button an answer means.
fn button_of(answer: &Data, possible: &[i64]) -> Result<i64> {
    let result = match answer {
        Data::Int(number) => Some(*number),
        Data::Text(name) => (0..)
            .zip(RESULTS)
            .find(|(_, known)| known.as_bytes() == name)
            .map(|(number, _)| number),
        _ => None,
    };
    result
        .filter(|result| possible.contains(result))
        .ok_or_else(|| {
            let names: Vec<&str> = possible
                .iter()
                .map(|number| RESULTS[*number as usize])
                .collect();
            ApiError::Other(format!(
                "the answer left for msgBox is none of its buttons: {}",
                names.join(", ")
            ))
        })
}

/// The files that were left as the answer to a dialog, else those that a person names.
fn chosen_files(cx: &mut Cx, title: &str, details: QuestionDetails) -> Vec<String> {
    let text = |data: &Data| match data {
        Data::Text(bytes) => Some(String::from_utf8_lossy(bytes).into_owned()),
        _ => None,
    };
    match answer(cx, title, "", details) {
        Some(Data::Array(paths)) => paths.iter().filter_map(text).collect(),
        Some(path) => text(&path).into_iter().collect(),
        None => Vec::new(),
    }
}

/// The files of `sim.fileDialog`; nothing is logged.
///
/// @param title
/// @return result paths; empty if cancelled
#[api("simUI._simFileDialog")]
fn sim_file_dialog(cx: &mut Cx, title: String) -> Result<Vec<String>> {
    let files = chosen_files(cx, &title, QuestionDetails::any_file());
    note_silently(cx, DialogKind::File, &title, "", &files.join(", "));
    Ok(files)
}

/// Asks for files. Without a person at a page of the viewer: none.
///
/// @param type simUI.filedialog_type
/// @param title
/// @param startPath the folder to begin with
/// @param initName the name to begin with
/// @param extName what the extensions are called
/// @param ext extensions without dots, with semicolons between them
/// @param native without effect
/// @return result paths; empty if cancelled
#[api("simUI.fileDialog")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn file_dialog(
    cx: &mut Cx,
    r#type: i64,
    title: String,
    start_path: String,
    init_name: String,
    ext_name: String,
    ext: String,
    #[default(false)] native: bool,
) -> Result<Vec<String>> {
    let _ = native;
    let asked = [start_path.as_str(), &init_name, &ext].join(" ");
    let details = QuestionDetails::Files {
        selects: r#type,
        start_path,
        initial_name: init_name,
        extension_name: ext_name,
        extensions: ext,
    };
    let files = chosen_files(cx, &title, details);
    note(
        cx,
        DialogKind::File,
        &title,
        asked.trim(),
        &files.join(", "),
    );
    Ok(files)
}

/// Asks for a colour. Without a person at a page of the viewer: none.
///
/// @param initColor the colour to begin with: red, green, blue, and maybe opacity, 0 to 1; white without it
/// @param title
/// @param showAlphaChannel whether opacity can be chosen
/// @param native without effect
/// @return result red, green, blue, and opacity if it could be chosen, 0 to 1; nil if cancelled
#[api("simUI.colorDialog")]
fn color_dialog(
    cx: &mut Cx,
    init_color: Option<Vec<f64>>,
    #[default("Select color")] title: String,
    #[default(false)] show_alpha_channel: bool,
    #[default(true)] native: bool,
) -> Result<Data> {
    let _ = native;
    if init_color
        .as_ref()
        .is_some_and(|color| !(3..=4).contains(&color.len()))
    {
        return Err(ApiError::Other(
            "read in arg 1 (initColor): must have 3 to 4 elements".into(),
        ));
    }
    let parts = if show_alpha_channel { 4 } else { 3 };
    let initial = init_color.unwrap_or_else(|| vec![1.0; 3]);
    let details = QuestionDetails::Color {
        initial,
        alpha: show_alpha_channel,
    };
    let color = match answer(cx, &title, "", details) {
        Some(Data::Array(mut color)) => {
            color.resize(parts, Data::Float(1.0));
            Data::Array(color)
        }
        _ => Data::Nil,
    };
    let shown = if color == Data::Nil { "cancel" } else { "ok" };
    note(cx, DialogKind::Color, &title, "", shown);
    Ok(color)
}

/// Asks for a text. Without a person at a page of the viewer: none.
///
/// @param initValue the text to begin with
/// @param label what it is
/// @param title
/// @return result nil if cancelled
#[api("simUI.inputDialog")]
fn input_dialog(
    cx: &mut Cx,
    #[default("")] init_value: String,
    #[default("Input value:")] label: String,
    #[default("")] title: String,
) -> Result<Data> {
    let entry = match answer(
        cx,
        &title,
        &label,
        QuestionDetails::Text {
            initial: init_value,
        },
    ) {
        Some(Data::Text(entry)) => Some(entry),
        Some(Data::Int(number)) => Some(number.to_string().into_bytes()),
        Some(Data::Float(number)) => Some(number.to_string().into_bytes()),
        _ => None,
    };
    let shown = entry.as_ref().map_or("cancel".into(), |entry| {
        String::from_utf8_lossy(entry).into_owned()
    });
    note(cx, DialogKind::Input, &title, &label, &shown);
    Ok(entry.map_or(Data::Nil, Data::Text))
}

/// Shows a line of text with buttons above all windows.
///
/// @param text
/// @param btnKeys what the callback gets; a single close without them
/// @param btnLabels what is written on the buttons; the keys without them
/// @param callback the name of a function, called with the banner and the key; without one any button removes the banner
/// @return id
#[api("simUI.bannerCreate")]
fn banner_create(
    cx: &mut Cx,
    text: String,
    btn_keys: Option<Texts>,
    btn_labels: Option<Texts>,
    callback: Option<String>,
) -> Result<i64> {
    let keys = btn_keys.map_or_else(|| vec!["close".to_owned()], |keys| keys.0);
    let labels = btn_labels.map_or_else(|| keys.clone(), |labels| labels.0);
    if labels.len() != keys.len() {
        return Err(ApiError::Other(
            "btnKeys and btnLabels must have the same number of elements".into(),
        ));
    }
    let buttons = keys
        .into_iter()
        .zip(labels)
        .map(|(key, label)| [key, label])
        .collect();
    let banner = Banner {
        id: 0,
        text,
        buttons,
        callback: callback.unwrap_or_default(),
        owner: cx.script().id,
    };
    let id = cx.change_ui(|ui| {
        ui.touch();
        ui.dialogs.add_banner(banner)
    });
    cx.own_banner(id);
    Ok(id)
}

/// Removes a banner.
///
/// @param id of simUI.bannerCreate
#[api("simUI.bannerDestroy")]
fn banner_destroy(cx: &mut Cx, id: i64) -> Result<()> {
    let removed = cx.change_ui(|ui| {
        ui.touch();
        ui.dialogs.remove_banner(id)
    });
    if removed {
        Ok(())
    } else {
        Err(ApiError::Other("invalid id".into()))
    }
}

/// The keys that are held down: those of the last input of a page or test.
///
/// @return m shift, control, alt
#[api("simUI.getKeyboardModifiers")]
fn get_keyboard_modifiers(cx: &Cx) -> Result<Table> {
    Ok(Table(cx.read_ui(|ui| ui.modifiers.data())))
}

/// Keeps a text, as the clipboard of a desktop would.
///
/// @param text
#[api("simUI.setClipboardText")]
fn set_clipboard_text(cx: &mut Cx, text: String) -> Result<()> {
    cx.change_ui(|ui| ui.clipboard = text);
    Ok(())
}

/// The version of Qt that CoppeliaSim is built with. There is no Qt here.
///
/// @return version 5, 15, 2
#[api("simUI.qtVersion")]
fn qt_version(_cx: &Cx) -> Result<Vec<i64>> {
    Ok(vec![5, 15, 2])
}
