//! `sim.*`: parameters of the old parameter dialog, texts that a script or an object carries (deprecated).

use api_macro::api;

use crate::scripts::script::script_of;
use crate::{ApiFn, Cx, Result, functions};
use scene::{Data, Field, Handle, Scene, SceneError, special};
use script::{Number, Results};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_script_simulation_parameter,
    set_script_simulation_parameter,
    get_user_parameter,
    set_user_parameter,
];

/// A parameter of a script, or of the object the script is attached to.
///
/// @param scriptHandle the script, its object, or sim.handle_self
/// @param parameterName its name; an unknown one is an error
/// @param forceStringReturn return a string; otherwise texts such as `true` and `12` are converted
/// @return value numbers are floats
#[api("sim.getScriptSimulationParameter")]
fn get_script_simulation_parameter(
    cx: &Cx,
    script_handle: Number,
    parameter_name: String,
    #[default(false)] force_string_return: bool,
) -> Result<Results> {
    if [special::TREE, special::CHAIN, special::ALL].contains(&script_handle.0) {
        return Ok(Results(Vec::new()));
    }
    let hosts = hosts(cx, script_handle)?;
    let scene = cx.scene();
    let text = hosts
        .into_iter()
        .find_map(|object| find(&scene, object, &parameter_name));
    let text = text.ok_or(SceneError::InvalidHandle)?;
    Ok(Results(vec![value(Some(text), force_string_return)]))
}

/// Changes a parameter of a script, or of the object the script is attached to. Names they do not have are ignored.
///
/// @param scriptHandle the script, its object, or sim.handle_self; sim.handle_tree, sim.handle_chain: all below or above the script's object
/// @param parameterName its name
/// @param parameterValue its text
/// @return result 0
#[api("sim.setScriptSimulationParameter")]
fn set_script_simulation_parameter(
    cx: &mut Cx,
    script_handle: Number,
    parameter_name: String,
    parameter_value: String,
) -> Result<i64> {
    let near = match script_handle.0 {
        special::TREE | special::CHAIN => around(cx, script_handle.0 == special::TREE)?,
        special::ALL => Vec::new(),
        _ => hosts(cx, script_handle)?,
    };
    for object in near {
        if find(&cx.scene(), object, &parameter_name).is_some() {
            set(cx, object, parameter_name.clone(), parameter_value.clone())?;
        }
    }
    Ok(0)
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

/// The objects that may hold the parameters of a script: its own, and the one it is attached to; or the object a number names.
fn hosts(cx: &Cx, script_or_object: Number) -> Result<Vec<Handle>> {
    let Ok(script) = script_of(cx, script_or_object.0) else {
        let object = Handle::from_raw(script_or_object.0)
            .filter(|&object| cx.scene().object(object).is_ok());
        return Ok(vec![object.ok_or(SceneError::InvalidHandle)?]);
    };
    let attached_to = match script.object {
        Some(object) => cx.scene().object(object)?.parent(),
        None => script.owner(),
    };
    Ok([script.object, attached_to].into_iter().flatten().collect())
}

/// The object of the calling script with all below it, or with all above it.
fn around(cx: &Cx, below: bool) -> Result<Vec<Handle>> {
    let Some(&own) = hosts(cx, Number(special::SELF))?.last() else {
        return Ok(Vec::new());
    };
    let scene = cx.scene();
    Ok(if below {
        scene.tree(Some(own), false)?
    } else {
        scene.ancestors(own).chain([own]).collect()
    })
}

fn find(scene: &Scene, object: Handle, name: &str) -> Option<String> {
    let params = &scene.object(object).ok()?.user_params;
    params
        .iter()
        .find(|(known, _)| known == name)
        .map(|(_, text)| text.clone())
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
        _ => text
            .parse()
            .ok()
            .filter(|number: &f64| number.is_finite())
            .map_or_else(|| Data::text(&text), Data::Float),
    }
}
