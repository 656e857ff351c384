//! Calls of native functions from Lua.

use std::ffi::c_int;

use crate::binding::registry::{Bound, FunctionId};
use crate::error::ApiError;
use crate::lua::{Stack, Type, push_callback};

/// Pushes a native function.
pub(crate) fn push_function(stack: Stack<'_>, id: FunctionId) {
    push_callback(stack, call_function, id.number());
}

/// Pushes a native function under a global name of V-REP, which logs no deprecation.
pub(crate) fn push_function_of_old_name(stack: Stack<'_>, id: FunctionId) {
    push_callback(stack, call_without_notice, id.number());
}

fn call_function(stack: Stack<'_>, number: usize) -> Result<c_int, String> {
    let env = stack.env();
    let bound = env
        .registry
        .function(number)
        .ok_or("there is no such function.")?;
    if let Some(replacement) = bound.replacement {
        env.warn_deprecated(number, || deprecation_notice(&bound.name, replacement));
    }
    call_bound(stack, bound)
}

fn call_without_notice(stack: Stack<'_>, number: usize) -> Result<c_int, String> {
    call_bound(
        stack,
        stack
            .env()
            .registry
            .function(number)
            .ok_or("there is no such function.")?,
    )
}

fn call_bound(stack: Stack<'_>, bound: &Bound) -> Result<c_int, String> {
    let result = bound
        .call(stack, || stack.env().script_name())
        .or_else(|error| fail(stack, bound, &bound.worded(error)));
    if bound.function.mutates {
        stack.env().collect_events();
        stack.env().tell_of_change();
    }
    result
}

/// Raises the error; or returns -1 or nothing, where the script chose that errors are not raised (spec: vrep-era 2.2).
fn fail(stack: Stack<'_>, bound: &Bound, error: &ApiError) -> Result<c_int, String> {
    let env = stack.env();
    let is_refusal = !matches!(
        error,
        ApiError::NotImplemented(_) | ApiError::Interrupted | ApiError::BadArgument { .. }
    );
    if is_refusal {
        env.last_error.replace(error.to_string());
    }
    if env.raises_errors.get() || !is_refusal {
        if let (Some(sim), Some(wrong)) = (env.sim.upgrade(), wrong_argument(stack, bound, error)) {
            sim.log.note_wrong_argument(&bound.name, wrong);
        }
        return Err(error_text(error, stack, &bound.name));
    }
    let returns_a_number = matches!(bound.function.returns.first(), Some(&("int" | "float")));
    if returns_a_number {
        stack.push_int(-1);
    }
    Ok(returns_a_number.into())
}

/// Which argument of a refused call is nil, missing or no table; None where none is that has to be.
fn wrong_argument(stack: Stack<'_>, bound: &Bound, error: &ApiError) -> Option<String> {
    let of_arguments = matches!(
        error,
        ApiError::ArgumentType | ApiError::MoreArguments | ApiError::NotA { .. }
    );
    if !of_arguments {
        return None;
    }
    let named = bound
        .function
        .params
        .iter()
        .take_while(|param| param.name != "...");
    for (position, param) in (1..).zip(named) {
        let is_required = param.default.is_none();
        let what = match stack.kind(position) {
            _ if position > stack.top() => is_required.then_some("missing"),
            Type::Nil => is_required.then_some("nil"),
            Type::Table => None,
            _ => param.ty.ends_with(']').then_some("no table"),
        };
        if let Some(what) = what {
            return Some(format!("argument {position} ({}) is {what}", param.name));
        }
    }
    None
}

/// The string a Lua script catches: the line of its call, the function and the reason.
pub(crate) fn error_text(error: &ApiError, stack: Stack<'_>, function: &str) -> String {
    let files = &stack.env().registry.files;
    let line = stack.line_of_caller(|chunk| files.contains_key(chunk));
    match error {
        ApiError::NotImplemented(_) => format!("{line}: {error}"),
        ApiError::BadArgument { position, reason } => stack.argument_error(*position, reason),
        // Scripts know these words, and the function that calls all plugins in CoppeliaSim.
        ApiError::Plugin(_) => format!("{line}: error in 'sim.genericFunctionHandler': {error}"),
        _ => format!("{line}: in {function}: {error}"),
    }
}

/// The line logged at the first call of a deprecated function. The original's line also names a file of settings, which is not read here.
pub(crate) fn deprecation_notice(name: &str, replacement: &str) -> String {
    let advice = match replacement {
        "" => " and the related functionality will disappear in a future release.".to_owned(),
        _ => format!(". please use {replacement} instead."),
    };
    format!("{name} is deprecated{advice}")
}
