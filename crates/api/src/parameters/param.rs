//! `sim.*`: numbered parameters of the simulator and named parameters of the application.
//!
//! Parameters of the user interface are stored and read back, and have no other effect. Unknown numbers are refused.

use std::ffi::OsStr;
use std::path::Path;

use api_macro::api;
use geometry::pose::euler;

use super::param_property::{self, FLOATS, INTEGERS, LEVELS, LIGHT, SWITCHES, TEXTS};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::Calculations;
use scene::numbers;
use script::{Bytes, Color, Number, PropertyTarget, PropertyValue, Text};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_int32_param,
    set_int32_param,
    get_bool_param,
    set_bool_param,
    get_float_param,
    set_float_param,
    get_array_param,
    set_array_param,
    get_string_param,
    set_string_param,
    get_named_string_param,
    set_named_string_param,
    handle_ext_calls,
];

/// `sim.intparam_*` that are no property.
mod int {
    pub const ERROR_REPORT_MODE: i64 = 0;
    pub const PROGRAM_VERSION: i64 = 1;
    pub const DYNAMIC_ENGINE: i64 = 8;
    pub const EDIT_MODE_TYPE: i64 = 14;
    pub const PROGRAM_REVISION: i64 = 30;
    pub const LAST: i64 = 53;
}

/// The release that scripts see: 4.10.0 rev. 0.
const PROGRAM_VERSION: i64 = 41_000;

/// Bit of the error report mode: refused calls raise errors.
const REPORT_ERRORS: i64 = 1;

/// `sim.boolparam_*` that are no property and have a meaning here, or read true.
mod switch {
    pub const COLLISION: i64 = 2;
    pub const DISTANCE: i64 = 3;
    pub const INVERSE_KINEMATICS: i64 = 4;
    /// Closed loops of V-REP, which its inverse kinematics replaced.
    pub const CLOSED_LOOPS: i64 = 5;
    pub const PROXIMITY_SENSORS: i64 = 9;
    pub const VISION_SENSORS: i64 = 10;
    pub const HEADLESS: i64 = 34;
    pub const EXIT_REQUEST: i64 = 41;
    pub const WAITING_FOR_TRIGGER: i64 = 45;
    pub const USING_SCRIPT_OBJECTS: i64 = 61;
    pub const LAST: i64 = 61;
}

/// `sim.floatparam_*`.
mod float {
    pub const RANDOM: i64 = 0;
    const MAX_TRIANGLE_SIZE: i64 = 6;
    const MIN_RELATIVE_TRIANGLE_SIZE: i64 = 7;
    pub const LAST: i64 = 7;

    /// The value before a script sets one.
    pub fn initial(number: i64) -> f64 {
        match number {
            MAX_TRIANGLE_SIZE => 0.3,
            MIN_RELATIVE_TRIANGLE_SIZE => 0.02,
            _ => 0.0,
        }
    }
}

/// `sim.arrayparam_*`.
mod array {
    pub const GRAVITY: i64 = 0;
    pub const AMBIENT_LIGHT: i64 = 5;
    pub const RANDOM_EULER: i64 = 6;
    pub const LAST: i64 = 8;
}

/// `sim.stringparam_*`.
mod string {
    /// Folder of the scene's file, and its name with extension.
    pub const SCENE_FOLDER: i64 = 14;
    pub const SCENE_NAME: i64 = 15;
    pub const LAST: i64 = 144;
}

fn known(number: i64, last: i64) -> Result<i64> {
    if (0..=last).contains(&number) {
        Ok(number)
    } else {
        Err(ApiError::Other("invalid parameter.".into()))
    }
}

/// An integer parameter.
///
/// @param parameter sim.intparam_*
/// @return parameterValue
#[api("sim.getInt32Param")]
fn get_int32_param(cx: &Cx, parameter: Number) -> Result<i64> {
    if let Some(value) = param_property::read(cx, INTEGERS, parameter.0)? {
        return Ok(value);
    }
    Ok(match parameter.0 {
        int::ERROR_REPORT_MODE => cx.env().raises_errors.get().into(),
        int::PROGRAM_VERSION => PROGRAM_VERSION,
        int::PROGRAM_REVISION | int::EDIT_MODE_TYPE => 0,
        int::DYNAMIC_ENGINE => cx.scene().settings().dynamics.engine.engine.number(),
        other => {
            let number = known(other, int::LAST)?;
            cx.app()
                .idle_params
                .integers
                .get(&number)
                .copied()
                .unwrap_or_default()
        }
    })
}

/// Sets an integer parameter.
///
/// @param parameter sim.intparam_*
/// @param parameterValue the new value
/// @return result 1
#[api("sim.setInt32Param")]
fn set_int32_param(cx: &mut Cx, parameter: Number, parameter_value: Number) -> Result<i64> {
    let value = parameter_value.0;
    if param_property::write(cx, INTEGERS, parameter.0, value)? {
        return Ok(1);
    }
    match parameter.0 {
        int::ERROR_REPORT_MODE => cx.env().raises_errors.set(value & REPORT_ERRORS != 0),
        int::DYNAMIC_ENGINE => cx.set_engine(value, 0)?,
        other => {
            let number = known(other, int::LAST)?;
            cx.app_mut().idle_params.integers.insert(number, value);
        }
    }
    Ok(1)
}

/// A switch.
///
/// @param parameter sim.boolparam_*
/// @return boolState
#[api("sim.getBoolParam")]
fn get_bool_param(cx: &Cx, parameter: Number) -> Result<bool> {
    if let Some(value) = param_property::read(cx, SWITCHES, parameter.0)? {
        return Ok(value);
    }
    Ok(match parameter.0 {
        switch::EXIT_REQUEST => cx.clock().quit_is_requested(),
        switch::WAITING_FOR_TRIGGER => cx.clock().is_waiting_for_trigger(),
        switch::HEADLESS | switch::USING_SCRIPT_OBJECTS => true,
        switch::COLLISION => cx.scene().settings().calculations.collision,
        switch::DISTANCE => cx.scene().settings().calculations.distance,
        switch::PROXIMITY_SENSORS => cx.scene().settings().calculations.proximity_sensors,
        switch::INVERSE_KINEMATICS => cx.scene().settings().calculations.inverse_kinematics,
        other => {
            let number = known(other, switch::LAST)?;
            let initially = [switch::CLOSED_LOOPS, switch::VISION_SENSORS].contains(&number);
            cx.app()
                .idle_params
                .bools
                .get(&number)
                .copied()
                .unwrap_or(initially)
        }
    })
}

/// Whether sensors are handled at all: `parameter` is one of sim.boolparam_*_sensor_handling_enabled.
pub(crate) fn sensors_are_handled(cx: &Cx, parameter: i64) -> bool {
    cx.app()
        .idle_params
        .bools
        .get(&parameter)
        .copied()
        .unwrap_or(true)
}

/// Turns a switch on or off.
///
/// @param parameter sim.boolparam_*
/// @param boolState the new state
/// @return result 1
#[api("sim.setBoolParam")]
fn set_bool_param(cx: &mut Cx, parameter: Number, bool_state: bool) -> Result<i64> {
    if param_property::write(cx, SWITCHES, parameter.0, bool_state)? {
        return Ok(1);
    }
    match parameter.0 {
        switch::EXIT_REQUEST => cx.request_quit(bool_state),
        switch::COLLISION => switch_calculation(cx, |on| on.collision = bool_state),
        switch::DISTANCE => switch_calculation(cx, |on| on.distance = bool_state),
        switch::PROXIMITY_SENSORS => switch_calculation(cx, |on| on.proximity_sensors = bool_state),
        switch::INVERSE_KINEMATICS => {
            switch_calculation(cx, |on| on.inverse_kinematics = bool_state);
        }
        other => {
            let number = known(other, switch::LAST)?;
            cx.app_mut().idle_params.bools.insert(number, bool_state);
        }
    }
    Ok(1)
}

fn switch_calculation(cx: &mut Cx, switch: impl FnOnce(&mut Calculations)) {
    cx.scene_mut()
        .modify_settings(|settings| switch(&mut settings.calculations));
}

/// A float parameter.
///
/// @param parameter sim.floatparam_*
/// @return parameterValue
#[api("sim.getFloatParam")]
fn get_float_param(cx: &Cx, parameter: Number) -> Result<f64> {
    if let Some(value) = param_property::read(cx, FLOATS, parameter.0)? {
        return Ok(value);
    }
    Ok(match parameter.0 {
        float::RANDOM => cx.env().random.borrow_mut().next(),
        other => {
            let number = known(other, float::LAST)?;
            cx.app()
                .idle_params
                .floats
                .get(&number)
                .copied()
                .unwrap_or_else(|| float::initial(number))
        }
    })
}

/// Sets a float parameter. Time steps change only while the simulation is stopped.
///
/// @param parameter sim.floatparam_*
/// @param parameterValue the new value
/// @return result 1
#[api("sim.setFloatParam")]
fn set_float_param(cx: &mut Cx, parameter: Number, parameter_value: f64) -> Result<i64> {
    if !param_property::write(cx, FLOATS, parameter.0, parameter_value)? {
        let number = known(parameter.0, float::LAST)?;
        cx.app_mut()
            .idle_params
            .floats
            .insert(number, parameter_value);
    }
    Ok(1)
}

/// A parameter of three numbers.
///
/// @param parameter sim.arrayparam_*
/// @return parameterValues
#[api("sim.getArrayParam")]
fn get_array_param(cx: &Cx, parameter: Number) -> Result<[f64; 3]> {
    Ok(match parameter.0 {
        array::GRAVITY => cx.scene().settings().dynamics.gravity.map(f64::from),
        array::AMBIENT_LIGHT => param_property::read(cx, LIGHT, array::AMBIENT_LIGHT)?
            .map_or([0.0; 3], |light: Color| light.0),
        array::RANDOM_EULER => euler::rotation_to_euler(&cx.env().random.borrow_mut().rotation()),
        other => {
            let number = known(other, array::LAST)?;
            cx.app()
                .idle_params
                .arrays
                .get(&number)
                .copied()
                .unwrap_or_default()
        }
    })
}

/// Sets a parameter of three numbers.
///
/// @param parameter sim.arrayparam_*
/// @param parameterValues the new values
/// @return result 1
#[api("sim.setArrayParam")]
fn set_array_param(cx: &mut Cx, parameter: Number, parameter_values: [f64; 3]) -> Result<i64> {
    match parameter.0 {
        array::AMBIENT_LIGHT => {
            param_property::write(cx, LIGHT, array::AMBIENT_LIGHT, Color(parameter_values))?;
        }
        array::GRAVITY => {
            let gravity = parameter_values.map(numbers::single);
            cx.scene_mut()
                .modify_settings(|settings| settings.dynamics.gravity = gravity);
        }
        other => {
            let number = known(other, array::LAST)?;
            cx.app_mut()
                .idle_params
                .arrays
                .insert(number, parameter_values);
        }
    }
    Ok(1)
}

/// A string parameter; empty if it has no value in Swanilda.
///
/// @param parameter sim.stringparam_*
/// @return parameterValue
#[api("sim.getStringParam")]
fn get_string_param(cx: &Cx, parameter: Number) -> Result<Text> {
    if let Some(value) = param_property::read(cx, TEXTS, parameter.0)? {
        return Ok(value);
    }
    let number = known(parameter.0, string::LAST)?;
    let path = |part: fn(&Path) -> Option<&OsStr>| {
        part(Path::new(&cx.scene().settings().path))
            .map(|part| Text(part.as_encoded_bytes().to_vec()))
    };
    Ok(match number {
        string::SCENE_FOLDER => {
            path(|path| path.parent().map(Path::as_os_str)).unwrap_or(Text(Vec::new()))
        }
        string::SCENE_NAME => path(Path::file_name).unwrap_or(Text(Vec::new())),
        _ => Text(
            cx.app()
                .idle_params
                .texts
                .get(&number)
                .cloned()
                .unwrap_or_default(),
        ),
    })
}

/// Sets a string parameter.
///
/// @param parameter sim.stringparam_*
/// @param parameterValue the new value
/// @return result 1
#[api("sim.setStringParam")]
fn set_string_param(cx: &mut Cx, parameter: Number, parameter_value: Bytes) -> Result<i64> {
    let number = known(parameter.0, string::LAST)?;
    if param_property::write(cx, TEXTS, number, Text(parameter_value.0.clone()))? {
        return Ok(1);
    }
    param_property::write(cx, LEVELS, number, Text(parameter_value.0.clone()))?;
    cx.app_mut()
        .idle_params
        .texts
        .insert(number, parameter_value.0);
    Ok(1)
}

/// A named parameter: from the command line, or set by a script.
///
/// @param paramName its name
/// @return stringParam nothing if there is none
#[api("sim.getNamedStringParam")]
fn get_named_string_param(cx: &Cx, param_name: String) -> Result<Option<Text>> {
    let value = cx.read_property(
        &PropertyTarget::App,
        &format!("namedParam.{param_name}"),
        Text::TYPE,
    );
    Ok(value.ok().and_then(Text::from_data))
}

/// Sets a named parameter.
///
/// @param paramName its name
/// @param stringParam the new value
/// @return result 1
#[api("sim.setNamedStringParam")]
fn set_named_string_param(cx: &mut Cx, param_name: String, string_param: Text) -> Result<i64> {
    let value = (Text::TYPE, string_param.into_data());
    cx.write_property(
        &PropertyTarget::App,
        &format!("namedParam.{param_name}"),
        value,
    )?;
    Ok(1)
}

/// Calls the handlers of what came from outside: what persons did with windows (simUI). It happens at the end of each loop iteration anyway.
#[api("sim.handleExtCalls")]
fn handle_ext_calls(cx: &mut Cx) -> Result<()> {
    cx.deliver_ui_events();
    Ok(())
}
