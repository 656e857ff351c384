//! What a scriptable function is, and how Lua finds it.

pub(in crate::script) mod args;
pub(in crate::script) mod by_handle;
pub(in crate::script) mod cx;
pub(in crate::script) mod data;
pub(in crate::script) mod returns;

use std::collections::HashMap;
use std::ffi::{c_int, c_void};

use super::error::ApiResult;
use super::lifecycle::embedded::Embedded;
use super::lifecycle::env::Env;
use super::lua::{Stack, push_callback};
use args::Args;

/// One parameter of a scriptable function.
#[derive(Debug)]
pub struct Param {
    pub name: &'static str,
    pub ty: &'static str,
    pub default: Option<&'static str>,
}

/// One scriptable function: its documentation and its code, declared together by `#[api]`.
pub struct ApiFn {
    /// `sim.name`, or a bare name for globals.
    pub name: &'static str,
    pub doc: &'static str,
    pub params: &'static [Param],
    /// Types of the results.
    pub returns: &'static [&'static str],
    pub mutates: bool,
    pub(crate) call: fn(&mut Args<'_>) -> ApiResult<c_int>,
}

/// The table of contents of a file of scriptable functions.
macro_rules! functions {
    ($($name:ident),* $(,)?) => { &[$($name::API),*] };
}
pub(crate) use functions;

/// A name scripts can call, with the function behind it.
pub(crate) struct Bound {
    pub name: &'static str,
    pub function: &'static ApiFn,
    /// The text logged at the first call.
    pub deprecation: Option<&'static str>,
}

/// What the name of a `sim` member stands for.
pub(crate) enum Member {
    Constant(i64),
    Native(Bound),
    /// Implemented as `function` in the embedded Lua file `module`.
    Lua {
        module: &'static str,
        function: &'static str,
        deprecation: Option<&'static str>,
    },
    /// In the reference, but not built.
    Missing {
        name: &'static str,
    },
}

/// Everything scripts can reach, by name. Built once per process by `modules::registry`.
#[derive(Default)]
pub(crate) struct Registry {
    /// Members of `sim`, without the prefix.
    pub members: HashMap<&'static str, Member>,
    /// Functions that are globals.
    pub globals: Vec<Bound>,
    /// V-REP era names that do not follow the rule `simName` = `sim.name`, `sim_name` = `sim.name`: old name and member.
    pub old_names: HashMap<&'static str, &'static str>,
    /// Embedded Lua files by module name.
    pub modules: HashMap<&'static str, Embedded>,
    /// Native functions of Lua modules by module name: the module itself where there is no Lua file, else for that file's use.
    pub libraries: HashMap<&'static str, Vec<Bound>>,
}

/// Pushes `bound` as a Lua function.
pub(crate) fn push_bound(stack: Stack<'_>, bound: &'static Bound) {
    push_callback(stack, call_bound, std::ptr::from_ref(bound).cast());
}

fn call_bound(stack: Stack<'_>, data: *const c_void) -> Result<c_int, String> {
    // SAFETY: `push_bound` stored a `&'static Bound`.
    let bound = unsafe { &*data.cast::<Bound>() };
    if let Some(notice) = bound.deprecation {
        Env::of(stack).warn_once(bound.name, notice);
    }
    let result = (bound.function.call)(&mut Args::new(stack)).map_err(|error| error.text(stack, bound.name));
    if bound.function.mutates {
        Env::of(stack).tell_changes();
    }
    result
}
