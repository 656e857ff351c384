//! What tests do with interfaces as persons would: items by their `objectName`.

use scene::Data;

use super::engines::Engines;
use crate::Cx;

type Outcome<T> = Result<T, String>;

/// Lets all interfaces do what was sent to them before, so that it can be seen.
pub fn catch_up(cx: &Cx) {
    for (_, engine) in cx.module_state::<Engines>().all() {
        engine.send_inputs(false);
        // One that has ended has nothing to do any more.
        let _ = engine.ask(cx, "rest", &[Data::Int(0)]);
    }
}

/// Whether a window is drawn by an interface in QML.
pub fn is_interface(cx: &Cx, window: &str) -> bool {
    cx.module_state::<Engines>().of_window(window).is_some()
}

/// The number of the item with that `objectName`, or that text.
///
/// # Errors
/// Which items there are.
pub fn find(cx: &Cx, window: &str, name: &str) -> Outcome<i64> {
    match ask(cx, window, "find", &[Data::text(name)])? {
        Data::Int(number) => Ok(number),
        _ => Err(strange()),
    }
}

/// What a person sees of an item: value, kind, enabled, visible.
///
/// # Errors
/// When it is gone.
pub fn state(cx: &Cx, window: &str, item: i64) -> Outcome<Data> {
    let Data::Array(values) = ask(cx, window, "state", &[Data::Int(item)])? else {
        return Err(strange());
    };
    let names = ["value", "kind", "enabled", "visible"];
    if values.len() != names.len() {
        return Err(strange());
    }
    let fields = names.map(|name| name.as_bytes().to_vec());
    let fields = fields.into_iter().map(scene::Key::Text);
    Ok(Data::Map(fields.zip(values).collect()))
}

/// Does with an item what a person would; handlers of events run at once.
///
/// # Errors
/// Why it is refused.
pub fn act(
    cx: &mut Cx,
    window: &str,
    item: i64,
    action: &str,
    [first, second]: [Data; 2],
) -> Outcome<()> {
    let argument = match action {
        "key" => Data::Array(vec![first, second]),
        _ => first,
    };
    let fields = [Data::Int(item), Data::text(action), argument];
    ask(cx, window, "act", &fields)?;
    deliver(cx, window);
    Ok(())
}

/// Does what the close button of the window does, which has been noted.
///
/// # Errors
/// When the interface has ended.
pub fn close(cx: &mut Cx, window: &str) -> Outcome<()> {
    ask(cx, window, "rest", &[])?;
    deliver(cx, window);
    Ok(())
}

fn deliver(cx: &Cx, window: &str) {
    if let Some((engine, _)) = cx.module_state::<Engines>().of_window(window) {
        engine.deliver();
    }
}

/// Asks a window's process, which first learns what else persons have done.
fn ask(cx: &Cx, window: &str, kind: &str, fields: &[Data]) -> Outcome<Data> {
    let found = cx.module_state::<Engines>().of_window(window);
    let (engine, number) = found.ok_or("the window is gone")?;
    engine.send_inputs(false);
    engine.ask(cx, kind, &[&[Data::Int(number)], fields].concat())
}

fn strange() -> String {
    "the interface gave an answer of an unknown form".into()
}
