//! `sim.*`: colours of shapes and other objects.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::appearance::colour::{ColourComponent, ColourName};
use scene::numbers;
use scene::{Data, Handle, SceneError};
use script::{Absence, Args, FromScript, InTurn, Number, Source};

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
/// @param colorName nil: the last mesh; a name: the first mesh whose colour has that name; '@compound': of each mesh
/// @param colorComponent sim.colorcomponent_*
/// @return result 1, or 0 when no mesh is called so
/// @return rgbData red, green, blue; one number for transparency, 1 for opaque
#[api("sim.getShapeColor")]
fn get_shape_color(
    cx: &Cx,
    shape_handle: Handle,
    color_name: Option<String>,
    color_component: InTurn<Number>,
) -> Result<(i64, Vec<f64>)> {
    let scene = cx.scene();
    let shape = scene.object(shape_handle)?.shape()?;
    let Some(component) = ColourComponent::from_code(color_component.0.0) else {
        return Ok((0, vec![0.0; 3]));
    };
    let colour = shape.colour(&ColourName::from_script(color_name), component);
    Ok(colour.map_or_else(|| (0, vec![0.0; component.width()]), |colour| (1, colour)))
}

/// Colours a shape.
///
/// @param shapeHandle the shape; scripts from before 3.1.4 put '@backCompatibility1:' before it
/// @param colorName nil: every mesh; a name: meshes whose colour has that name; '@compound': a colour for each mesh, black for those without one
/// @param colorComponent sim.colorcomponent_*
/// @param rgbData red, green, blue; one number for transparency, 1 for opaque
/// @return result 1
#[api("sim.setShapeColor")]
fn set_shape_color(
    cx: &mut Cx,
    shape_handle: MarkedHandle,
    color_name: Option<String>,
    color_component: InTurn<Number>,
    rgb_data: InTurn<Vec<f64>>,
) -> Result<i64> {
    let component = component(color_component.0)?;
    if rgb_data.0.len() < component.width() {
        return Err(ApiError::TableSize);
    }
    let handle = Handle::from_raw(shape_handle.0).ok_or(SceneError::NoSuchObject)?;
    let shape_handle = cx.scene().object(handle)?.handle();
    cx.scene_mut().set_shape_colour(
        shape_handle,
        &ColourName::from_script(color_name),
        component,
        &rgb_data.0,
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

/// A handle, which scripts of old scenes mark.
struct MarkedHandle(i64);

impl From<MarkedHandle> for Data {
    fn from(MarkedHandle(handle): MarkedHandle) -> Self {
        handle.into()
    }
}

impl FromScript for MarkedHandle {
    const TYPE: &'static str = "int";
    const ABSENCE: Absence = Absence::Decoded;

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let text = String::from_script(args)?;
        let number = text.strip_prefix("@backCompatibility1:").unwrap_or(&text);
        let number: f64 = number.parse().map_err(|_| args.not_a("number"))?;
        Ok(Self(numbers::truncated(number)))
    }
}
