//! The native part of `swanilda.library`: what programs that load the simulator as a library can do and scripts cannot.

use api_macro::api;

use crate::display::drawing::HANDLE_BITS;
use crate::scripts::script::callee_at_end;
use crate::shapes::texture;
use crate::{ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::shape::options::MeshOptions;
use scene::{Handle, Kind, SceneError};
use script::{Bytes, Number, Text};

use super::default_names::default_name;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    apply_texture,
    drawing_item_size,
    particle_item_size,
    give_old_name,
    callee,
    scripts,
    is_step_needed,
];

/// Puts an image on a shape, with a place in the image for each corner of its triangles.
///
/// @param shapeHandle a simple shape
/// @param coordinates two for each index of the mesh
/// @param pixels red, green, blue and perhaps opacity of each pixel, the top row first
/// @param resolution width and height
/// @param options 1: pixels are not interpolated, 2: applied as a decal, 16: with opacities, 32: mirrored, 64: the bottom row is the first
/// @return textureId of the image
#[api("swanilda.library.applyTexture")]
fn apply_texture(
    cx: &mut Cx,
    shape_handle: Handle,
    coordinates: Vec<f64>,
    pixels: Bytes,
    resolution: [f64; 2],
    options: Number,
) -> Result<i64> {
    let corners = {
        let scene = cx.scene();
        let shape = scene.object(shape_handle)?.shape()?;
        let [part] = &shape.parts[..] else {
            return Err(SceneError::InvalidData.into());
        };
        part.mesh.flat_indices().len()
    };
    // The same options have other bits where a shape is made.
    let kept = options.0 & !(1 | 2);
    let options = MeshOptions::from_bits_retain(kept | (options.0 & (1 | 2)) << 2);
    let mapping = texture::of_mesh(cx, options, &coordinates, corners, pixels.0, resolution)?;
    let id = mapping.source.raw();
    cx.scene_mut()
        .set_shape_texture(shape_handle, Some(mapping))?;
    Ok(id)
}

/// How many numbers an item of a drawing object has.
///
/// @param drawingObjectHandle the drawing object
/// @return size
#[api("swanilda.library.drawingItemSize")]
fn drawing_item_size(cx: &Cx, drawing_object_handle: Number) -> Result<i64> {
    let scene = cx.scene();
    let drawing = scene
        .drawings()
        .get(drawing_object_handle.0 & HANDLE_BITS)?;
    Ok(numbers::count(drawing.item_len()))
}

/// How many numbers a particle has.
///
/// @param particleObjectHandle the particle object
/// @return size
#[api("swanilda.library.particleItemSize")]
fn particle_item_size(cx: &Cx, particle_object_handle: Number) -> Result<i64> {
    let scene = cx.scene();
    let object = scene.drawings().particles().get(particle_object_handle.0)?;
    Ok(numbers::count(object.item_len()))
}

/// Names a new object as V-REP does: `Vision_sensor`, and where there is one already `Vision_sensor0`.
///
/// @param objectHandle the object
#[api("swanilda.library.giveOldName")]
fn give_old_name(cx: &mut Cx, object_handle: Handle) -> Result<()> {
    let name = default_name(cx.scene().object(object_handle)?);
    Ok(cx.scene_mut().set_old_name(object_handle, name)?)
}

/// The script that is meant by its handle, or by its type with the name of its object or its own behind the last `@` of a text.
///
/// @param text the name of a function, or code
/// @param scriptHandleOrType the script, or sim.scripttype_*
/// @return scriptHandle the script
/// @return text without the name
#[api("swanilda.library.callee")]
fn callee(cx: &Cx, text: Bytes, script_handle_or_type: i64) -> Result<(i64, Text)> {
    let (script, length) = callee_at_end(cx, script_handle_or_type, &text.0)?;
    let mut text = text.0;
    text.truncate(length);
    Ok((script.id, Text(text)))
}

/// All scripts.
///
/// @return scriptHandles those that are objects last
#[api("swanilda.library.scripts")]
fn scripts(cx: &Cx) -> Result<Vec<i64>> {
    let mut handles = cx.detached_scripts();
    let scene = cx.scene();
    let objects = scene
        .objects()
        .filter(|object| matches!(object.kind, Kind::Script(_)));
    handles.extend(objects.map(|object| object.handle().raw()));
    Ok(handles)
}

/// Whether a simulation in real-time mode has to step now to keep up with the clock.
///
/// @return isNeeded
#[api("swanilda.library.isStepNeeded")]
fn is_step_needed(cx: &Cx) -> Result<bool> {
    Ok(cx.real_time_step_is_due())
}
