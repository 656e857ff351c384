//! User interfaces of V-REP in tests, as `t.ui` finds windows.

use crate::Cx;
use scene::tree::button_interfaces::{Button, ButtonInput, ButtonKind, button_property};
use scene::{Data, Scene};

const PREFIX: &str = "2DElement-";

/// What tests call the user interface of that name.
pub(super) fn find(cx: &Cx, name: &str) -> Option<String> {
    cx.scene()
        .button_interfaces()
        .named(name)
        .map(|handle| format!("{PREFIX}{handle}"))
}

/// The handle of the user interface that tests call so; None for a window of simUI.
pub(super) fn handle(window: &str) -> Option<i64> {
    window.strip_prefix(PREFIX)?.parse().ok()
}

/// A button by its text or its number.
pub(super) fn button(scene: &Scene, handle: i64, name: &str) -> Result<i64, String> {
    let interface = scene
        .button_interfaces()
        .get(handle)
        .map_err(|error| error.to_string())?;
    let is_named = |button: &&Button| button.label == name || button.number.to_string() == name;
    let found = interface
        .buttons
        .iter()
        .find(is_named)
        .map(|button| i64::from(button.number));
    let described = |button: &Button| format!("{} '{}'", button.number, button.label);
    found.ok_or_else(|| {
        let all: Vec<String> = interface.buttons.iter().map(described).collect();
        format!(
            "'{}' has no button '{name}'; it has: {}.",
            interface.name,
            all.join(", ")
        )
    })
}

/// What a person sees of a button.
pub(super) fn state(scene: &Scene, handle: i64, number: i64) -> Result<Data, String> {
    let interface = scene
        .button_interfaces()
        .get(handle)
        .map_err(|error| error.to_string())?;
    let button = interface
        .button(number)
        .map_err(|error| error.to_string())?;
    let (kind, value) = match button.kind() {
        ButtonKind::Button => ("button", Data::Bool(button.has(button_property::IS_DOWN))),
        ButtonKind::Label => ("label", Data::text(&button.label)),
        ButtonKind::Slider => ("slider", Data::Int(button.slider_position().unwrap_or(0))),
        ButtonKind::EditBox => ("edit", Data::text(&button.label)),
    };
    Ok(Data::map([
        ("value", value),
        ("kind", Data::text(kind)),
        ("enabled", Data::Bool(button.has(button_property::ENABLED))),
        (
            "visible",
            Data::Bool(scene.shows_button_interface(interface)),
        ),
    ]))
}

/// Does what a person does; scripts see it in the next step.
pub(super) fn input(
    cx: &mut Cx,
    handle: i64,
    number: i64,
    action: &str,
    value: &Data,
) -> Result<(), String> {
    let input = match (action, value) {
        ("click", _) => ButtonInput::Click,
        ("value", Data::Bool(down)) => ButtonInput::Hold(*down),
        ("value", Data::Text(text)) => {
            ButtonInput::Enter(String::from_utf8_lossy(text).into_owned())
        }
        ("value", Data::Int(position)) => ButtonInput::Slide(*position),
        ("value", Data::Float(position)) => ButtonInput::Slide(*position as i64),
        ("finish", _) => return Ok(()),
        _ => return Err(format!("a button of V-REP does not take '{action}'")),
    };
    cx.scene_mut().use_button(handle, number, input)
}
