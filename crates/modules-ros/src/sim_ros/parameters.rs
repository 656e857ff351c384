//! Parameters, which the master has.

use api_macro::api;
use ros1::XmlRpcValue;
use scene::numbers;

use super::network::Parameter;
use super::node::running;
use super::{ApiFn, Cx, Result, failed, functions};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    get_param_string,
    get_param_int,
    get_param_double,
    get_param_bool,
    set_param_string,
    set_param_int,
    set_param_double,
    set_param_bool,
    has_param,
    delete_param,
    search_param,
];

/// The value of a parameter, if there is one of this type.
fn read<T>(
    cx: &Cx,
    name: &str,
    value: impl Fn(&Parameter) -> Option<T>,
    otherwise: T,
) -> Result<(bool, T)> {
    let parameter = running(cx)?
        .node
        .parameter(name)
        .map_err(|error| failed(&error))?;
    let value = parameter.as_ref().and_then(value);
    Ok(value.map_or((false, otherwise), |value| (true, value)))
}

fn write(cx: &Cx, name: &str, value: XmlRpcValue) -> Result<()> {
    running(cx)?
        .node
        .set_parameter(name, value)
        .map_err(|error| failed(&error))
}

/// A parameter that is a string.
///
/// @param name `/x`, `x` in the node's namespace, or `~x` below the node
/// @param defaultValue what is returned if there is none, or one of another type
/// @return exists
/// @return value
#[api("simROS.getParamString")]
fn get_param_string(
    cx: &mut Cx,
    name: String,
    #[default(String::new())] default_value: String,
) -> Result<(bool, String)> {
    let text = |value: &Parameter| match value {
        Parameter::Text(value) => Some(value.clone()),
        _ => None,
    };
    read(cx, &name, text, default_value)
}

/// A parameter that is an integer; other numbers are rounded.
///
/// @param name as in simROS.getParamString
/// @param defaultValue what is returned if there is none, or one of another type
/// @return exists
/// @return value
#[api("simROS.getParamInt")]
fn get_param_int(
    cx: &mut Cx,
    name: String,
    #[default(0)] default_value: i64,
) -> Result<(bool, i64)> {
    let integer = |value: &Parameter| match value {
        Parameter::Int(value) => Some(i64::from(*value)),
        Parameter::Double(value) => Some(numbers::truncated(value.round())),
        _ => None,
    };
    read(cx, &name, integer, default_value)
}

/// A parameter that is a number.
///
/// @param name as in simROS.getParamString
/// @param defaultValue what is returned if there is none, or one of another type
/// @return exists
/// @return value
#[api("simROS.getParamDouble")]
fn get_param_double(
    cx: &mut Cx,
    name: String,
    #[default(0.0)] default_value: f64,
) -> Result<(bool, f64)> {
    let number = |value: &Parameter| match value {
        Parameter::Int(value) => Some(f64::from(*value)),
        Parameter::Double(value) => Some(*value),
        _ => None,
    };
    read(cx, &name, number, default_value)
}

/// A parameter that is a truth value.
///
/// @param name as in simROS.getParamString
/// @param defaultValue what is returned if there is none, or one of another type
/// @return exists
/// @return value
#[api("simROS.getParamBool")]
fn get_param_bool(
    cx: &mut Cx,
    name: String,
    #[default(false)] default_value: bool,
) -> Result<(bool, bool)> {
    let truth = |value: &Parameter| match value {
        Parameter::Bool(value) => Some(*value),
        _ => None,
    };
    read(cx, &name, truth, default_value)
}

/// Sets a parameter.
///
/// @param name as in simROS.getParamString
/// @param value its value
#[api("simROS.setParamString")]
fn set_param_string(cx: &mut Cx, name: String, value: String) -> Result<()> {
    write(cx, &name, XmlRpcValue::String(value))
}

/// Sets a parameter. Those of ROS 1 have 32 bits.
///
/// @param name as in simROS.getParamString
/// @param value its value; upper bits are cut off
#[api("simROS.setParamInt")]
fn set_param_int(cx: &mut Cx, name: String, value: i64) -> Result<()> {
    write(cx, &name, XmlRpcValue::Int(numbers::low_i32(value)))
}

/// Sets a parameter.
///
/// @param name as in simROS.getParamString
/// @param value its value
#[api("simROS.setParamDouble")]
fn set_param_double(cx: &mut Cx, name: String, value: f64) -> Result<()> {
    write(cx, &name, XmlRpcValue::Double(value))
}

/// Sets a parameter.
///
/// @param name as in simROS.getParamString
/// @param value its value
#[api("simROS.setParamBool")]
fn set_param_bool(cx: &mut Cx, name: String, value: bool) -> Result<()> {
    write(cx, &name, XmlRpcValue::Bool(value))
}

/// Whether there is a parameter.
///
/// @param name as in simROS.getParamString
/// @return exists
#[api("simROS.hasParam")]
fn has_param(cx: &mut Cx, name: String) -> Result<bool> {
    running(cx)?
        .node
        .has_parameter(&name)
        .map_err(|error| failed(&error))
}

/// Removes a parameter, if there is one.
///
/// @param name as in simROS.getParamString
#[api("simROS.deleteParam")]
fn delete_param(cx: &mut Cx, name: String) -> Result<()> {
    match running(cx)?.node.delete_parameter(&name) {
        Err(error) if !error.is_refusal() => Err(failed(&error)),
        _ => Ok(()),
    }
}

/// Searches a parameter in the namespace of the node and in those that contain it.
///
/// @param name a name without a slash at the beginning
/// @return found
/// @return name the full name; empty if there is none
#[api("simROS.searchParam")]
fn search_param(cx: &mut Cx, name: String) -> Result<(bool, String)> {
    let found = running(cx)?
        .node
        .search_parameter(&name)
        .map_err(|error| failed(&error))?;
    Ok((found.is_some(), found.unwrap_or_default()))
}
