//! `sim.*`: the state of the main window of CoppeliaSim. There is none here: what scripts set is kept for those that read it.

use std::cell::Cell;
use std::rc::Rc;

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    navigation_mode,
    set_navigation_mode,
    page,
    set_page,
    refresh_dialogs,
    announce_scene_content_change,
];

/// `sim.navigation_camerashift`, with which CoppeliaSim starts.
const CAMERA_SHIFT: i64 = 1;

struct Window {
    navigation_mode: Cell<i64>,
    page: Cell<i64>,
}

impl Default for Window {
    fn default() -> Self {
        Self {
            navigation_mode: Cell::new(CAMERA_SHIFT),
            page: Cell::new(0),
        }
    }
}

fn window(cx: &Cx) -> Rc<Window> {
    cx.module_state()
}

/// What the mouse does.
///
/// @return navigationMode as sim.setNavigationMode set it, first sim.navigation_camerashift
#[api("sim.getNavigationMode")]
fn navigation_mode(cx: &Cx) -> Result<i64> {
    Ok(window(cx).navigation_mode.get())
}

/// Chooses what the mouse does. In the viewer everybody chooses their own: the mode is only kept.
///
/// @param navigationMode sim.navigation_*
#[api("sim.setNavigationMode")]
fn set_navigation_mode(cx: &Cx, navigation_mode: Number) -> Result<()> {
    window(cx).navigation_mode.set(navigation_mode.0);
    Ok(())
}

/// The page of views that is shown.
///
/// @return pageIndex as sim.setPage set it, first 0
#[api("sim.getPage")]
fn page(cx: &Cx) -> Result<i64> {
    Ok(window(cx).page.get())
}

/// Chooses the page of views that is shown. There are none here: the number is only kept.
///
/// @param pageIndex of the page
#[api("sim.setPage")]
fn set_page(cx: &Cx, page_index: Number) -> Result<()> {
    window(cx).page.set(page_index.0);
    Ok(())
}

/// Draws the dialogs again. There are none.
///
/// @param refreshDegree how many of them
/// @return result 0
#[api("sim.refreshDialogs")]
fn refresh_dialogs(_cx: &Cx, refresh_degree: Number) -> Result<i64> {
    let _ = refresh_degree;
    Ok(0)
}

/// Marks a point to which undo goes back. There is no undo: pages of the viewer see each change by themselves.
///
/// @return result 1
#[api("sim.announceSceneContentChange")]
fn announce_scene_content_change(_cx: &Cx) -> Result<i64> {
    Ok(1)
}
