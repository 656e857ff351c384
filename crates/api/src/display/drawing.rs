//! `sim.*`: drawing objects. Cameras and vision sensors see them.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::appearance::colour::Colour;
use scene::drawing::DrawingStyle;
use scene::drawing::options::{DrawingFlags, DrawingKind};
use scene::numbers;
use scene::{Data, Handle, SceneError, flag, special};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    add_drawing_object,
    add_drawing_object_item,
    remove_drawing_object
];

/// Bits above the handle of a drawing object.
pub(crate) const HANDLE_BITS: i64 = 0x000f_ffff;
const WHITE: [f64; 3] = [1.0; 3];

/// Something to draw points, lines, triangles or small bodies with, seen by cameras and vision sensors. Without
/// sim.drawing_persistent it ends with the script.
///
/// @param objectType sim.drawing_*
/// @param size of points and lines in pixels, of others in metres
/// @param duplicateTolerance items closer than this to another one are refused, metres
/// @param parentObjectHandle the object they move with, -1 for the world
/// @param maxItemCount further ones are refused, or replace the oldest with sim.drawing_cyclic
/// @param color red, green, blue
/// @param reserved not used
/// @param specular red, green, blue
/// @param emission red, green, blue
/// @return drawingObjectHandle its handle
#[api("sim.addDrawingObject")]
#[expect(clippy::too_many_arguments, reason = "the reference has them")]
fn add_drawing_object(
    cx: &mut Cx,
    object_type: Number,
    #[default(1.0)] size: f64,
    #[default(0.0)] duplicate_tolerance: f64,
    #[default(-1)] parent_object_handle: Number,
    #[default(1000)] max_item_count: Number,
    #[default(None)] color: Option<[f64; 3]>,
    #[default(None)] reserved: Option<[f64; 3]>,
    #[default(None)] specular: Option<[f64; 3]>,
    #[default(None)] emission: Option<[f64; 3]>,
) -> Result<i64> {
    let _ = reserved;
    let parts = |part: [f64; 3]| part.map(numbers::single);
    let mut colour = Colour::new(parts(color.unwrap_or(WHITE)));
    colour.specular = specular.map_or(colour.specular, parts);
    colour.emission = emission.map_or(colour.emission, parts);
    let style = DrawingStyle {
        kind: DrawingKind::from_code(object_type.0).ok_or(SceneError::InvalidArgument)?,
        flags: DrawingFlags::from_code(object_type.0),
        size,
        duplicate_tolerance,
        parent: parent(parent_object_handle.0)?,
        max_items: usize::try_from(max_item_count.0).unwrap_or(0),
        colour,
    };
    let owner = cx.script().id;
    Ok(cx.scene_mut().add_drawing(style, Some(owner))?)
}

fn parent(raw: i64) -> Result<Option<Handle>> {
    if raw < 0 {
        return Ok(None);
    }
    Ok(Some(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?))
}

/// Adds an item to a drawing object: its coordinates, then the direction of small bodies, colours, size and transparency where its
/// type says so.
///
/// @param drawingObjectHandle from sim.addDrawingObject; with sim.handleflag_addmultiple itemData holds any number of items
/// @param itemData numbers, or a buffer of 32-bit ones; nothing removes all items
/// @return result 1 if an item was stored, 0 if the object is full, has the item already, or was emptied
#[api("sim.addDrawingObjectItem")]
fn add_drawing_object_item(
    cx: &mut Cx,
    drawing_object_handle: Number,
    #[default(Data::Nil)] item_data: Data,
) -> Result<i64> {
    let handle = drawing_object_handle.0 & HANDLE_BITS;
    let mut numbers = numbers(&item_data)?;
    let mut scene = cx.scene_mut();
    if numbers.is_empty() {
        scene.drawings_mut().clear(handle)?;
        return Ok(0);
    }
    if drawing_object_handle.0 & flag::ADD_MULTIPLE == 0 {
        numbers.truncate(scene.drawings().get(handle)?.item_len());
    }
    Ok(i64::from(scene.add_drawing_items(handle, &numbers)? > 0))
}

/// The numbers of a table, or of a buffer of 32-bit ones.
pub(super) fn numbers(data: &Data) -> Result<Vec<f64>> {
    match data {
        Data::Nil => Ok(Vec::new()),
        Data::Array(items) => items
            .iter()
            .map(|item| item.as_f64().ok_or(ApiError::ArgumentType))
            .collect(),
        Data::Buffer(bytes) | Data::Text(bytes) => Ok(bytes
            .as_chunks()
            .0
            .iter()
            .map(|number| f32::from_le_bytes(*number).into())
            .collect()),
        _ => Err(ApiError::ArgumentType),
    }
}

/// Removes a drawing object.
///
/// @param drawingObjectHandle from sim.addDrawingObject, or sim.handle_all
/// @return result 1
#[api("sim.removeDrawingObject")]
fn remove_drawing_object(cx: &mut Cx, drawing_object_handle: Number) -> Result<i64> {
    let mut scene = cx.scene_mut();
    let drawings = scene.drawings_mut();
    match drawing_object_handle.0 {
        special::ALL => drawings.remove_all(),
        raw if raw & flag::SILENT_ERROR != 0 => drop(drawings.remove(raw & !flag::SILENT_ERROR)),
        raw => drawings.remove(raw)?,
    }
    Ok(1)
}
