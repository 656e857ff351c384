//! `sim.*`: numbered parameters of objects (deprecated names). Which there are is said in `scene`, by type.
//!
//! A parameter an object does not have is no error: getters return nothing, setters do nothing.

use api_macro::api;

use super::{ApiFn, Cx, Result, functions};
use crate::scene::Handle;
use crate::script::{Bytes, Number, Text};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_object_int32_param,
    set_object_int32_param,
    get_object_float_param,
    set_object_float_param,
    get_object_float_array_param,
    set_object_float_array_param,
    get_object_string_param,
    set_object_string_param,
];

/// Integer parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objintparam_*, sim.shapeintparam_*, ...
/// @return parameter nothing if the object has no such parameter
#[api("sim.getObjectInt32Param")]
fn get_object_int32_param(cx: &Cx, object_handle: Handle, parameter_id: Number) -> Result<Option<i64>> {
    Ok(cx.scene().int_param(object_handle, parameter_id.0)?)
}

/// Sets an integer parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objintparam_*, sim.shapeintparam_*, ...
/// @param parameter the value
/// @return result 1, or 0 when the object has no such parameter
#[api("sim.setObjectInt32Param")]
fn set_object_int32_param(cx: &mut Cx, object_handle: Handle, parameter_id: Number, parameter: Number) -> Result<i64> {
    Ok(i64::from(cx.scene_mut().set_int_param(object_handle, parameter_id.0, parameter.0)?))
}

/// Float parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objfloatparam_*, sim.jointfloatparam_*, ...
/// @return parameter nothing if the object has no such parameter
#[api("sim.getObjectFloatParam")]
fn get_object_float_param(cx: &Cx, object_handle: Handle, parameter_id: Number) -> Result<Option<f64>> {
    Ok(cx.scene().float_param(object_handle, parameter_id.0)?)
}

/// Sets a float parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objfloatparam_*, sim.jointfloatparam_*, ...
/// @param parameter the value
/// @return result 1, or 0 when the object has no such parameter
#[api("sim.setObjectFloatParam")]
fn set_object_float_param(cx: &mut Cx, object_handle: Handle, parameter_id: Number, parameter: f64) -> Result<i64> {
    Ok(i64::from(cx.scene_mut().set_kind_float_param(object_handle, parameter_id.0, parameter)?))
}

/// Parameter of an object that is a list of numbers. No object has one.
///
/// @param objectHandle the object
/// @param parameterID its number
/// @return params nothing
#[api("sim.getObjectFloatArrayParam")]
fn get_object_float_array_param(cx: &Cx, object_handle: Handle, _parameter_id: Number) -> Result<Option<Vec<f64>>> {
    cx.scene().object(object_handle)?;
    Ok(None)
}

/// Sets a parameter of an object that is a list of numbers. No object has one, so this does nothing.
///
/// @param objectHandle the object
/// @param parameterID its number
/// @param params the values
#[api("sim.setObjectFloatArrayParam")]
fn set_object_float_array_param(
    cx: &mut Cx,
    object_handle: Handle,
    _parameter_id: Number,
    _params: Vec<f64>,
) -> Result<()> {
    cx.scene().object(object_handle)?;
    Ok(())
}

/// Text parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objstringparam_*, sim.dummystringparam_*, sim.shapestringparam_*
/// @return parameter nothing if the object has no such parameter
#[api("sim.getObjectStringParam")]
fn get_object_string_param(cx: &Cx, object_handle: Handle, parameter_id: Number) -> Result<Option<Text>> {
    Ok(cx.scene().string_param(object_handle, parameter_id.0)?.map(Text))
}

/// Sets a text parameter of an object. One it does not have, or that can only be read, is left alone.
///
/// @param objectHandle the object
/// @param parameterID sim.dummystringparam_*, sim.shapestringparam_*
/// @param parameter the text
#[api("sim.setObjectStringParam")]
fn set_object_string_param(cx: &mut Cx, object_handle: Handle, parameter_id: Number, parameter: Bytes) -> Result<()> {
    cx.scene_mut().set_string_param(object_handle, parameter_id.0, &parameter.0)?;
    Ok(())
}
