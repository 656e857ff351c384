//! `sim.*`: numbered parameters of objects (deprecated names).

use api_macro::api;

use super::{ApiFn, Cx, Result, functions};
use crate::scene::Handle;
use crate::script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] =
    functions![get_object_int32_param, set_object_int32_param, get_object_float_param, set_object_float_param,];

/// An integer parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objintparam_*, sim.shapeintparam_*, sim.jointintparam_*, ...
/// @return parameter nothing when the object has no such parameter
#[api("sim.getObjectInt32Param")]
fn get_object_int32_param(cx: &Cx, object_handle: Handle, parameter_id: Number) -> Result<Option<i64>> {
    Ok(cx.scene().kind_int_param(object_handle, parameter_id.0)?)
}

/// Sets an integer parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objintparam_*, sim.shapeintparam_*, sim.jointintparam_*, ...
/// @param parameter the value
/// @return result 1, or 0 when the object has no such parameter
#[api("sim.setObjectInt32Param")]
fn set_object_int32_param(cx: &mut Cx, object_handle: Handle, parameter_id: Number, parameter: Number) -> Result<i64> {
    Ok(i64::from(cx.scene_mut().set_kind_int_param(object_handle, parameter_id.0, parameter.0)?))
}

/// A float parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objfloatparam_*, sim.shapefloatparam_*, sim.jointfloatparam_*, ...
/// @return parameter nothing when the object has no such parameter
#[api("sim.getObjectFloatParam")]
fn get_object_float_param(cx: &Cx, object_handle: Handle, parameter_id: Number) -> Result<Option<f64>> {
    Ok(cx.scene().kind_float_param(object_handle, parameter_id.0)?)
}

/// Sets a float parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objfloatparam_*, sim.shapefloatparam_*, sim.jointfloatparam_*, ...
/// @param parameter the value
/// @return result 1, or 0 when the object has no such parameter
#[api("sim.setObjectFloatParam")]
fn set_object_float_param(cx: &mut Cx, object_handle: Handle, parameter_id: Number, parameter: f64) -> Result<i64> {
    Ok(i64::from(cx.scene_mut().set_kind_float_param(object_handle, parameter_id.0, parameter)?))
}
