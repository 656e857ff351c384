//! `simUI.*`: trees.

use api_macro::api;

use super::arguments::{Texts, WindowHandle};
use crate::{ApiFn, Cx, Result, functions};
use ui::Tree;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    clear_tree,
    add_tree_item,
    update_tree_item_text,
    update_tree_item_parent,
    remove_tree_item,
    set_tree_selection,
    expand_all,
    collapse_all,
    expand_to_depth,
];

/// Deeper than any tree.
const ALL_LEVELS: i64 = i64::MAX;

fn change(
    cx: &mut Cx,
    handle: &WindowHandle,
    id: i64,
    change: impl FnOnce(&mut Tree),
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        change(window.get_mut(id)?);
        Ok(())
    })
}

/// Removes all items of a tree.
///
/// @param handle the window
/// @param id the tree
/// @param suppressEvents without effect
#[api("simUI.clearTree")]
fn clear_tree(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    change(cx, &handle, id, |tree| {
        tree.items.clear();
        tree.selected = 0;
    })
}

/// Adds an item to a tree. Nothing happens for an id that is not positive, or an unknown parent.
///
/// @param handle the window
/// @param id the tree
/// @param item_id its number
/// @param text of each column
/// @param parent_id 0 for the top
/// @param expanded whether the items below it are shown
/// @param suppressEvents without effect
#[api("simUI.addTreeItem", snake_case)]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn add_tree_item(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    item_id: i64,
    text: Texts,
    #[default(0)] parent_id: i64,
    #[default(false)] expanded: bool,
    #[default(true)]
    #[name("suppressEvents")]
    _suppress_events: bool,
) -> Result<()> {
    change(cx, &handle, id, |tree| {
        if item_id > 0 {
            tree.add(item_id, parent_id, text.0, expanded);
        }
    })
}

/// Sets the texts of an item.
///
/// @param handle the window
/// @param id the tree
/// @param item_id its number
/// @param text of each column
#[api("simUI.updateTreeItemText", snake_case)]
fn update_tree_item_text(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    item_id: i64,
    text: Texts,
) -> Result<()> {
    change(cx, &handle, id, |tree| {
        if let Some(item) = tree.items.get_mut(&item_id) {
            item.texts = text.0;
        }
    })
}

/// Moves an item below another one. Nothing happens for items at the top.
///
/// @param handle the window
/// @param id the tree
/// @param item_id its number
/// @param parent_id 0 for the top
/// @param suppressEvents without effect
#[api("simUI.updateTreeItemParent", snake_case)]
fn update_tree_item_parent(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    item_id: i64,
    parent_id: i64,
    #[default(true)]
    #[name("suppressEvents")]
    _suppress_events: bool,
) -> Result<()> {
    change(cx, &handle, id, |tree| tree.move_item(item_id, parent_id))
}

/// Removes an item with those below it.
///
/// @param handle the window
/// @param id the tree
/// @param item_id its number
/// @param suppressEvents without effect
#[api("simUI.removeTreeItem", snake_case)]
fn remove_tree_item(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    item_id: i64,
    #[default(true)]
    #[name("suppressEvents")]
    _suppress_events: bool,
) -> Result<()> {
    change(cx, &handle, id, |tree| tree.remove(item_id))
}

/// Selects an item of a tree; none for an unknown one.
///
/// @param handle the window
/// @param id the tree
/// @param item_id its number
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setTreeSelection", snake_case)]
fn set_tree_selection(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    item_id: i64,
    #[default(true)]
    #[name("suppressEvents")]
    suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.select_item(id, item_id, !suppress_events)
    })
}

/// Shows all items of a tree.
///
/// @param handle the window
/// @param id the tree
/// @param suppressEvents without effect
#[api("simUI.expandAll")]
fn expand_all(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    change(cx, &handle, id, |tree| tree.expand_to(ALL_LEVELS))
}

/// Shows the items at the top of a tree only.
///
/// @param handle the window
/// @param id the tree
/// @param suppressEvents without effect
#[api("simUI.collapseAll")]
fn collapse_all(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    change(cx, &handle, id, |tree| tree.expand_to(-1))
}

/// Shows the items of a tree down to a level.
///
/// @param handle the window
/// @param id the tree
/// @param depth 0 shows what is below the items at the top
/// @param suppressEvents without effect
#[api("simUI.expandToDepth")]
fn expand_to_depth(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    depth: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    change(cx, &handle, id, |tree| tree.expand_to(depth))
}
