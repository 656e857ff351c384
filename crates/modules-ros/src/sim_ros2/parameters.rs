//! Parameters of the node.

use std::collections::BTreeMap;

use api_macro::api;

use super::node::node;
use super::{ApiError, ApiFn, Cx, Result, functions};

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
];

/// The parameters by name.
pub(super) type Parameters = BTreeMap<String, Parameter>;

/// The value of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Parameter {
    Bool(bool),
    Int(i64),
    Double(f64),
    String(String),
}

impl Parameter {
    fn kind(&self) -> &'static str {
        match self {
            Self::Bool(_) => "bool",
            Self::Int(_) => "integer",
            Self::Double(_) => "double",
            Self::String(_) => "string",
        }
    }
}

/// Whether a parameter is there, and its value.
fn read<T: Default>(
    cx: &Cx,
    name: &str,
    kind: &str,
    value: impl Fn(&Parameter) -> Option<T>,
) -> Result<(bool, T)> {
    let node = node(cx);
    let parameters = node.parameters.borrow();
    let Some(parameter) = parameters.get(name) else {
        return Ok((false, T::default()));
    };
    let wrong = || {
        ApiError::Other(format!(
            "parameter '{name}' has another type: expected {kind}, got {}",
            parameter.kind()
        ))
    };
    value(parameter)
        .map(|value| (true, value))
        .ok_or_else(wrong)
}

fn write(cx: &Cx, name: String, value: Parameter) -> Result<()> {
    if name.is_empty() {
        return Err(ApiError::Other("a parameter needs a name".into()));
    }
    node(cx).parameters.borrow_mut().insert(name, value);
    Ok(())
}

/// A parameter that is a string.
///
/// @param name its name
/// @param defaultValue not used, as in CoppeliaSim
/// @return exists
/// @return value empty if it does not exist
#[api("simROS2.getParamString")]
fn get_param_string(
    cx: &Cx,
    name: String,
    #[default(String::new())] _default_value: String,
) -> Result<(bool, String)> {
    read(cx, &name, "string", |value| match value {
        Parameter::String(value) => Some(value.clone()),
        _ => None,
    })
}

/// A parameter that is an integer.
///
/// @param name its name
/// @param defaultValue not used, as in CoppeliaSim
/// @return exists
/// @return value 0 if it does not exist
#[api("simROS2.getParamInt")]
fn get_param_int(cx: &Cx, name: String, #[default(0)] _default_value: i64) -> Result<(bool, i64)> {
    read(cx, &name, "integer", |value| match value {
        Parameter::Int(value) => Some(*value),
        _ => None,
    })
}

/// A parameter that is a number.
///
/// @param name its name
/// @param defaultValue not used, as in CoppeliaSim
/// @return exists
/// @return value 0 if it does not exist
#[api("simROS2.getParamDouble")]
fn get_param_double(
    cx: &Cx,
    name: String,
    #[default(0.0)] _default_value: f64,
) -> Result<(bool, f64)> {
    read(cx, &name, "double", |value| match value {
        Parameter::Double(value) => Some(*value),
        _ => None,
    })
}

/// A parameter that is a truth value.
///
/// @param name its name
/// @param defaultValue not used, as in CoppeliaSim
/// @return exists
/// @return value false if it does not exist
#[api("simROS2.getParamBool")]
fn get_param_bool(
    cx: &Cx,
    name: String,
    #[default(false)] _default_value: bool,
) -> Result<(bool, bool)> {
    read(cx, &name, "bool", |value| match value {
        Parameter::Bool(value) => Some(*value),
        _ => None,
    })
}

/// Sets a parameter.
///
/// @param name its name
/// @param value its value
#[api("simROS2.setParamString")]
fn set_param_string(cx: &mut Cx, name: String, value: String) -> Result<()> {
    write(cx, name, Parameter::String(value))
}

/// Sets a parameter.
///
/// @param name its name
/// @param value its value
#[api("simROS2.setParamInt")]
fn set_param_int(cx: &mut Cx, name: String, value: i64) -> Result<()> {
    write(cx, name, Parameter::Int(value))
}

/// Sets a parameter.
///
/// @param name its name
/// @param value its value
#[api("simROS2.setParamDouble")]
fn set_param_double(cx: &mut Cx, name: String, value: f64) -> Result<()> {
    write(cx, name, Parameter::Double(value))
}

/// Sets a parameter.
///
/// @param name its name
/// @param value its value
#[api("simROS2.setParamBool")]
fn set_param_bool(cx: &mut Cx, name: String, value: bool) -> Result<()> {
    write(cx, name, Parameter::Bool(value))
}

/// Whether there is a parameter.
///
/// @param name its name
/// @return exists
#[api("simROS2.hasParam")]
fn has_param(cx: &Cx, name: String) -> Result<bool> {
    Ok(node(cx).parameters.borrow().contains_key(&name))
}

/// Removes a parameter.
///
/// @param name its name
#[api("simROS2.deleteParam")]
fn delete_param(cx: &mut Cx, name: String) -> Result<()> {
    let removed = node(cx).parameters.borrow_mut().remove(&name);
    removed
        .map(drop)
        .ok_or_else(|| ApiError::Other(format!("parameter '{name}' does not exist")))
}
