//! `simUI.*`: windows, and what all widgets have.

use std::collections::BTreeMap;

use api_macro::api;

use super::arguments::WindowHandle;
use super::pictures;
use crate::{ApiFn, Cx, Result, functions};
use scene::{Data, Key};
use script::Table;
use script::log::verbosity;

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    destroy,
    show,
    hide,
    is_visible,
    get_title,
    set_title,
    get_position,
    set_position,
    get_size,
    set_size,
    adjust_size,
    set_window_enabled,
    set_enabled,
    set_style_sheet,
    get_widget_visibility,
    set_widget_visibility,
];
pub(super) const INNER: &[ApiFn] = functions![create];

/// Opens a window: `create` of the Lua part, which has replaced names by numbers.
#[api("simUI.create")]
fn create(cx: &mut Cx, xml: String, names: Table) -> Result<String> {
    let owner = cx.script().id;
    let names = ids_of(&names.0);
    let (handle, warnings) = cx.change_ui(|ui| ui.create(&xml, owner, names))?;
    cx.own_window(&handle);
    for warning in warnings {
        cx.env().log(verbosity::SCRIPT_WARNINGS, &warning);
    }
    pictures::load_files(cx, &handle)?;
    Ok(handle)
}

fn ids_of(names: &Data) -> BTreeMap<String, i64> {
    let Data::Map(entries) = names else {
        return BTreeMap::new();
    };
    let entry = |(name, id): &(Key, Data)| match (name, id) {
        (Key::Text(name), Data::Int(id)) => Some((String::from_utf8_lossy(name).into_owned(), *id)),
        _ => None,
    };
    entries.iter().filter_map(entry).collect()
}

/// Removes a window for good.
///
/// @param handle the window
#[api("simUI.destroy")]
fn destroy(cx: &mut Cx, handle: WindowHandle) -> Result<()> {
    Ok(cx.change_ui(|ui| ui.destroy(&handle.0))?)
}

/// Shows a window that was hidden.
///
/// @param handle the window
#[api("simUI.show")]
fn show(cx: &mut Cx, handle: WindowHandle) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.visible = true;
        Ok(())
    })
}

/// Hides a window; its widgets keep their values.
///
/// @param handle the window
#[api("simUI.hide")]
fn hide(cx: &mut Cx, handle: WindowHandle) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.visible = false;
        Ok(())
    })
}

/// Whether a window is shown.
///
/// @param handle the window
/// @return visibility
#[api("simUI.isVisible")]
fn is_visible(cx: &Cx, handle: WindowHandle) -> Result<bool> {
    cx.read_window(&handle.0, |window| Ok(window.is_visible()))
}

/// The title of a window.
///
/// @param handle the window
/// @return title
#[api("simUI.getTitle")]
fn get_title(cx: &Cx, handle: WindowHandle) -> Result<String> {
    cx.read_window(&handle.0, |window| Ok(window.title.clone()))
}

/// Sets the title of a window.
///
/// @param handle the window
/// @param title
/// @param suppressEvents without effect
#[api("simUI.setTitle")]
fn set_title(
    cx: &mut Cx,
    handle: WindowHandle,
    title: String,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    cx.change_window(&handle.0, |window| {
        window.title = title;
        Ok(())
    })
}

/// Where a window is: its left upper corner on the screen, pixels. Without a screen, one of 1280 by 800 pixels is meant.
///
/// @param handle the window
/// @return x
/// @return y
#[api("simUI.getPosition")]
fn get_position(cx: &Cx, handle: WindowHandle) -> Result<(i64, i64)> {
    cx.read_window(&handle.0, |window| Ok(window.position.into()))
}

/// Moves a window.
///
/// @param handle the window
/// @param x pixels
/// @param y pixels
/// @param suppressEvents without effect
/// @param keepInVisibleArea without effect
#[api("simUI.setPosition")]
fn set_position(
    cx: &mut Cx,
    handle: WindowHandle,
    x: i64,
    y: i64,
    #[default(true)] suppress_events: bool,
    #[default(true)] keep_in_visible_area: bool,
) -> Result<()> {
    let _ = (suppress_events, keep_in_visible_area);
    cx.change_window(&handle.0, |window| {
        window.position = [x, y];
        Ok(())
    })
}

/// The size of a window, pixels. One that has no size of its own has a default one, whatever size pages draw it in.
///
/// @param handle the window
/// @return w
/// @return h
#[api("simUI.getSize")]
fn get_size(cx: &Cx, handle: WindowHandle) -> Result<(i64, i64)> {
    cx.read_window(&handle.0, |window| Ok(window.size.into()))
}

/// Sets the size of a window.
///
/// @param handle the window
/// @param w pixels
/// @param h pixels
/// @param suppressEvents without effect
#[api("simUI.setSize")]
fn set_size(
    cx: &mut Cx,
    handle: WindowHandle,
    w: i64,
    h: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    cx.change_window(&handle.0, |window| {
        window.size = [w, h];
        Ok(())
    })
}

/// Gives a window the size its widgets need: here the default one.
///
/// @param handle the window
#[api("simUI.adjustSize")]
fn adjust_size(cx: &mut Cx, handle: WindowHandle) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.adjust_size();
        Ok(())
    })
}

/// Whether a window takes inputs.
///
/// @param handle the window
/// @param enabled
/// @param suppressEvents without effect
#[api("simUI.setWindowEnabled")]
fn set_window_enabled(
    cx: &mut Cx,
    handle: WindowHandle,
    enabled: bool,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    cx.change_window(&handle.0, |window| {
        window.enabled = enabled;
        Ok(())
    })
}

/// Whether a widget takes inputs.
///
/// @param handle the window
/// @param id the widget
/// @param enabled
/// @param suppressEvents without effect
#[api("simUI.setEnabled")]
fn set_enabled(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    enabled: bool,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    cx.change_window(&handle.0, |window| {
        window.widget_mut(id)?.enabled = enabled;
        Ok(())
    })
}

/// Sets how a widget looks.
///
/// @param handle the window
/// @param id the widget
/// @param styleSheet a style sheet of Qt
#[api("simUI.setStyleSheet")]
fn set_style_sheet(cx: &mut Cx, handle: WindowHandle, id: i64, style_sheet: String) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.widget_mut(id)?.style = style_sheet;
        Ok(())
    })
}

/// Whether a widget is seen: with its window and all that is around it.
///
/// @param handle the window
/// @param id the widget
/// @return visibility
#[api("simUI.getWidgetVisibility")]
fn get_widget_visibility(cx: &Cx, handle: WindowHandle, id: i64) -> Result<bool> {
    cx.read_window(&handle.0, |window| {
        window.widget(id)?;
        Ok(window.is_widget_visible(id))
    })
}

/// Shows or hides a widget.
///
/// @param handle the window
/// @param id the widget
/// @param visibility
#[api("simUI.setWidgetVisibility")]
fn set_widget_visibility(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    visibility: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.widget_mut(id)?.visible = visibility;
        Ok(())
    })
}
