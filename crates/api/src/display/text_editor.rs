//! `sim.*`: text editors: windows with a text that persons may change.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use script::Number;
use ui::EditorState;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    text_editor_open,
    text_editor_close,
    text_editor_show,
    text_editor_get_info
];

/// Opens a text editor. Pages show it; tests reach it by its title (`t.ui`), its text is the widget 1.
///
/// @param initText the text to begin with
/// @param properties an element in XML: title, editable, closeable, position, size, on-close (a function that gets text, position, size) count
/// @return handle
#[api("sim.textEditorOpen")]
fn text_editor_open(
    cx: &mut Cx,
    init_text: String,
    #[default("")] properties: String,
) -> Result<i64> {
    let owner = cx.script().id;
    let (number, window) = cx.change_ui(|ui| ui.open_editor(&init_text, &properties, owner));
    cx.own_window(&window);
    Ok(number)
}

/// Closes a text editor.
///
/// @param handle from sim.textEditorOpen
/// @return text nothing if there is no such editor
/// @return pos pixels
/// @return size pixels
#[api("sim.textEditorClose")]
#[allow(
    clippy::type_complexity,
    reason = "the reference reads the types of the results here"
)]
fn text_editor_close(
    cx: &mut Cx,
    handle: Number,
) -> Result<(Option<String>, Option<Vec<i64>>, Option<Vec<i64>>)> {
    let state = cx.change_ui(|ui| ui.close_editor(handle.0));
    let (text, position, size, _) = parts(state);
    Ok((text, position, size))
}

type Parts = (
    Option<String>,
    Option<Vec<i64>>,
    Option<Vec<i64>>,
    Option<bool>,
);

fn parts(state: Option<EditorState>) -> Parts {
    state.map_or((None, None, None, None), |state| {
        let EditorState {
            text,
            position,
            size,
            visible,
        } = state;
        (
            Some(text),
            Some(position.to_vec()),
            Some(size.to_vec()),
            Some(visible),
        )
    })
}

/// Shows or hides a text editor.
///
/// @param handle from sim.textEditorOpen
/// @param showState true to show it
#[api("sim.textEditorShow")]
fn text_editor_show(cx: &mut Cx, handle: Number, show_state: bool) -> Result<()> {
    cx.change_ui(|ui| ui.show_editor(handle.0, show_state));
    Ok(())
}

/// What a text editor shows.
///
/// @param handle from sim.textEditorOpen
/// @return text nothing if there is no such editor
/// @return pos pixels
/// @return size pixels
/// @return visible
#[api("sim.textEditorGetInfo")]
fn text_editor_get_info(cx: &Cx, handle: Number) -> Result<Parts> {
    Ok(parts(cx.read_ui(|ui| ui.editor(handle.0))))
}
