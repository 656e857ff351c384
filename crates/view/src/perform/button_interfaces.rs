//! What persons do with user interfaces of V-REP.

use serde_json::Value;

use scene::tree::button_interfaces::ButtonInput;
use simulator::Simulator;

/// Does what a page asks for with a button.
///
/// # Errors
/// What is wrong with it, or why it is refused.
pub(super) fn input(
    sim: &mut Simulator,
    handle: i64,
    widget: &Value,
    input: &Value,
) -> Result<(), String> {
    let number = widget
        .as_i64()
        .ok_or("`widget` is the number of a button")?;
    let value = &input["value"];
    let input = match (input["type"].as_str(), value) {
        (Some("hold"), Value::Bool(down)) => ButtonInput::Hold(*down),
        (Some("click"), _) => ButtonInput::Click,
        (Some("value"), Value::Number(position)) => {
            ButtonInput::Slide(position.as_f64().unwrap_or(0.0) as i64)
        }
        (Some("value"), Value::String(text)) => ButtonInput::Enter(text.clone()),
        _ => return Err("a user interface of V-REP takes `click`, `hold` and `value`".into()),
    };
    sim.scene_mut().use_button(handle, number, input)
}
