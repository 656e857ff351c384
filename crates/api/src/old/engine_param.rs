//! `sim.*`: parameters of physics engines (deprecated names).

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::parameters::engine::is_step_size;
use scene::{Handle, SceneError};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_engine_float_param,
    set_engine_float_param,
    get_engine_int32_param,
    set_engine_int32_param,
    get_engine_bool_param,
    set_engine_bool_param,
];

/// The object of a parameter; none for negative numbers, which mean the engine itself.
fn target(handle: Number) -> Result<Option<Handle>> {
    match handle.0 {
        ..0 => Ok(None),
        raw => Ok(Some(Handle::from_raw(raw).ok_or(SceneError::NoSuchObject)?)),
    }
}

fn set(cx: &mut Cx, number: i64, target: Option<Handle>, value: f64) -> Result<()> {
    if is_step_size(number) && value.is_finite() {
        cx.set_physics_step(value);
        return Ok(());
    }
    Ok(cx.scene_mut().set_engine_param(number, target, value)?)
}

/// A float parameter of a physics engine.
///
/// @param paramId sim.bullet_*, sim.ode_*, sim.newton_*, sim.mujoco_*, ...
/// @param objectHandle a shape, joint or dummy; -1 for a global parameter
/// @return floatParam the value
#[api("sim.getEngineFloatParam")]
fn get_engine_float_param(cx: &Cx, param_id: Number, object_handle: Number) -> Result<f64> {
    Ok(cx
        .scene()
        .engine_param(param_id.0, target(object_handle)?)?)
}

/// Sets a float parameter of a physics engine. The step size changes only while the simulation is stopped.
///
/// @param paramId sim.bullet_*, sim.ode_*, sim.newton_*, sim.mujoco_*, ...
/// @param objectHandle a shape, joint or dummy; -1 for a global parameter
/// @param floatParam the value
/// @return result 1
#[api("sim.setEngineFloatParam")]
fn set_engine_float_param(
    cx: &mut Cx,
    param_id: Number,
    object_handle: Number,
    float_param: f64,
) -> Result<i64> {
    let target = target(object_handle)?;
    set(cx, param_id.0, target, float_param)?;
    Ok(1)
}

/// An integer parameter of a physics engine.
///
/// @param paramId sim.bullet_*, sim.ode_*, sim.newton_*, sim.mujoco_*, ...
/// @param objectHandle a shape, joint or dummy; -1 for a global parameter
/// @return int32Param the value
#[api("sim.getEngineInt32Param")]
fn get_engine_int32_param(cx: &Cx, param_id: Number, object_handle: Number) -> Result<i64> {
    Ok(numbers::truncated(
        cx.scene()
            .engine_param(param_id.0, target(object_handle)?)?,
    ))
}

/// Sets an integer parameter of a physics engine.
///
/// @param paramId sim.bullet_*, sim.ode_*, sim.newton_*, sim.mujoco_*, ...
/// @param objectHandle a shape, joint or dummy; -1 for a global parameter
/// @param int32Param the value
/// @return result 1
#[api("sim.setEngineInt32Param")]
fn set_engine_int32_param(
    cx: &mut Cx,
    param_id: Number,
    object_handle: Number,
    int32_param: Number,
) -> Result<i64> {
    let target = target(object_handle)?;
    set(cx, param_id.0, target, int32_param.0 as f64)?;
    Ok(1)
}

/// A switch of a physics engine.
///
/// @param paramId sim.bullet_*, sim.ode_*, sim.newton_*, sim.mujoco_*, ...
/// @param objectHandle a shape, joint or dummy; -1 for a global parameter
/// @return boolParam the value
#[api("sim.getEngineBoolParam")]
fn get_engine_bool_param(cx: &Cx, param_id: Number, object_handle: Number) -> Result<bool> {
    Ok(cx
        .scene()
        .engine_param(param_id.0, target(object_handle)?)?
        != 0.0)
}

/// Sets a switch of a physics engine.
///
/// @param paramId sim.bullet_*, sim.ode_*, sim.newton_*, sim.mujoco_*, ...
/// @param objectHandle a shape, joint or dummy; -1 for a global parameter
/// @param boolParam the value
/// @return result 1
#[api("sim.setEngineBoolParam")]
fn set_engine_bool_param(
    cx: &mut Cx,
    param_id: Number,
    object_handle: Number,
    bool_param: bool,
) -> Result<i64> {
    let target = target(object_handle)?;
    set(cx, param_id.0, target, f64::from(u8::from(bool_param)))?;
    Ok(1)
}
