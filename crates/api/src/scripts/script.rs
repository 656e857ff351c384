//! `sim.*`: scripts and calls between them.

use std::rc::Rc;

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use scene::object::script_object::{ScriptObject, ScriptType};
use scene::{Data, Handle, Kind, SceneError, is_legal_old_name, special};
use script::Source;
use script::{Bytes, InTurn, Number, Rest, Results, Script};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    create_script,
    remove_script,
    init_script,
    get_script,
    call_script_function,
    call_script_function_by_type,
    execute_script_string,
    broadcast_msg,
];

/// Creates a script object as the last root, named `script`.
///
/// @param scriptType sim.scripttype_*
/// @param scriptText its code
/// @param options 1: disabled
/// @param lang `lua`
/// @return scriptHandle
#[api("sim.createScript")]
fn create_script(
    cx: &mut Cx,
    script_type: i64,
    script_text: Bytes,
    #[default(0)] options: i64,
    #[default("lua")] lang: String,
) -> Result<Handle> {
    let script_type = ScriptType::from_number(script_type)
        .ok_or_else(|| ApiError::Other("invalid script type.".into()))?;
    let script = ScriptObject::new(script_type, script_text.0, &lang, options & 1 != 0);
    let handle = cx
        .scene_mut()
        .add("script", Kind::Script(Box::new(script)))?;
    cx.notify_created(&[handle]);
    Ok(handle)
}

/// Removes a script that is attached to an object, as in old scenes; script objects are removed as objects. A customization script ends
/// after the present callbacks; a simulation script is removed only while the simulation is stopped.
///
/// @param scriptHandle the script, or sim.handle_self
/// @return result 1; -1 for sim.handle_all
#[api("sim.removeScript")]
fn remove_script(cx: &mut Cx, script_handle: Number) -> Result<i64> {
    if script_handle.0 == special::ALL {
        return Ok(-1);
    }
    let script = script_of(cx, script_handle.0)?;
    let is_embedded = matches!(
        script.script_type,
        ScriptType::Simulation | ScriptType::Customization | ScriptType::Main | ScriptType::Passive
    );
    if script.object.is_some() || !is_embedded {
        return Err(ApiError::NoSuchScript);
    }
    cx.remove_attached_script(&script);
    Ok(1)
}

/// The script a number means: a handle, or the caller itself.
pub(crate) fn script_of(cx: &Cx, raw: i64) -> Result<Rc<Script>> {
    match raw {
        special::SELF => Ok(Rc::clone(cx.script())),
        _ => cx.script_by_handle(raw).ok_or(ApiError::NoSuchScript),
    }
}

/// Resets a script and initialises it again.
///
/// @param scriptHandle the script
#[api("sim.initScript")]
fn init_script(cx: &mut Cx, script_handle: Number) -> Result<()> {
    let script = script_of(cx, script_handle.0)?;
    cx.init_script(&script);
    Ok(())
}

/// Handle of a script.
///
/// @param scriptType sim.scripttype_*, or sim.handle_self
/// @param scriptName the object the script belongs to, by path or handle; the display name of an add-on
/// @return scriptHandle -1 if the object has no such script
#[api("sim.getScript")]
fn get_script(
    cx: &Cx,
    script_type: i64,
    #[default(Data::Nil)] script_name: Data,
    #[name("...")] names: Rest,
) -> Result<i64> {
    if script_type == special::SELF {
        return Ok(cx.script().id);
    }
    let script_type = ScriptType::from_number(script_type).ok_or(ApiError::NoSuchScript)?;
    match script_name {
        Data::Int(raw) if raw >= 0 => {
            let object = Handle::from_raw(raw).filter(|&handle| cx.scene().exists(handle));
            let object = object.ok_or(SceneError::NoSuchObject)?;
            Ok(cx
                .script_attached_to(object, script_type)
                .unwrap_or(special::WORLD))
        }
        Data::Text(name) => cx.script_by_name(script_type, &String::from_utf8_lossy(&name)),
        _ => match names.0.first() {
            Some(Data::Text(name)) => {
                cx.script_by_name(script_type, &String::from_utf8_lossy(name))
            }
            _ => cx.script_by_name(script_type, ""),
        },
    }
}

/// Calls a function of another script (or of this one, by sim.handle_self).
///
/// The first two arguments may come in either order.
///
/// @param functionName name of a global function; dots walk through tables
/// @param scriptHandle the script
/// @return ... what the function returned
#[api("sim.callScriptFunction")]
fn call_script_function(
    cx: &mut Cx,
    function_name: Callee,
    script_handle: Callee,
    #[name("...")] arguments: Rest,
) -> Result<Results> {
    let (name, raw) = match (function_name.0, script_handle.0) {
        (Data::Int(raw), Data::Text(name))
        | (Data::Text(name) | Data::Buffer(name), Data::Int(raw)) => (name, raw),
        (Data::Text(_) | Data::Buffer(_), _) => {
            return Err(ApiError::NotA {
                position: 2,
                expected: "integer",
            });
        }
        _ => {
            return Err(ApiError::NotA {
                position: 1,
                expected: "string/buffer",
            });
        }
    };
    let function = String::from_utf8_lossy(&name);
    let script = script_of(cx, raw)?;
    call(cx, &script, &function, &arguments.0)
}

/// Calls a function of another script, as scenes from before 4.8 do: by its handle, or by its type and its object, `f@/robot`.
///
/// @param functionName name of a global function, and the object behind an `@`
/// @param scriptHandleOrType the script, or sim.scripttype_*
/// @return ... what the function returned
#[api("sim._callScriptFunction")]
fn call_script_function_by_type(
    cx: &mut Cx,
    function_name: String,
    script_handle_or_type: i64,
    #[name("...")] arguments: Rest,
) -> Result<Results> {
    let (script, function) = callee(cx, script_handle_or_type, &function_name)?;
    call(cx, &script, function, &arguments.0)
}

fn call(cx: &mut Cx, script: &Rc<Script>, function: &str, arguments: &[Data]) -> Result<Results> {
    let mut results = cx.call_function(script, function, arguments)?;
    if results.is_empty() {
        results.push(Data::Nil);
    }
    Ok(Results(results))
}

/// The script and the name of the function of a call: `f@/robot`, or `f` alone for the main script.
fn callee<'a>(cx: &Cx, raw: i64, name: &'a str) -> Result<(Rc<Script>, &'a str)> {
    let by_handle = script_of(cx, raw);
    let Some(script_type) = ScriptType::from_number(raw) else {
        return Ok((by_handle?, name));
    };
    let (function, owner) = match name.split_once('@') {
        Some((_, "lua" | "python")) => return Ok((by_handle?, name)),
        Some(parts) => parts,
        None if by_handle.is_ok() => return Ok((by_handle?, name)),
        None => (name, ""),
    };
    let id = cx.script_by_name(script_type, owner)?;
    Ok((script_of(cx, id)?, function))
}

/// The same for programs that load the simulator: `f@name` or `code@name`, where the name is behind the last `@`. The length of what is
/// before it.
pub(crate) fn callee_at_end(cx: &Cx, raw: i64, text: &[u8]) -> Result<(Rc<Script>, usize)> {
    let at = text.iter().rposition(|&byte| byte == b'@');
    let name = at.map(|at| String::from_utf8_lossy(&text[at + 1..]).into_owned());
    let is_name = |name: &str| {
        name.is_empty() || name.starts_with(['/', '.', ':']) || is_legal_old_name(name)
    };
    let (length, name) = match (at, name) {
        (Some(at), Some(name)) if is_name(&name) => (at, name),
        _ => (text.len(), String::new()),
    };
    let by_handle = script_of(cx, raw);
    let is_language = matches!(name.as_str(), "lua" | "python");
    let Some(script_type) = ScriptType::from_number(raw).filter(|_| !is_language) else {
        return Ok((by_handle?, length));
    };
    match by_handle {
        Ok(script) if name.is_empty() => Ok((script, length)),
        _ => Ok((
            script_of(cx, cx.script_by_name(script_type, &name)?)?,
            length,
        )),
    }
}

/// One of the two leading arguments of a call: a name or a handle.
struct Callee(Data);

impl crate::FromScript for Callee {
    const TYPE: &'static str = "string/int";

    fn from_script<'a, S: Source<'a>>(args: &crate::Args<'a, S>) -> Result<Self> {
        Data::from_script(args).map(Self)
    }
}

/// Runs a string in a script: as an expression if it is one, else as a chunk.
///
/// @param stringToExecute the code; from the last `@` on it is the name of a language, not code
/// @param scriptHandle the script
/// @return ... 0, then what the code gave, or an empty table if nothing
#[api("sim.executeScriptString")]
fn execute_script_string(
    cx: &mut Cx,
    string_to_execute: Bytes,
    script_handle: i64,
) -> Result<Results> {
    let script = script_of(cx, script_handle)?;
    let code = match string_to_execute.0.iter().rposition(|&byte| byte == b'@') {
        Some(at) => &string_to_execute.0[..at],
        None => &string_to_execute.0[..],
    };
    let mut results = cx.execute_string(&script, code)?;
    if results.is_empty() {
        results.push(Data::Array(Vec::new()));
    }
    results.insert(0, Data::Int(0));
    Ok(Results(results))
}

/// Sends a message to all other scripts: their `sysCall_msg` gets it, the options if there are any, and the sender's handle.
///
/// @param message a table; by convention with `id` and `data`
#[api("sim.broadcastMsg")]
fn broadcast_msg(cx: &mut Cx, message: InTurn<Data>, #[name("...")] options: Rest) -> Result<()> {
    let message = message.0;
    if !matches!(message, Data::Array(_) | Data::Map(_)) {
        return Err(ApiError::ArgumentType);
    }
    let sender = cx.script().id;
    let mut arguments = vec![message];
    arguments.extend(options.0);
    arguments.push(Data::Int(sender));
    cx.broadcast_message(&arguments);
    Ok(())
}
