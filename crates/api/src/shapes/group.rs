//! `sim.*`: grouping, merging and splitting shapes.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::{Handle, SceneError};
use script::{Handles, Number};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![group_shapes, ungroup_shape];

/// Groups or merges shapes into one. The originals are removed; pose, parent, alias and flags are those of the last one.
///
/// @param shapeHandles the shapes
/// @param merge whether the result is one mesh instead of a compound
/// @return shapeHandle the new shape
#[api("sim.groupShapes")]
fn group_shapes(
    cx: &mut Cx,
    shape_handles: Handles,
    #[default(false)] merge: bool,
) -> Result<Handle> {
    if shape_handles.0.is_empty() {
        return Err(ApiError::TableSize);
    }
    let (group, members) = cx.scene_mut().group_shapes(&shape_handles.0, merge)?;
    replace(cx, &members, vec![group])?;
    Ok(group)
}

/// Splits a compound into its members.
///
/// @param shapeHandle the shape; -2 minus the handle divides a single mesh into its islands
/// @return simpleShapeHandles the new shapes, or the shape itself when there is nothing to take apart
#[api("sim.ungroupShape")]
fn ungroup_shape(cx: &mut Cx, shape_handle: Number) -> Result<Vec<Handle>> {
    let (raw, divide) = if shape_handle.0 < -1 {
        (-2 - shape_handle.0, true)
    } else {
        (shape_handle.0, false)
    };
    let handle = Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?;
    let pieces = if divide {
        cx.scene_mut().divide_shape(handle)
    } else {
        cx.scene_mut().ungroup_shape(handle)
    };
    match pieces? {
        Some(pieces) => replace(cx, &[handle], pieces),
        None => Ok(vec![handle]),
    }
}

/// Notifies the scripts of the new shapes and removes the old ones.
fn replace(cx: &mut Cx, old: &[Handle], new: Vec<Handle>) -> Result<Vec<Handle>> {
    cx.notify_created(&new);
    cx.remove_objects(old)?;
    Ok(new)
}
