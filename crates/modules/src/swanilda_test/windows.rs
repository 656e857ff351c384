//! Windows of scripts in tests: what a person would do with them, and answers to dialogs.

use api_macro::api;

use super::{bench, button_interfaces};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use modules_windows::sim_qml;
use scene::Data;
use ui::{DialogKind, Input, InputValue};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    window,
    widget,
    widget_state,
    window_input,
    close_window,
    answer,
    dialogs
];

fn refused(reason: String) -> ApiError {
    ApiError::Other(reason)
}

/// The window of that title.
///
/// @param title
/// @return handle
#[api("swanilda.test.window")]
fn window(cx: &Cx, title: String) -> Result<String> {
    bench(cx)?;
    sim_qml::catch_up(cx);
    let found = cx.read_ui(|ui| ui.find_window(&title));
    found.or_else(|reason| button_interfaces::find(cx, &title).ok_or(refused(reason)))
}

/// The widget of that name, text, label or handler.
///
/// @param handle the window
/// @param name
/// @return id
#[api("swanilda.test.widget")]
fn widget(cx: &Cx, handle: String, name: String) -> Result<i64> {
    bench(cx)?;
    if let Some(interface) = button_interfaces::handle(&handle) {
        return button_interfaces::button(&cx.scene(), interface, &name).map_err(refused);
    }
    if sim_qml::is_interface(cx, &handle) {
        return sim_qml::find(cx, &handle, &name).map_err(refused);
    }
    cx.read_window(&handle, |window| Ok(window.find_widget(&name)))?
        .map_err(refused)
}

/// What a person sees of a widget.
///
/// @param handle the window
/// @param id the widget
/// @return state value, kind, enabled, visible
#[api("swanilda.test.widgetState")]
fn widget_state(cx: &Cx, handle: String, id: i64) -> Result<Data> {
    bench(cx)?;
    if let Some(interface) = button_interfaces::handle(&handle) {
        return button_interfaces::state(&cx.scene(), interface, id).map_err(refused);
    }
    if sim_qml::is_interface(cx, &handle) {
        return sim_qml::state(cx, &handle, id).map_err(refused);
    }
    cx.read_window(&handle, |window| {
        let widget = window.widget(id)?;
        Ok(Data::map([
            ("value", window.value(id).unwrap_or(Data::Nil)),
            ("kind", Data::text(widget.kind.tag())),
            ("enabled", Data::Bool(widget.enabled)),
            ("visible", Data::Bool(window.is_widget_visible(id))),
        ]))
    })
}

/// What a person does with a widget; handlers run at once.
///
/// @param handle the window
/// @param id the widget
/// @param action click, value, finish, select, cell, link, key
/// @param first what belongs to it
/// @param second what belongs to it
/// @param third what belongs to it
#[api("swanilda.test.windowInput")]
fn window_input(
    cx: &mut Cx,
    handle: String,
    id: i64,
    action: String,
    #[default(Data::Nil)] first: Data,
    #[default(Data::Nil)] second: Data,
    #[default(Data::Nil)] third: Data,
) -> Result<()> {
    bench(cx)?;
    if let Some(interface) = button_interfaces::handle(&handle) {
        return button_interfaces::input(cx, interface, id, &action, &first).map_err(refused);
    }
    if sim_qml::is_interface(cx, &handle) {
        let acted = sim_qml::act(cx, &handle, id, &action, [first, second]);
        return acted.map_err(refused);
    }
    let input = input_of(&action, first, second, third)
        .ok_or_else(|| refused(format!("'{action}' does not go with these arguments.")))?;
    cx.change_ui(|ui| ui.widget_input(&handle, id, input))
        .map_err(refused)?;
    cx.deliver_ui_events();
    Ok(())
}

fn input_of(action: &str, first: Data, second: Data, third: Data) -> Option<Input> {
    let int = |data: &Data| data.as_f64().map(|number| number as i64);
    let text = |data: &Data| match InputValue::from(data.clone()) {
        InputValue::Text(text) => Some(text),
        _ => None,
    };
    Some(match action {
        "click" => Input::Click,
        "value" if first != Data::Nil => Input::Value(first.into()),
        "finish" => Input::Finish,
        "select" => match int(&second) {
            Some(column) => Input::SelectCell([int(&first)?, column]),
            None => Input::Select(int(&first)?),
        },
        "cell" => Input::Cell([int(&first)?, int(&second)?], text(&third)),
        "link" => Input::Link(text(&first)?),
        "key" => Input::Key {
            key: int(&first)?,
            text: text(&second).unwrap_or_default(),
            modifiers: Default::default(),
        },
        _ => return None,
    })
}

/// The close button of a window.
///
/// @param handle the window
#[api("swanilda.test.closeWindow")]
fn close_window(cx: &mut Cx, handle: String) -> Result<()> {
    bench(cx)?;
    cx.change_ui(|ui| ui.close(&handle, false))
        .map_err(refused)?;
    if sim_qml::is_interface(cx, &handle) {
        sim_qml::close(cx, &handle).map_err(refused)?;
    }
    cx.deliver_ui_events();
    Ok(())
}

/// Leaves an answer for the next dialog of a kind.
///
/// @param kind msgBox, fileDialog, colorDialog, inputDialog
/// @param value what is answered
#[api("swanilda.test.answer")]
fn answer(cx: &mut Cx, kind: String, value: Data) -> Result<()> {
    bench(cx)?;
    let known = DialogKind::named(&kind).ok_or_else(|| {
        refused(format!("there is no dialog '{kind}': it is one of msgBox, fileDialog, colorDialog, inputDialog."))
    })?;
    cx.change_ui(|ui| ui.dialogs.leave_answer(known, value))
        .map_err(refused)
}

/// The dialogs that were shown, the oldest first.
///
/// @return dialogs each with kind, title, text, answer
#[api("swanilda.test.dialogs")]
fn dialogs(cx: &Cx) -> Result<Data> {
    bench(cx)?;
    let shown = cx.read_ui(|ui| {
        let data = ui.dialogs.shown().map(|dialog| {
            Data::map([
                ("kind", Data::text(dialog.kind.name())),
                ("title", Data::text(&dialog.title)),
                ("text", Data::text(&dialog.text)),
                ("answer", Data::text(&dialog.answer)),
            ])
        });
        data.collect()
    });
    Ok(Data::Array(shown))
}
