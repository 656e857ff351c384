//! `sim.*`: scripts and calls between them.

use std::rc::Rc;

use api_macro::api;

use super::{ApiError, ApiFn, Cx, Result, functions};
use crate::scene::script_object::{ScriptObject, ScriptType};
use crate::scene::{Data, Handle, Kind, special};
use crate::script::{Bytes, Rest, Results, Script};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![create_script, call_script_function, init_script];

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
    let script_type =
        ScriptType::from_number(script_type).ok_or_else(|| ApiError::Other("invalid script type.".into()))?;
    let script = ScriptObject::new(script_type, script_text.0, &lang, options & 1 != 0);
    let handle = cx.scene_mut().add("script", Kind::Script(Box::new(script)))?;
    Rc::clone(cx.sim()).announce_created(&[handle]);
    Ok(handle)
}

/// The script a number means: a handle, or the caller itself.
fn script_of(cx: &Cx, raw: i64) -> Result<Rc<Script>> {
    match raw {
        special::SELF => Ok(Rc::clone(cx.script())),
        _ => cx.sim().script(raw).ok_or(ApiError::NoSuchScript),
    }
}

/// Calls a function of another script (or of this one, by sim.handle_self).
///
/// @param functionName name of a global function; dots walk through tables
/// @param scriptHandle the script
/// @return ... what the function returned
#[api("sim.callScriptFunction")]
fn call_script_function(cx: &mut Cx, function_name: Bytes, script_handle: i64, arguments: Rest) -> Result<Results> {
    let script = script_of(cx, script_handle)?;
    let name = String::from_utf8_lossy(&function_name.0).into_owned();
    let mut results = Rc::clone(cx.sim()).call_function(&script, &name, &arguments.0)?;
    if results.is_empty() {
        results.push(Data::Nil);
    }
    Ok(Results(results))
}

/// Ends a script and starts it anew at once.
///
/// @param scriptHandle the script
#[api("sim.initScript")]
fn init_script(cx: &mut Cx, script_handle: i64) -> Result<()> {
    let script = script_of(cx, script_handle)?;
    Rc::clone(cx.sim()).init_script(&script);
    Ok(())
}
