//! `sim.*`: copying and scaling objects.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::{CopyOptions, Handle, SceneError};
use script::{Handles, Number};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![copy_paste_objects, scale_objects, scale_object];

fn handles(raw: &Handles) -> Result<Vec<Handle>> {
    raw.0
        .iter()
        .map(|&raw| Handle::from_raw(raw).ok_or(SceneError::NoSuchObject.into()))
        .collect()
}

/// Copies objects. Copies whose ancestors are not copied become roots; all keep their world poses.
///
/// @param objectHandles the objects
/// @param options 1: whole models; without 2: scripts; 4: custom data; 8: referenced handles; 32: being models
/// @return copiedObjectHandles the copies, in the order of the originals; nothing if none was copied
#[api("sim.copyPasteObjects")]
fn copy_paste_objects(
    cx: &mut Cx,
    object_handles: Handles,
    #[default(0)] options: Number,
) -> Result<Option<Vec<i64>>> {
    if object_handles.0.is_empty() {
        return Err(ApiError::TableSize);
    }
    let handles = handles(&object_handles)?;
    let copies = cx.copy_objects(&handles, CopyOptions::from_bits_retain(options.0))?;
    let aligned = handles
        .iter()
        .map(|original| copies.get(original).map_or(-1, |copy| copy.raw()));
    Ok((!copies.is_empty()).then(|| aligned.collect()))
}

/// Scales objects with their masses.
///
/// @param objectHandles the objects
/// @param scalingFactor at least 0.0001
/// @param scalePositionsToo also where they are in their parents' frames
/// @return result 1
#[api("sim.scaleObjects")]
fn scale_objects(
    cx: &mut Cx,
    object_handles: Handles,
    scaling_factor: f64,
    scale_positions_too: bool,
) -> Result<i64> {
    let handles = handles(&object_handles)?;
    cx.scene_mut()
        .scale_objects(&handles, scaling_factor, scale_positions_too)?;
    Ok(1)
}

/// Scales an object along its axes; mass and inertia stay.
///
/// @param objectHandle the object
/// @param xScale at least 0.0001
/// @param yScale at least 0.0001; as x for round things
/// @param zScale at least 0.0001; as x for spheres
/// @param options ignored
/// @return result 1
#[api("sim.scaleObject")]
fn scale_object(
    cx: &mut Cx,
    object_handle: Handle,
    x_scale: f64,
    y_scale: f64,
    z_scale: f64,
    #[default(0)] _options: Number,
) -> Result<i64> {
    cx.scene_mut()
        .scale_object(object_handle, [x_scale, y_scale, z_scale])?;
    Ok(1)
}
