//! `simUI.*`: tables.

use api_macro::api;

use super::arguments::WindowHandle;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::Data;
use script::Bytes;
use ui::{Cell, Image, Table};
use wire::cbor;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    clear_table,
    get_row_count,
    set_row_count,
    get_item,
    set_item,
    set_items,
    set_item_image,
    set_item_editable,
    set_row_header_text,
    set_row_height,
    set_table_selection,
    insert_table_row,
    remove_table_row,
    insert_table_column,
    remove_table_column,
];

/// Removes cells and headers; the size stays.
///
/// @param handle the window
/// @param id the table
/// @param suppressEvents without effect
#[api("simUI.clearTable")]
fn clear_table(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    change(cx, &handle, id, Table::clear)
}

fn change(
    cx: &mut Cx,
    handle: &WindowHandle,
    id: i64,
    change: impl FnOnce(&mut Table),
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        change(window.get_mut(id)?);
        Ok(())
    })
}

/// How many rows a table has.
///
/// @param handle the window
/// @param id the table
/// @return count
#[api("simUI.getRowCount")]
fn get_row_count(cx: &Cx, handle: WindowHandle, id: i64) -> Result<i64> {
    cx.read_window(&handle.0, |window| Ok(window.get::<Table>(id)?.row_count))
}

/// Adds rows at the end of a table, or removes some there.
///
/// @param handle the window
/// @param id the table
/// @param count
/// @param suppressEvents without effect
#[api("simUI.setRowCount")]
fn set_row_count(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    count: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    change(cx, &handle, id, |table| {
        table.resize(count, table.column_count);
    })
}

/// The text of a cell.
///
/// @param handle the window
/// @param id the table
/// @param row from 0
/// @param column from 0
/// @return text empty where there is none
#[api("simUI.getItem")]
fn get_item(cx: &Cx, handle: WindowHandle, id: i64, row: i64, column: i64) -> Result<String> {
    cx.read_window(&handle.0, |window| {
        Ok(window.get::<Table>(id)?.text(row, column).to_owned())
    })
}

/// Sets the text of a cell; nothing outside of the table.
///
/// @param handle the window
/// @param id the table
/// @param row from 0
/// @param column from 0
/// @param text
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setItem")]
fn set_item(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    row: i64,
    column: i64,
    text: String,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.set_cell(id, [row, column], text, !suppress_events)
    })
}

/// Sets all texts of a table, which gets as many rows, and more columns if need be.
///
/// @param handle the window
/// @param id the table
/// @param data rows of texts, as CBOR
/// @param suppressEvents without effect
#[api("simUI.setItems")]
fn set_items(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    data: Bytes,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    let rows = cbor::decode(&data.0).ok().and_then(|data| rows_of(&data));
    let rows = rows
        .ok_or_else(|| ApiError::Other("the data is no CBOR array of arrays of texts.".into()))?;
    cx.change_window(&handle.0, |window| window.set_cells(id, rows))
}

fn rows_of(data: &Data) -> Option<Vec<Vec<String>>> {
    let text = |data: &Data| match data {
        Data::Text(bytes) | Data::Buffer(bytes) => {
            Some(String::from_utf8_lossy(bytes).into_owned())
        }
        _ => None,
    };
    let row = |row: &Data| match row {
        Data::Array(cells) => cells.iter().map(text).collect(),
        _ => None,
    };
    match data {
        Data::Array(rows) => rows.iter().map(row).collect(),
        _ => None,
    }
}

/// Puts a picture into a cell; nothing outside of the table.
///
/// @param handle the window
/// @param id the table
/// @param row from 0
/// @param column from 0
/// @param data red, green, blue of each pixel, the bottom row first
/// @param width pixels
/// @param height pixels
/// @param suppressEvents without effect
#[api("simUI.setItemImage")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn set_item_image(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    row: i64,
    column: i64,
    data: Bytes,
    width: i64,
    height: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    cx.change_window(&handle.0, |window| {
        let table = window.get_mut::<Table>(id)?;
        let mut image = Image::default();
        image.set_rgb(&data.0, width, height)?;
        if table.contains(row, column) {
            let cell = table
                .cells
                .entry((row, column))
                .or_insert_with(|| Cell::of_text(String::new()));
            cell.image = Some(image);
        }
        Ok(())
    })
}

/// Whether persons may change a cell.
///
/// @param handle the window
/// @param id the table
/// @param row from 0
/// @param column from 0
/// @param editable
#[api("simUI.setItemEditable")]
fn set_item_editable(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    row: i64,
    column: i64,
    editable: bool,
) -> Result<()> {
    change(cx, &handle, id, |table| {
        if let Some(cell) = table.cells.get_mut(&(row, column)) {
            cell.editable = editable;
        }
    })
}

/// Sets the text in front of a row.
///
/// @param handle the window
/// @param id the table
/// @param row from 0
/// @param text
#[api("simUI.setRowHeaderText")]
fn set_row_header_text(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    row: i64,
    text: String,
) -> Result<()> {
    change(cx, &handle, id, |table| {
        if (0..table.row_count).contains(&row) {
            table.row_headers.insert(row, text);
        }
    })
}

/// Sets the limits of the height of rows: of all, whichever is named.
///
/// @param handle the window
/// @param id the table
/// @param row any
/// @param min_size pixels
/// @param max_size pixels
#[api("simUI.setRowHeight", snake_case)]
fn set_row_height(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    row: i64,
    min_size: i64,
    max_size: i64,
) -> Result<()> {
    let _ = row;
    change(cx, &handle, id, |table| {
        table.row_height = Some([min_size, max_size]);
    })
}

/// Selects a cell, a row or a column, by the mode of the table.
///
/// @param handle the window
/// @param id the table
/// @param row from 0
/// @param column from 0
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setTableSelection")]
fn set_table_selection(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    row: i64,
    column: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.select_cell(id, row, column, !suppress_events)
    })
}

/// Inserts a row; it has the texts of the one that was there.
///
/// @param handle the window
/// @param id the table
/// @param index of the new row, from 0
#[api("simUI.insertTableRow")]
fn insert_table_row(cx: &mut Cx, handle: WindowHandle, id: i64, index: i64) -> Result<()> {
    change(cx, &handle, id, |table| table.insert_row(index))
}

/// Removes a row.
///
/// @param handle the window
/// @param id the table
/// @param index from 0
#[api("simUI.removeTableRow")]
fn remove_table_row(cx: &mut Cx, handle: WindowHandle, id: i64, index: i64) -> Result<()> {
    change(cx, &handle, id, |table| table.remove_row(index))
}

/// Inserts a column; it has the texts of the one that was there.
///
/// @param handle the window
/// @param id the table
/// @param index of the new column, from 0
#[api("simUI.insertTableColumn")]
fn insert_table_column(cx: &mut Cx, handle: WindowHandle, id: i64, index: i64) -> Result<()> {
    change(cx, &handle, id, |table| table.insert_column(index))
}

/// Removes a column.
///
/// @param handle the window
/// @param id the table
/// @param index from 0
#[api("simUI.removeTableColumn")]
fn remove_table_column(cx: &mut Cx, handle: WindowHandle, id: i64, index: i64) -> Result<()> {
    change(cx, &handle, id, |table| table.remove_column(index))
}
