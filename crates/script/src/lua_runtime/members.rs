//! The members of `sim` and the global names, which are found when scripts first use them.

use std::ffi::{CStr, c_int};

use super::functions::{deprecation_notice, error_text, push_function, push_function_of_old_name};
use super::startup::load_module;
use super::{implicit, stand_ins};
use crate::binding::registry::{Member, MissingId};
use crate::host::Sim;
use crate::lua::{self, Outcome, Stack, Type, push_callback, push_plain};

/// The `sim` table of a state.
pub(super) const SIM: &CStr = c"swanilda.sim";
/// Results of the Lua files behind `sim`, by module name.
const LUA_MODULES: &CStr = c"swanilda.modules";

pub(super) fn install_globals(sim: &Sim, stack: Stack<'_>) {
    for &(name, id) in &sim.modules.registry.globals {
        push_function(stack, id);
        stack.set_global(name);
    }
    stack.push_globals();
    set_access(stack, index_globals, implicit::pairs_globals);
    stack.pop(1);
}

/// Gives the table on top a metatable with these metamethods.
fn set_access(
    stack: Stack<'_>,
    index: impl lua::Callback,
    pairs: impl Fn(Stack<'_>) -> Outcome + Copy + 'static,
) {
    stack.new_table(0, 2);
    push_callback(stack, index, 0);
    stack.raw_set_field(-2, "__index");
    push_plain(stack, pairs);
    stack.raw_set_field(-2, "__pairs");
    stack.set_metatable(-2);
}

/// The `sim` table fills itself: a name is looked up when it is first used.
pub(super) fn install_sim(stack: Stack<'_>) {
    stack.new_table(0, 0);
    set_access(stack, index_sim, pairs_sim);
    stack.set_registry(SIM);
    stack.new_table(0, 0);
    stack.set_registry(LUA_MODULES);
}

fn index_sim(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let Some(name) = stack.bytes(2) else {
        return Ok(0);
    };
    let Ok(name) = String::from_utf8(name) else {
        return Ok(0);
    };
    push_member(stack, &name)?;
    if stack.kind(-1) != Type::Nil {
        stack.push_value(-1);
        stack.raw_set_field(1, &name);
    }
    Ok(1)
}

/// `pairs(sim)`: who iterates gets all names, used before or not.
fn pairs_sim(stack: Stack<'_>) -> Outcome {
    stack.push_registry(SIM);
    for name in stack.env().registry.members_of_sim().names() {
        let is_known = stack.raw_get_field(-1, name) != Type::Nil;
        stack.pop(1);
        if !is_known {
            if let Err(error) = push_member(stack, name) {
                return Outcome::Raise(error);
            }
            stack.raw_set_field(-2, name);
        }
    }
    stand_ins::push_iteration(stack)
}

/// Modules and classes used without being asked for, and old global names, whose functions log no deprecation.
fn index_globals(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    // Most globals that scripts look up without success are no functions of the simulator: the name is copied only if it is one.
    let Some(true) = stack.with_bytes(2, implicit::is_candidate) else {
        return index_program(stack);
    };
    let Ok(name) = String::from_utf8(stack.bytes(2).unwrap_or_default()) else {
        return Ok(0);
    };
    if implicit::define(stack, &name) {
        return Ok(1);
    }
    match stack.env().registry.members_of_sim().of_global(&name) {
        None => return index_program(stack),
        Some(Member::Native(id)) => push_function_of_old_name(stack, id),
        Some(Member::Constant(value)) => stack.push_int(value),
        Some(Member::Missing(id)) => push_missing(stack, id),
        Some(Member::Lua { file, function, .. }) => {
            let sim = stack.env().sim.upgrade().ok_or("the simulator is gone.")?;
            push_lua_member(stack, &sim, file, function)?;
        }
    }
    Ok(1)
}

/// Functions of the program that has loaded the simulator as a library: it registers them at any time, so they are no globals at first.
fn index_program(stack: Stack<'_>) -> Result<c_int, String> {
    let Some(sim) = stack.env().sim.upgrade() else {
        return Ok(0);
    };
    let functions = sim.functions_of_program();
    if functions.is_empty() {
        return Ok(0);
    }
    let name = stack.bytes(2).unwrap_or_default();
    let begins = |function: &String| {
        let rest = function.as_bytes().strip_prefix(&name[..]);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(b"."))
    };
    if !functions.iter().any(begins) {
        return Ok(0);
    }
    push_lua_member(stack, &sim, "swanilda/plugins", "ofProgram")?;
    stack.push_bytes(&name);
    stack.protected_call(1, 1).map_err(|error| error.text)?;
    Ok(1)
}

/// Pushes `sim.<name>`, or nil.
fn push_member(stack: Stack<'_>, name: &str) -> Result<(), String> {
    match stack.env().registry.members_of_sim().get(name) {
        None => stack.push_nil(),
        Some(Member::Constant(value)) => stack.push_int(value),
        Some(Member::Native(id)) => push_function(stack, id),
        Some(Member::Missing(id)) => push_missing(stack, id),
        Some(Member::Lua {
            file,
            function,
            replacement,
        }) => {
            let sim = stack.env().sim.upgrade().ok_or("the simulator is gone.")?;
            push_lua_member(stack, &sim, file, function)?;
            if let Some(replacement) = replacement {
                wrap_deprecated(
                    stack,
                    &sim,
                    file,
                    &deprecation_notice(&format!("sim.{name}"), replacement),
                )?;
            }
        }
    }
    Ok(())
}

pub(super) fn push_missing(stack: Stack<'_>, id: MissingId) {
    push_callback(stack, raise_missing, id.number());
}

fn raise_missing(stack: Stack<'_>, number: usize) -> Result<c_int, String> {
    let missing = stack
        .env()
        .registry
        .missing(number)
        .ok_or("there is no such function.")?;
    Err(error_text(&missing.error(), stack, ""))
}

/// Pushes a function of an embedded Lua file, loading the file if this state has not yet.
fn push_lua_member(
    stack: Stack<'_>,
    sim: &Sim,
    file: &'static str,
    function: &str,
) -> Result<(), String> {
    stack.push_registry(LUA_MODULES);
    if stack.raw_get_field(-1, file) != Type::Table {
        stack.pop(1);
        load_module(stack, sim, file).map_err(|error| error.text)?;
        stack.push_registry(SIM);
        stack.protected_call(1, 1).map_err(|error| error.text)?;
        stack.push_value(-1);
        stack.raw_set_field(-3, file);
    }
    stack.raw_get_field(-1, function);
    stack.remove(-2);
    stack.remove(-2);
    Ok(())
}

/// Replaces the function on top by one that logs its deprecation at the first call. In Lua, so that it can yield.
fn wrap_deprecated(stack: Stack<'_>, sim: &Sim, file: &str, notice: &str) -> Result<(), String> {
    load_module(stack, sim, "deprecate").map_err(|error| error.text)?;
    stack.insert(-2);
    stack.push_bytes(notice.as_bytes());
    stack.push_registry(LUA_MODULES);
    stack.raw_get_field(-1, file);
    stack.remove(-2);
    stack.protected_call(3, 1).map_err(|error| error.text)
}
