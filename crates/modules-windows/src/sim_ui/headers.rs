//! `simUI.*`: columns and headers, which tables and trees have.

use api_macro::api;

use super::arguments::WindowHandle;
use crate::{ApiFn, Cx, Result, functions};
use script::Bytes;
use ui::{UiError, UiResult, WidgetKind, Window};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    get_column_count,
    set_column_count,
    set_column_header_text,
    set_column_width,
    save_state,
    restore_state,
];

/// How many columns a table or tree has.
///
/// @param handle the window
/// @param id the table or tree
/// @return count
#[api("simUI.getColumnCount")]
fn get_column_count(cx: &Cx, handle: WindowHandle, id: i64) -> Result<i64> {
    cx.read_window(&handle.0, |window| match &window.widget(id)?.kind {
        WidgetKind::Table(table) => Ok(table.column_count),
        WidgetKind::Tree(tree) => Ok(tree.column_count),
        _ => Err(UiError::NoColumns),
    })
}

/// Adds columns at the end of a table or tree, or removes some there.
///
/// @param handle the window
/// @param id the table or tree
/// @param count
/// @param suppressEvents without effect
#[api("simUI.setColumnCount")]
fn set_column_count(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    count: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    cx.change_window(&handle.0, |window| {
        match &mut window.widget_mut(id)?.kind {
            WidgetKind::Table(table) => table.resize(table.row_count, count),
            WidgetKind::Tree(tree) => tree.column_count = count.max(0),
            _ => return Err(UiError::NoColumns),
        }
        Ok(())
    })
}

/// Sets the text above a column of a table or tree.
///
/// @param handle the window
/// @param id the table or tree
/// @param column from 0
/// @param text
#[api("simUI.setColumnHeaderText")]
fn set_column_header_text(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    column: i64,
    text: String,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        let (headers, count) = match &mut window.widget_mut(id)?.kind {
            WidgetKind::Table(table) => (&mut table.column_headers, table.column_count),
            WidgetKind::Tree(tree) => (&mut tree.column_headers, tree.column_count),
            _ => return Err(UiError::NoColumns),
        };
        if (0..count).contains(&column) {
            headers.insert(column, text);
        }
        Ok(())
    })
}

/// Sets the limits of the width of columns: of all, whichever is named.
///
/// @param handle the window
/// @param id the table or tree
/// @param column any
/// @param min_size pixels
/// @param max_size pixels
#[api("simUI.setColumnWidth", snake_case)]
fn set_column_width(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    column: i64,
    min_size: i64,
    max_size: i64,
) -> Result<()> {
    let _ = column;
    cx.change_window(&handle.0, |window| {
        set_width(window, id, Some([min_size, max_size]))
    })
}

fn set_width(window: &mut Window, id: i64, width: Option<[i64; 2]>) -> UiResult<()> {
    match &mut window.widget_mut(id)?.kind {
        WidgetKind::Table(table) => table.column_width = width,
        WidgetKind::Tree(tree) => tree.column_width = width,
        _ => return Err(UiError::NoColumns),
    }
    Ok(())
}

/// What a state begins with.
const STATE: [u8; 4] = *b"swU1";

/// How the header of a table or tree is arranged, for simUI.restoreState.
///
/// @param handle the window
/// @param id the table or tree
/// @return state
#[api("simUI.saveState")]
fn save_state(cx: &Cx, handle: WindowHandle, id: i64) -> Result<Bytes> {
    cx.read_window(&handle.0, |window| {
        let width = match &window.widget(id)?.kind {
            WidgetKind::Table(table) => table.column_width,
            WidgetKind::Tree(tree) => tree.column_width,
            _ => return Err(UiError::NoColumns),
        };
        let mut state = STATE.to_vec();
        state.extend(width.into_iter().flatten().flat_map(i64::to_le_bytes));
        Ok(Bytes(state))
    })
}

/// Arranges the header of a table or tree as it was. Bytes from elsewhere change nothing.
///
/// @param handle the window
/// @param id the table or tree
/// @param state of simUI.saveState
#[api("simUI.restoreState")]
fn restore_state(cx: &mut Cx, handle: WindowHandle, id: i64, state: Bytes) -> Result<()> {
    let numbers = state
        .0
        .strip_prefix(&STATE)
        .map(|rest| rest.as_chunks::<8>().0.to_vec());
    cx.change_window(&handle.0, |window| match numbers.as_deref() {
        Some([least, most]) => set_width(window, id, Some([*least, *most].map(i64::from_le_bytes))),
        Some([]) => set_width(window, id, None),
        _ => window.widget(id).map(|_| ()),
    })
}
