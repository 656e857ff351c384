//! `sim.*`: numbered parameters of objects (deprecated names). `scene` defines them, by object type.
//!
//! A parameter an object does not have is no error: getters return nothing, setters do nothing.

use std::rc::Rc;

use api_macro::api;

use super::script;
use crate::{ApiFn, Cx, Result, functions};
use ::script::{Bytes, Number, Script, Text};
use scene::{Data, Handle, SceneError};

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

/// Parameters of scripts, `sim.scriptintparam_*` and `sim.scriptstringparam_*`.
const SCRIPT_PARAMS: std::ops::RangeInclusive<i64> = 10_100..=10_112;

/// The script a number names, where the parameter is one of scripts: the functions here take scripts that are no objects as well.
fn script(cx: &Cx, raw: i64, parameter: i64) -> Option<Rc<Script>> {
    SCRIPT_PARAMS
        .contains(&parameter)
        .then(|| cx.script_by_handle(raw))
        .flatten()
}

fn object(raw: i64) -> Result<Handle> {
    Ok(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?)
}

/// Integer parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objintparam_*, sim.shapeintparam_*, ...
/// @return parameter nothing if the object has no such parameter
#[api("sim.getObjectInt32Param")]
fn get_object_int32_param(
    cx: &Cx,
    object_handle: Number,
    #[name("parameterID")] parameter_id: Number,
) -> Result<Option<i64>> {
    match script(cx, object_handle.0, parameter_id.0) {
        Some(script) => script::int_param(cx, &script, parameter_id.0).map(Some),
        None => Ok(cx
            .scene()
            .int_param(object(object_handle.0)?, parameter_id.0)?),
    }
}

/// Sets an integer parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objintparam_*, sim.shapeintparam_*, ...
/// @param parameter the value
/// @return result 1, or 0 when the object has no such parameter
#[api("sim.setObjectInt32Param")]
fn set_object_int32_param(
    cx: &mut Cx,
    object_handle: Number,
    #[name("parameterID")] parameter_id: Number,
    parameter: Number,
) -> Result<i64> {
    if let Some(script) = script(cx, object_handle.0, parameter_id.0) {
        script::set_param(cx, &script, parameter_id.0, Data::Int(parameter.0))?;
        return Ok(1);
    }
    let object_handle = object(object_handle.0)?;
    Ok(i64::from(cx.scene_mut().set_int_param(
        object_handle,
        parameter_id.0,
        parameter.0,
    )?))
}

/// Float parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objfloatparam_*, sim.jointfloatparam_*, ...
/// @return parameter nothing if the object has no such parameter
#[api("sim.getObjectFloatParam")]
fn get_object_float_param(
    cx: &Cx,
    object_handle: Handle,
    #[name("parameterID")] parameter_id: Number,
) -> Result<Option<f64>> {
    Ok(cx.scene().float_param(object_handle, parameter_id.0)?)
}

/// Sets a float parameter of an object.
///
/// @param objectHandle the object
/// @param parameterID sim.objfloatparam_*, sim.jointfloatparam_*, ...
/// @param parameter the value
/// @return result 1, or 0 when the object has no such parameter
#[api("sim.setObjectFloatParam")]
fn set_object_float_param(
    cx: &mut Cx,
    object_handle: Handle,
    #[name("parameterID")] parameter_id: Number,
    parameter: f64,
) -> Result<i64> {
    Ok(i64::from(cx.scene_mut().set_kind_float_param(
        object_handle,
        parameter_id.0,
        parameter,
    )?))
}

/// Parameter of an object that is a list of numbers.
///
/// @param objectHandle the object
/// @param parameterID sim.visionfarrayparam_viewfrustum or sim.camerafarrayparam_viewfrustum: half the width, half the height and the distance of
/// the near clipping plane, then those of the far one
/// @return params nothing when the object has no such parameter
#[api("sim.getObjectFloatArrayParam")]
fn get_object_float_array_param(
    cx: &Cx,
    object_handle: Handle,
    #[name("parameterID")] parameter_id: Number,
) -> Result<Option<Vec<f64>>> {
    let scene = cx.scene();
    Ok(scene
        .object(object_handle)?
        .float_array_param(parameter_id.0))
}

/// Sets a parameter of an object that is a list of numbers. No object has one that can be set, so this does nothing.
///
/// @param objectHandle the object
/// @param parameterID its number
/// @param params the values
#[api("sim.setObjectFloatArrayParam")]
fn set_object_float_array_param(
    cx: &mut Cx,
    object_handle: Handle,
    #[name("parameterID")] _parameter_id: Number,
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
fn get_object_string_param(
    cx: &Cx,
    object_handle: Number,
    #[name("parameterID")] parameter_id: Number,
) -> Result<Option<Text>> {
    match script(cx, object_handle.0, parameter_id.0) {
        Some(script) => script::string_param(cx, &script, parameter_id.0),
        None => Ok(cx
            .scene()
            .string_param(object(object_handle.0)?, parameter_id.0)?
            .map(Text)),
    }
}

/// Sets a text parameter of an object. One it does not have, or that can only be read, is left alone.
///
/// @param objectHandle the object
/// @param parameterID sim.dummystringparam_*, sim.shapestringparam_*
/// @param parameter the text
#[api("sim.setObjectStringParam")]
fn set_object_string_param(
    cx: &mut Cx,
    object_handle: Number,
    #[name("parameterID")] parameter_id: Number,
    parameter: Bytes,
) -> Result<()> {
    if let Some(script) = script(cx, object_handle.0, parameter_id.0) {
        return script::set_param(cx, &script, parameter_id.0, Data::Text(parameter.0));
    }
    let object_handle = object(object_handle.0)?;
    cx.scene_mut()
        .set_string_param(object_handle, parameter_id.0, &parameter.0)?;
    Ok(())
}
