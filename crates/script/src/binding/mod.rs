//! Definition of functions for scripts, and their lookup from Lua.

pub(crate) mod args;
pub(crate) mod by_handle;
pub(crate) mod cx;
pub(crate) mod data;
pub(crate) mod hooks;
pub(crate) mod module;
pub(crate) mod param;
pub(crate) mod registry;
pub(crate) mod returns;
pub(crate) mod sink;
pub(crate) mod source;
pub(crate) mod states;

use std::ffi::c_int;

use super::error::{ApiError, ApiResult};
use super::lua::{Stack, push_callback};
use args::Args;
use param::Param;
use registry::{Bound, FunctionId};
use scene::Data;
use source::Values;

/// One scriptable function: its documentation and its code, declared together by `#[api]`.
pub struct ApiFn {
    /// `sim.name`, or a bare name for globals.
    pub name: &'static str,
    /// The documentation: text, then lines with `@param` and `@return`.
    pub doc: &'static str,
    /// The parameters, in the order of the arguments.
    pub params: &'static [Param],
    /// Types of the results.
    pub returns: &'static [&'static str],
    /// Whether the function may change the simulator or call scripts: events are collected after such calls.
    pub mutates: bool,
    /// The call from a Lua stack.
    pub call: fn(&mut Args<'_>) -> ApiResult<c_int>,
    /// The call with plain values.
    pub call_data: for<'a> fn(&mut Args<'a, Values<'a>>) -> ApiResult<Vec<Data>>,
}

/// The table of contents of a file of scriptable functions.
#[macro_export]
macro_rules! functions {
    ($($name:ident),* $(,)?) => { &[$($name::API),*] };
}

/// The error of a call with plain values for functions that read Lua's stack themselves.
pub fn needs_lua<'a>(_: &mut Args<'a, Values<'a>>) -> ApiResult<Vec<Data>> {
    Err(ApiError::NeedsLua)
}

/// Pushes a native function.
pub(crate) fn push_function(stack: Stack<'_>, id: FunctionId) {
    push_callback(stack, call_function, id.number());
}

/// Pushes a native function under a global name of V-REP, which logs no deprecation.
pub(crate) fn push_function_of_old_name(stack: Stack<'_>, id: FunctionId) {
    push_callback(stack, call_without_notice, id.number());
}

fn call_function(stack: Stack<'_>, number: usize) -> Result<c_int, String> {
    let env = stack.owner();
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
            .owner()
            .registry
            .function(number)
            .ok_or("there is no such function.")?,
    )
}

fn call_bound(stack: Stack<'_>, bound: &Bound) -> Result<c_int, String> {
    let result = (bound.function.call)(&mut Args::new(stack))
        .or_else(|error| fail(stack, bound, &bound.worded(error)));
    if bound.function.mutates {
        stack.owner().collect_events();
    }
    result
}

/// Raises the error; or returns -1 or nothing, where the script chose that errors are not raised (spec: vrep-era 2.2).
fn fail(stack: Stack<'_>, bound: &Bound, error: &ApiError) -> Result<c_int, String> {
    let env = stack.owner();
    let is_refusal = !matches!(
        error,
        ApiError::NotImplemented(_) | ApiError::Interrupted | ApiError::BadArgument { .. }
    );
    if is_refusal {
        env.last_error.replace(error.to_string());
    }
    if env.raises_errors.get() || !is_refusal {
        return Err(error_text(error, stack, &bound.name));
    }
    let returns_a_number = matches!(bound.function.returns.first(), Some(&("int" | "float")));
    if returns_a_number {
        stack.push_int(-1);
    }
    Ok(returns_a_number.into())
}

/// The string a Lua script catches: the line of its call, the function and the reason.
pub(crate) fn error_text(error: &ApiError, stack: Stack<'_>, function: &str) -> String {
    let files = &stack.owner().registry.files;
    let line = stack.line_of_caller(|chunk| files.contains_key(chunk));
    match error {
        ApiError::NotImplemented(_) => format!("{line}: {error}"),
        ApiError::BadArgument { position, reason } => stack.argument_error(*position, reason),
        // Scripts know these words, and the function that calls all plugins in CoppeliaSim.
        ApiError::Plugin(_) => format!("{line}: error in 'sim.genericFunctionHandler': {error}"),
        _ => format!("{line}: in {function}: {error}"),
    }
}

/// The line logged at the first call of a deprecated function.
pub(crate) fn deprecation_notice(name: &str, replacement: &str) -> String {
    let advice = match replacement {
        "" => " and the related functionality will disappear in a future release.".to_owned(),
        _ => format!(". please use {replacement} instead."),
    };
    format!("{name} is deprecated{advice}")
}
