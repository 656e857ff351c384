//! Definition of functions for scripts: their description, the decoding of arguments and encoding of results, and what can be found by
//! name.
//!
//! No simulator is known here. A call carries its environment without a look at it ([`source::Caller`]); `cx` makes a context of it.

pub(crate) mod args;
pub(crate) mod by_handle;
pub(crate) mod data;
pub(crate) mod embedded;
pub(crate) mod hooks;
pub(crate) mod literal;
pub(crate) mod module;
pub(crate) mod operand;
mod outside;
pub(crate) mod param;
pub(crate) mod registry;
pub(crate) mod returns;
pub(crate) mod sink;
pub(crate) mod source;
pub(crate) mod states;

use std::ffi::c_int;

use crate::error::{ApiError, ApiResult};
use args::Args;
use param::Param;
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
