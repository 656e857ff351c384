//! `sim.*`: colours of shapes and other objects.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::appearance::colour::{ColourComponent, ColourName};
use scene::numbers;
use scene::{Data, Handle, SceneError};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_shape_color,
    set_shape_color,
    get_object_color,
    set_object_color
];

fn component(code: Number) -> Result<ColourComponent> {
    ColourComponent::from_code(code.0).ok_or(ApiError::Scene(SceneError::InvalidArgument))
}

/// A colour of a shape.
///
/// @param shapeHandle the shape
/// @param colorName nil: the first mesh; a name: the first mesh whose colour has that name; '@compound': of each mesh
/// @param colorComponent sim.colorcomponent_*
/// @return result 1, or 0 when no mesh is called so
/// @return rgbData red, green, blue; one number for transparency, 1 for opaque
#[api("sim.getShapeColor")]
fn get_shape_color(
    cx: &Cx,
    shape_handle: Handle,
    color_name: Option<String>,
    color_component: Number,
) -> Result<(i64, Vec<f64>)> {
    let scene = cx.scene();
    let shape = scene.object(shape_handle)?.shape()?;
    let Some(component) = ColourComponent::from_code(color_component.0) else {
        return Ok((0, vec![0.0; 3]));
    };
    let colour = shape.colour(&ColourName::from_script(color_name), component);
    Ok(colour.map_or_else(|| (0, vec![0.0; component.width()]), |colour| (1, colour)))
}

/// Colours a shape.
///
/// @param shapeHandle the shape; scripts from before 3.1.4 put '@backCompatibility1:' before it
/// @param colorName nil: every mesh; a name: meshes whose colour has that name; '@compound': a colour for each mesh
/// @param colorComponent sim.colorcomponent_*
/// @param rgbData red, green, blue; one number for transparency, 1 for opaque
/// @return result 1
#[api("sim.setShapeColor")]
fn set_shape_color(
    cx: &mut Cx,
    shape_handle: Data,
    color_name: Option<String>,
    color_component: Number,
    rgb_data: Vec<f64>,
) -> Result<i64> {
    let component = component(color_component)?;
    if rgb_data.len() < component.width() {
        return Err(ApiError::TableSize);
    }
    let shape_handle = marked_shape(cx, &shape_handle)?;
    cx.scene_mut().set_shape_colour(
        shape_handle,
        &ColourName::from_script(color_name),
        component,
        &rgb_data,
    )?;
    Ok(1)
}

/// A colour of an object.
///
/// @param objectHandle the object
/// @param index which mesh of a shape, from 0
/// @param colorComponent sim.colorcomponent_*
/// @return rgbData red, green, blue; nothing when the object has no such colour
#[api("sim.getObjectColor")]
fn get_object_color(
    cx: &Cx,
    object_handle: Handle,
    index: Number,
    color_component: Number,
) -> Result<Option<Vec<f64>>> {
    let Ok(index) = usize::try_from(index.0) else {
        return Ok(None);
    };
    Ok(cx
        .scene()
        .object_colour(object_handle, index, component(color_component)?)?)
}

/// Colours an object.
///
/// @param objectHandle the object
/// @param index which mesh of a shape, from 0
/// @param colorComponent sim.colorcomponent_*
/// @param rgbData red, green, blue
/// @return result false when the object has no such colour
#[api("sim.setObjectColor")]
fn set_object_color(
    cx: &mut Cx,
    object_handle: Handle,
    index: Number,
    color_component: Number,
    rgb_data: Vec<f64>,
) -> Result<bool> {
    let component = component(color_component)?;
    if rgb_data.len() < component.width() {
        return Err(ApiError::TableSize);
    }
    let Ok(index) = usize::try_from(index.0) else {
        return Ok(false);
    };
    Ok(cx
        .scene_mut()
        .set_object_colour(object_handle, index, component, &rgb_data)?)
}

/// The shape a handle means, which scripts of old scenes mark.
fn marked_shape(cx: &Cx, handle: &Data) -> Result<Handle> {
    let number = match handle {
        Data::Text(text) => std::str::from_utf8(text).ok().and_then(|text| {
            text.strip_prefix("@backCompatibility1:")
                .unwrap_or(text)
                .parse::<f64>()
                .ok()
        }),
        other => other.as_f64(),
    };
    let number = number.ok_or(ApiError::NotA {
        position: 1,
        expected: "number",
    })?;
    let handle = Handle::from_raw(numbers::truncated(number)).ok_or(SceneError::NoSuchObject)?;
    Ok(cx.scene().object(handle)?.handle())
}
