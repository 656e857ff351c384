//! `sim.*`: floating views, which pages of the viewer show.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::{Data, Handle, SceneError};
use script::{Number, Rest};

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![floating_view_add, floating_view_remove, adjust_view,];

/// Adds a view above the scene. Pages of the viewer show it.
///
/// @param posX of its centre, 0 to 1
/// @param posY of its centre
/// @param sizeX part of the window
/// @param sizeY part of the window
/// @param options bits
/// @return floatingViewHandle its handle
#[api("sim.floatingViewAdd")]
fn floating_view_add(
    cx: &mut Cx,
    pos_x: f64,
    pos_y: f64,
    size_x: f64,
    size_y: f64,
    options: Number,
) -> Result<i64> {
    let _ = options;
    let view = cx.change_ui(|ui| {
        ui.touch();
        ui.views.add([pos_x, pos_y], [size_x, size_y])
    });
    cx.own_view(view);
    Ok(view)
}

/// Removes a view.
///
/// @param floatingViewHandle from sim.floatingViewAdd
/// @return result 1, or 0 when there is no such view
#[api("sim.floatingViewRemove")]
fn floating_view_remove(cx: &mut Cx, floating_view_handle: Number) -> Result<i64> {
    let removed = cx.change_ui(|ui| {
        ui.touch();
        ui.views.remove(floating_view_handle.0)
    });
    Ok(removed.into())
}

/// Shows an object in a view. Views of the page are not changed: in the viewer everybody chooses their own.
///
/// @param viewHandleOrIndex from sim.floatingViewAdd, or the number of a view of the page
/// @param objectHandle a camera, vision sensor or graph, or -1
/// @param options bits
/// @return res 1
#[api("sim.adjustView")]
fn adjust_view(
    cx: &mut Cx,
    view_handle_or_index: Number,
    object_handle: Number,
    options: Number,
    #[name("...")] label: Rest,
) -> Result<i64> {
    let _ = options;
    if object_handle.0 >= 0 {
        object(cx, object_handle)?;
    }
    cx.change_ui(|ui| {
        ui.touch();
        if let Some(view) = ui.views.get_mut(view_handle_or_index.0) {
            view.object = object_handle.0.max(-1);
            if let Some(Data::Text(text)) = label.0.first() {
                view.label = String::from_utf8_lossy(text).into_owned();
            }
        }
    });
    Ok(1)
}

fn object(cx: &Cx, handle: Number) -> Result<Handle> {
    let scene = cx.scene();
    let handle = Handle::from_raw(handle.0).ok_or(SceneError::NoSuchObject)?;
    Ok(scene.object(handle)?.handle())
}
