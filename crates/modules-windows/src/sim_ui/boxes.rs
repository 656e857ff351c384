//! `simUI.*`: combo boxes and tabs.

use api_macro::api;
use scene::numbers;

use super::arguments::{Texts, WindowHandle};
use crate::{ApiFn, Cx, Result, functions};
use ui::{Combobox, Tabs};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    insert_combobox_item,
    remove_combobox_item,
    get_combobox_item_count,
    get_combobox_item_text,
    get_combobox_items,
    set_combobox_items,
    get_combobox_selected_index,
    set_combobox_selected_index,
    get_current_tab,
    set_current_tab,
];

/// Inserts an item into a combo box. Into an empty one: it is selected.
///
/// @param handle the window
/// @param id the combo box
/// @param index from 0; one that is too large adds it at the end
/// @param text
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.insertComboboxItem")]
fn insert_combobox_item(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    index: i64,
    text: String,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.change_combobox(id, !suppress_events, |combobox| {
            let at = usize::try_from(index)
                .unwrap_or(0)
                .min(combobox.items.len());
            combobox.items.insert(at, text);
            combobox.selected = match combobox.selected {
                None if combobox.items.len() == 1 => Some(0),
                selected => selected.map(|selected| selected + usize::from(at <= selected)),
            };
        })
    })
}

/// Removes an item from a combo box; nothing for one there is not.
///
/// @param handle the window
/// @param id the combo box
/// @param index from 0
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.removeComboboxItem")]
fn remove_combobox_item(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    index: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.change_combobox(id, !suppress_events, |combobox| {
            let Some(at) = usize::try_from(index)
                .ok()
                .filter(|at| *at < combobox.items.len())
            else {
                return;
            };
            combobox.items.remove(at);
            let last = combobox.items.len().checked_sub(1);
            let moved = combobox
                .selected
                .map(|selected| selected - usize::from(at < selected));
            combobox.selected = moved.and_then(|moved| last.map(|last| moved.min(last)));
        })
    })
}

/// How many items a combo box has.
///
/// @param handle the window
/// @param id the combo box
/// @return count
#[api("simUI.getComboboxItemCount")]
fn get_combobox_item_count(cx: &Cx, handle: WindowHandle, id: i64) -> Result<i64> {
    cx.read_window(&handle.0, |window| {
        Ok(numbers::count(window.get::<Combobox>(id)?.items.len()))
    })
}

/// The text of an item of a combo box; empty where there is none.
///
/// @param handle the window
/// @param id the combo box
/// @param index from 0
/// @return text
#[api("simUI.getComboboxItemText")]
fn get_combobox_item_text(cx: &Cx, handle: WindowHandle, id: i64, index: i64) -> Result<String> {
    cx.read_window(&handle.0, |window| {
        let combobox = window.get::<Combobox>(id)?;
        Ok(usize::try_from(index)
            .ok()
            .and_then(|at| combobox.items.get(at))
            .cloned()
            .unwrap_or_default())
    })
}

/// The items of a combo box.
///
/// @param handle the window
/// @param id the combo box
/// @return items
#[api("simUI.getComboboxItems")]
fn get_combobox_items(cx: &Cx, handle: WindowHandle, id: i64) -> Result<Vec<String>> {
    cx.read_window(&handle.0, |window| {
        Ok(window.get::<Combobox>(id)?.items.clone())
    })
}

/// Replaces the items of a combo box and selects one.
///
/// @param handle the window
/// @param id the combo box
/// @param items
/// @param index of the selected item, from 0
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setComboboxItems")]
fn set_combobox_items(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    items: Texts,
    index: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.change_combobox(id, !suppress_events, |combobox| {
            combobox.items = items.0;
            combobox.selected = selection(combobox, index);
        })
    })
}

fn selection(combobox: &Combobox, index: i64) -> Option<usize> {
    usize::try_from(index)
        .ok()
        .filter(|at| *at < combobox.items.len())
}

/// The selected item of a combo box.
///
/// @param handle the window
/// @param id the combo box
/// @return index from 0; -1 for none
#[api("simUI.getComboboxSelectedIndex")]
fn get_combobox_selected_index(cx: &Cx, handle: WindowHandle, id: i64) -> Result<i64> {
    cx.read_window(&handle.0, |window| {
        Ok(window
            .get::<Combobox>(id)?
            .selected
            .map_or(-1, numbers::count))
    })
}

/// Selects an item of a combo box; none for one there is not.
///
/// @param handle the window
/// @param id the combo box
/// @param index from 0
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setComboboxSelectedIndex")]
fn set_combobox_selected_index(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    index: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.change_combobox(id, !suppress_events, |combobox| {
            combobox.selected = selection(combobox, index);
        })
    })
}

/// The page that tabs show.
///
/// @param handle the window
/// @param id the tabs
/// @return index from 0; -1 without pages
#[api("simUI.getCurrentTab")]
fn get_current_tab(cx: &Cx, handle: WindowHandle, id: i64) -> Result<i64> {
    cx.read_window(&handle.0, |window| {
        let tabs = window.get::<Tabs>(id)?;
        Ok(if tabs.pages.is_empty() {
            -1
        } else {
            numbers::count(tabs.current)
        })
    })
}

/// Shows a page of tabs; nothing for one there is not.
///
/// @param handle the window
/// @param id the tabs
/// @param index from 0
/// @param suppressEvents without effect
#[api("simUI.setCurrentTab")]
fn set_current_tab(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    index: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    cx.change_window(&handle.0, |window| window.set_tab(id, index))
}
