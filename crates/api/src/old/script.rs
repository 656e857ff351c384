//! `sim.*`: older ways to find scripts and to read and write what is a property of theirs today.

use std::rc::Rc;

use api_macro::api;

use crate::objects::alias::get_object_handle;
use crate::objects::old_name::suffix_of_script;
use crate::scripts::script::script_of;
use crate::scripts::simulation::main_script_only;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::numbers;
use scene::object::script_object::ScriptType;
use scene::{Data, Handle, SceneError, ValueType, special};
use script::{Bytes, Number, PropertyTarget, Script, Text};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_object_associated_with_script,
    get_script_associated_with_object,
    get_customization_script_associated_with_object,
    get_script_handle,
    add_script,
    associate_script_with_object,
    get_last_error,
    get_script_name,
    get_script_attribute,
    get_script_execution_count,
    set_script_attribute,
    get_script_int32_param,
    set_script_int32_param,
    get_script_string_param,
    set_script_string_param,
    set_script_text,
    resume_threads,
    launch_threaded_child_scripts,
];

/// Meaning of a numbered attribute or parameter of scripts.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Attribute {
    Priority,
    Type,
    Handle,
    Enabled,
    Object,
    RestartOnError,
    Text,
    Name,
    Language,
    /// Its scenes put it into the text of old scripts to count their runs.
    ExecutionCount,
    /// CoppeliaSim has forgotten what it meant: it can be set, without effect.
    Forgotten,
}

impl Attribute {
    /// `sim.scriptattribute_*`, `sim.scriptintparam_*`, `sim.scriptstringparam_*`.
    fn from_number(number: i64) -> Result<Self> {
        Ok(match number {
            1 | 10100 => Self::Priority,
            7 | 10102 => Self::Type,
            8 | 10103 => Self::Handle,
            4 | 10104 => Self::Enabled,
            10105 => Self::Object,
            10107 => Self::RestartOnError,
            10109 => Self::Name,
            10110 => Self::Text,
            10112 => Self::Language,
            2 => Self::ExecutionCount,
            0 | 3 | 5 | 6 => Self::Forgotten,
            _ => return Err(ApiError::Other("invalid parameter.".into())),
        })
    }

    /// The property it is today.
    fn property(self) -> Option<(&'static str, ValueType)> {
        Some(match self {
            Self::Priority => ("execPriority", ValueType::Int),
            Self::Type => ("scriptType", ValueType::Int),
            Self::RestartOnError => ("restartOnError", ValueType::Bool),
            Self::Text => ("code", ValueType::String),
            Self::Name => ("scriptName", ValueType::String),
            Self::Language => ("language", ValueType::String),
            Self::Enabled => ("scriptDisabled", ValueType::Bool),
            Self::Handle | Self::Object | Self::ExecutionCount | Self::Forgotten => return None,
        })
    }
}

fn target_of(script: &Rc<Script>) -> PropertyTarget {
    script.object.map_or_else(
        || PropertyTarget::Script(Rc::clone(script)),
        PropertyTarget::Object,
    )
}

fn read(cx: &Cx, script: &Rc<Script>, attribute: Attribute) -> Result<Data> {
    let Some((name, ty)) = attribute.property() else {
        let handle = match attribute {
            Attribute::Handle => Some(script.id),
            Attribute::ExecutionCount => Some(script.execution_count.get()),
            Attribute::Forgotten => Some(0),
            _ => script.object.or(script.owner()).map(Handle::raw),
        };
        return Ok(Data::Int(handle.unwrap_or(special::WORLD)));
    };
    let value = cx.read_property(&target_of(script), name, ty)?;
    Ok(if attribute == Attribute::Enabled {
        Data::Bool(!value.truthy())
    } else {
        value
    })
}

fn write(cx: &mut Cx, script: &Rc<Script>, attribute: Attribute, value: Data) -> Result<()> {
    match attribute {
        Attribute::Forgotten => return Ok(()),
        Attribute::ExecutionCount => {
            script
                .execution_count
                .set(numbers::truncated(value.as_f64().unwrap_or_default()));
            return Ok(());
        }
        _ => {}
    }
    let (name, ty) = attribute.property().ok_or(ApiError::PropertyNotWritable)?;
    let truth = match value {
        Data::Int(number) => number != 0,
        ref other => other.truthy(),
    };
    let value = match (attribute, value) {
        (Attribute::Enabled, _) => Data::Bool(!truth),
        (Attribute::RestartOnError, _) => Data::Bool(truth),
        (_, Data::Float(number)) => Data::Int(numbers::truncated(number)),
        (_, value) => value,
    };
    cx.write_property(&target_of(script), name, (ty, value))
}

fn object(cx: &Cx, raw: i64) -> Result<Handle> {
    let handle = Handle::from_raw(raw).filter(|&handle| cx.scene().exists(handle));
    Ok(handle.ok_or(SceneError::NoSuchObject)?)
}

/// The object of a script: itself, or the one an old script is attached to.
///
/// @param scriptHandle the script
/// @return objectHandle -1 for the main script, the sandbox and add-ons
#[api("sim.getObjectAssociatedWithScript")]
fn get_object_associated_with_script(cx: &Cx, script_handle: Number) -> Result<i64> {
    let script = script_of(cx, script_handle.0)?;
    Ok(script
        .object
        .or(script.owner())
        .map_or(special::WORLD, Handle::raw))
}

/// The simulation script of an object.
///
/// @param objectHandle the object
/// @return scriptHandle -1 if there is none
#[api("sim.getScriptAssociatedWithObject")]
fn get_script_associated_with_object(cx: &Cx, object_handle: Number) -> Result<i64> {
    let object = object(cx, object_handle.0)?;
    Ok(cx
        .script_attached_to(object, ScriptType::Simulation)
        .unwrap_or(special::WORLD))
}

/// The customization script of an object.
///
/// @param objectHandle the object
/// @return scriptHandle -1 if there is none
#[api("sim.getCustomizationScriptAssociatedWithObject")]
fn get_customization_script_associated_with_object(cx: &Cx, object_handle: Number) -> Result<i64> {
    let object = object(cx, object_handle.0)?;
    Ok(cx
        .script_attached_to(object, ScriptType::Customization)
        .unwrap_or(special::WORLD))
}

/// Handle of a script.
///
/// @param scriptType sim.scripttype_*; sim.handle_self or nil for the caller. V-REP gave the name of an object here, for its simulation script, with `customization@` before it for its customization script
/// @param scriptName path, old-style name or handle of the object the script belongs to, or the display name of an add-on
/// @param objectHandle the object the script belongs to
/// @return scriptHandle -1 if the object has none of that type
#[api("sim.getScriptHandle")]
fn get_script_handle(
    cx: &Cx,
    #[default(Data::Nil)] script_type: Data,
    #[default(Data::Nil)] script_name: Data,
    #[default(special::WORLD, "sim.handle_world")] object_handle: Number,
) -> Result<i64> {
    let script_type = match script_type {
        Data::Nil | Data::Int(special::SELF) => return Ok(cx.script().id),
        Data::Int(number) => ScriptType::from_number(number).ok_or(ApiError::NoSuchScript)?,
        Data::Text(name) => return script_of_name(cx, &String::from_utf8_lossy(&name)),
        _ => {
            return Err(ApiError::NotA {
                position: 1,
                expected: "integer",
            });
        }
    };
    let name = match &script_name {
        Data::Text(name) => String::from_utf8_lossy(name).into_owned(),
        _ => String::new(),
    };
    if matches!(
        script_type,
        ScriptType::Main | ScriptType::Sandbox | ScriptType::AddOn
    ) {
        return cx.script_by_name(script_type, &name);
    }
    let handle = match script_name {
        Data::Int(handle) => handle,
        _ if object_handle.0 != special::WORLD => object_handle.0,
        _ => named_object(cx, &name)?,
    };
    if handle == special::WORLD {
        return Ok(handle);
    }
    Ok(cx
        .script_attached_to(object(cx, handle)?, script_type)
        .unwrap_or(special::WORLD))
}

/// The object at a path or with an old-style name; -1 with `@silentError`.
fn named_object(cx: &Cx, name: &str) -> Result<i64> {
    get_object_handle(cx, Data::Text(name.into()), None, suffix_of_script(cx))
}

/// The script attached to a named object, as V-REP called it; the main script without a name.
fn script_of_name(cx: &Cx, name: &str) -> Result<i64> {
    let (script_type, name) = match name.split_once('@') {
        Some(("customization", name)) => (ScriptType::Customization, name),
        Some(("child", name)) => (ScriptType::Simulation, name),
        _ if name.is_empty() => return cx.script_by_name(ScriptType::Main, ""),
        _ => (ScriptType::Simulation, name),
    };
    let handle = named_object(cx, name)?;
    if handle == special::WORLD {
        return Ok(handle);
    }
    let script = cx
        .script_attached_to(object(cx, handle)?, script_type)
        .and_then(|id| cx.script_by_handle(id));
    let attached = script.filter(|script| script.object.is_none());
    attached
        .map(|script| script.id)
        .ok_or(ApiError::NoSuchScript)
}

/// A new script without an object; sim.associateScriptWithObject attaches it to one.
///
/// @param scriptType sim.scripttype_simulation or sim.scripttype_customization
/// @return scriptHandle
#[api("sim.addScript")]
fn add_script(cx: &mut Cx, script_type: Number) -> Result<i64> {
    let script_type = ScriptType::from_number(script_type.0);
    let script_type =
        script_type.filter(|t| matches!(t, ScriptType::Simulation | ScriptType::Customization));
    Ok(cx.add_script_without_object(script_type.ok_or(SceneError::InvalidArgument)?))
}

/// Attaches a script that is no object to an object.
///
/// @param scriptHandle from sim.addScript, or of an old scene
/// @param objectHandle the object; -1 detaches it
/// @return result 1
#[api("sim.associateScriptWithObject")]
fn associate_script_with_object(
    cx: &mut Cx,
    script_handle: Number,
    object_handle: Number,
) -> Result<i64> {
    let script = script_of(cx, script_handle.0)?;
    let is_embedded = matches!(
        script.script_type,
        ScriptType::Simulation | ScriptType::Customization
    );
    if script.object.is_some() || !is_embedded {
        return Err(ApiError::NoSuchScript);
    }
    let owner = if object_handle.0 == special::WORLD {
        None
    } else {
        Some(object(cx, object_handle.0)?)
    };
    if let Some(owner) = owner.filter(|owner| script.owner() != Some(*owner))
        && cx.script_attached_to(owner, script.script_type).is_some()
    {
        return Err(ApiError::Other(
            "object is already associated with such a script type.".into(),
        ));
    }
    cx.reattach_script(&script, owner);
    Ok(1)
}

/// Name of a script.
///
/// @param scriptHandle the script
/// @return scriptName
#[api("sim.getScriptName")]
fn get_script_name(cx: &Cx, script_handle: Number) -> Result<Data> {
    read(cx, &script_of(cx, script_handle.0)?, Attribute::Name)
}

/// An attribute of a script.
///
/// @param scriptHandle the script
/// @param attributeID sim.scriptattribute_*
/// @return attribute
#[api("sim.getScriptAttribute")]
fn get_script_attribute(
    cx: &Cx,
    script_handle: Number,
    #[name("attributeID")] attribute_id: Number,
) -> Result<Data> {
    read(
        cx,
        &script_of(cx, script_handle.0)?,
        Attribute::from_number(attribute_id.0)?,
    )
}

/// Execution count of the calling script, as last set by sim.setScriptAttribute in old scenes.
///
/// @return count 0 at first
#[api("sim.getScriptExecutionCount")]
fn get_script_execution_count(cx: &Cx) -> Result<i64> {
    Ok(cx.script().execution_count.get())
}

/// Sets an attribute of a script.
///
/// @param scriptHandle the script
/// @param attributeID sim.scriptattribute_*
/// @param attribute the new value
#[api("sim.setScriptAttribute")]
fn set_script_attribute(
    cx: &mut Cx,
    script_handle: Number,
    #[name("attributeID")] attribute_id: Number,
    attribute: Data,
) -> Result<()> {
    write(
        cx,
        &script_of(cx, script_handle.0)?,
        Attribute::from_number(attribute_id.0)?,
        attribute,
    )
}

/// An integer parameter of a script.
///
/// @param scriptHandle the script
/// @param parameterID sim.scriptintparam_*
/// @return parameter
#[api("sim.getScriptInt32Param")]
fn get_script_int32_param(
    cx: &Cx,
    script_handle: Number,
    #[name("parameterID")] parameter_id: Number,
) -> Result<i64> {
    int_param(cx, &script_of(cx, script_handle.0)?, parameter_id.0)
}

pub(crate) fn int_param(cx: &Cx, script: &Rc<Script>, parameter: i64) -> Result<i64> {
    match read(cx, script, Attribute::from_number(parameter)?)? {
        Data::Int(value) => Ok(value),
        value => Ok(i64::from(value.truthy())),
    }
}

pub(crate) fn string_param(cx: &Cx, script: &Rc<Script>, parameter: i64) -> Result<Option<Text>> {
    match read(cx, script, Attribute::from_number(parameter)?)? {
        Data::Text(text) => Ok(Some(Text(text))),
        _ => Ok(None),
    }
}

pub(crate) fn set_param(
    cx: &mut Cx,
    script: &Rc<Script>,
    parameter: i64,
    value: Data,
) -> Result<()> {
    write(cx, script, Attribute::from_number(parameter)?, value)
}

/// Sets an integer parameter of a script.
///
/// @param scriptHandle the script
/// @param parameterID sim.scriptintparam_*
/// @param parameter the new value
#[api("sim.setScriptInt32Param")]
fn set_script_int32_param(
    cx: &mut Cx,
    script_handle: Number,
    #[name("parameterID")] parameter_id: Number,
    parameter: Number,
) -> Result<()> {
    let attribute = Attribute::from_number(parameter_id.0)?;
    write(
        cx,
        &script_of(cx, script_handle.0)?,
        attribute,
        Data::Int(parameter.0),
    )
}

/// A string parameter of a script.
///
/// @param scriptHandle the script
/// @param parameterID sim.scriptstringparam_*
/// @return parameter
#[api("sim.getScriptStringParam")]
fn get_script_string_param(
    cx: &Cx,
    script_handle: Number,
    #[name("parameterID")] parameter_id: Number,
) -> Result<Data> {
    read(
        cx,
        &script_of(cx, script_handle.0)?,
        Attribute::from_number(parameter_id.0)?,
    )
}

/// Sets a string parameter of a script.
///
/// @param scriptHandle the script
/// @param parameterID sim.scriptstringparam_*
/// @param parameter the new value
#[api("sim.setScriptStringParam")]
fn set_script_string_param(
    cx: &mut Cx,
    script_handle: Number,
    #[name("parameterID")] parameter_id: Number,
    parameter: Bytes,
) -> Result<()> {
    let attribute = Attribute::from_number(parameter_id.0)?;
    write(
        cx,
        &script_of(cx, script_handle.0)?,
        attribute,
        Data::Text(parameter.0),
    )
}

/// Replaces the code of a script. A running script keeps executing the old one.
///
/// @param scriptHandle the script
/// @param scriptText the new code
#[api("sim.setScriptText")]
fn set_script_text(cx: &mut Cx, script_handle: Number, script_text: Bytes) -> Result<()> {
    write(
        cx,
        &script_of(cx, script_handle.0)?,
        Attribute::Text,
        Data::Text(script_text.0),
    )
}

/// Reason of the last call of this script that was refused; it is forgotten.
///
/// @return lastError empty if there was none
#[api("sim.getLastError")]
fn get_last_error(cx: &Cx) -> Result<String> {
    Ok(cx.env().last_error.take())
}

/// Does nothing: threads are coroutines, which their scripts resume. For the main script.
///
/// @param location any: its constants are gone
/// @return count 0
#[api("sim.resumeThreads")]
fn resume_threads(cx: &Cx, #[default(Data::Nil)] location: Data) -> Result<i64> {
    let _ = location;
    main_script_only(cx).map(|()| 0)
}

/// Does nothing: threads are coroutines, which their scripts resume. For the main script.
///
/// @return count 0
#[api("sim.launchThreadedChildScripts")]
fn launch_threaded_child_scripts(cx: &Cx) -> Result<i64> {
    main_script_only(cx).map(|()| 0)
}
