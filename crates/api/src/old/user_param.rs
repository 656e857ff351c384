//! `sim.*`: parameters of the old parameter dialog, texts that a script or an object carries (deprecated).

use api_macro::api;

use crate::scripts::script::script_of;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::{Data, Field, Handle, Scene, special};
use script::{Number, Results};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_script_simulation_parameter,
    set_script_simulation_parameter,
    get_user_parameter,
    set_user_parameter,
];

/// A parameter of a script, or of the object the script is attached to.
///
/// @param scriptHandle the script, or sim.handle_self
/// @param parameterName its name
/// @param forceStringReturn return a string; otherwise texts such as `true` and `12` are converted
/// @return value nil when there is no such parameter
#[api("sim.getScriptSimulationParameter")]
fn get_script_simulation_parameter(
    cx: &Cx,
    script_handle: Number,
    parameter_name: String,
    #[default(false)] force_string_return: bool,
) -> Result<Results> {
    let hosts = hosts(cx, script_handle)?;
    let scene = cx.scene();
    let text = hosts.into_iter().find_map(|object| find(&scene, object, &parameter_name));
    Ok(Results(vec![value(text, force_string_return)]))
}

/// Sets a parameter of a script, or of the object the script is attached to if that has it.
///
/// @param scriptHandle the script, sim.handle_self, or all below this script's object (sim.handle_tree) or above it (sim.handle_chain) that
/// have the parameter
/// @param parameterName its name
/// @param parameterValue its text
/// @return result how many have it now
#[api("sim.setScriptSimulationParameter")]
fn set_script_simulation_parameter(
    cx: &mut Cx,
    script_handle: Number,
    parameter_name: String,
    parameter_value: String,
) -> Result<i64> {
    if [special::TREE, special::CHAIN].contains(&script_handle.0) {
        return set_all(cx, script_handle.0 == special::TREE, &parameter_name, &parameter_value);
    }
    let hosts = hosts(cx, script_handle)?;
    let owner = hosts.iter().rev().find(|&&host| find(&cx.scene(), host, &parameter_name).is_some());
    let owner = *owner.or(hosts.first()).ok_or(ApiError::NoSuchScript)?;
    set(cx, owner, parameter_name, parameter_value)
}

/// A parameter of an object.
///
/// @param objectHandle the object
/// @param parameterName its name
/// @return value nil when there is no such parameter; `true`, `12` and the like come as what they look like
#[api("sim.getUserParameter")]
fn get_user_parameter(cx: &Cx, object_handle: Handle, parameter_name: String) -> Result<Results> {
    cx.scene().object(object_handle)?;
    let text = find(&cx.scene(), object_handle, &parameter_name);
    Ok(Results(vec![value(text, false)]))
}

/// Sets a parameter of an object.
///
/// @param objectHandle the object
/// @param parameterName its name
/// @param parameterValue its text
/// @return result 1
#[api("sim.setUserParameter")]
fn set_user_parameter(
    cx: &mut Cx,
    object_handle: Handle,
    parameter_name: String,
    parameter_value: String,
) -> Result<i64> {
    set(cx, object_handle, parameter_name, parameter_value)
}

/// The objects that may hold the parameters of a script: its own, and the one it is attached to. At least one.
fn hosts(cx: &Cx, script_handle: Number) -> Result<Vec<Handle>> {
    let script = script_of(cx, script_handle.0)?;
    let attached_to = match script.object {
        Some(object) => cx.scene().object(object)?.parent(),
        None => script.owner(),
    };
    let hosts: Vec<Handle> = [script.object, attached_to].into_iter().flatten().collect();
    if hosts.is_empty() { Err(ApiError::NoSuchScript) } else { Ok(hosts) }
}

/// Sets a parameter where it is, below or above the object of the calling script.
fn set_all(cx: &mut Cx, below: bool, name: &str, text: &str) -> Result<i64> {
    let own = *hosts(cx, Number(special::SELF))?.last().ok_or(ApiError::NoSuchScript)?;
    let all = {
        let scene = cx.scene();
        let near: Vec<Handle> =
            if below { scene.tree(Some(own), false)? } else { scene.ancestors(own).chain([own]).collect() };
        near.into_iter().filter(|&object| find(&scene, object, name).is_some()).collect::<Vec<_>>()
    };
    for &object in &all {
        set(cx, object, name.to_owned(), text.to_owned())?;
    }
    Ok(all.len() as i64)
}

fn find(scene: &Scene, object: Handle, name: &str) -> Option<String> {
    let params = &scene.object(object).ok()?.user_params;
    params.iter().find(|(known, _)| known == name).map(|(_, text)| text.clone())
}

fn set(cx: &mut Cx, object: Handle, name: String, text: String) -> Result<i64> {
    cx.scene_mut().modify(object, Field::Other, |object| {
        object.user_params.retain(|(known, _)| *known != name);
        object.user_params.push((name, text));
    })?;
    Ok(1)
}

/// The text, or what it looks like.
fn value(text: Option<String>, as_text: bool) -> Data {
    let Some(text) = text else { return Data::Nil };
    if as_text {
        return Data::text(&text);
    }
    match text.as_str() {
        "nil" => Data::Nil,
        "true" => Data::Bool(true),
        "false" => Data::Bool(false),
        _ => {
            text.parse().map(Data::Int).or_else(|_| text.parse().map(Data::Float)).unwrap_or_else(|_| Data::text(&text))
        }
    }
}
