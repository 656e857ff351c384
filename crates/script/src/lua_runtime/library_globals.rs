//! Global names as the library's Lua code sees them: what the script does with a standard name is no concern of the library.
//!
//! Embedded files have a table of their own as `_ENV`. It contains the standard functions and libraries of the fresh state; all other
//! names are read from and written to the script's globals.

use std::ffi::CStr;

use crate::host::Sim;
use crate::lua::{Stack, Type};

/// The table of a state.
const LIBRARY_GLOBALS: &CStr = c"swanilda.globals";

/// Names with a value of the library's own. `print` and its kin load themselves at the first call, whoever calls.
const STANDARD: &[&str] = &[
    "assert",
    "coroutine",
    "debug",
    "error",
    "getmetatable",
    "io",
    "ipairs",
    "isbuffer",
    "load",
    "loadfile",
    "math",
    "next",
    "os",
    "package",
    "pairs",
    "pcall",
    "print",
    "rawequal",
    "rawget",
    "rawlen",
    "rawset",
    "require",
    "select",
    "setmetatable",
    "string",
    "table",
    "tobuffer",
    "tonumber",
    "tostring",
    "type",
    "unpack",
    "utf8",
    "xpcall",
];

/// Test libraries replace standard functions in the script's name.
const OF_SCRIPTS: &[&str] = &["busted", "luassert", "say"];

/// Makes the table, which has no names of its own yet: the library's first files change the standard functions.
pub(super) fn install(stack: Stack<'_>) {
    stack.new_table(0, STANDARD.len());
    stack.new_table(0, 2);
    for event in ["__index", "__newindex"] {
        stack.push_globals();
        stack.raw_set_field(-2, event);
    }
    stack.set_metatable(-2);
    stack.set_registry(LIBRARY_GLOBALS);
}

/// Takes the standard functions as they are now, and the functions that only the library calls.
pub(super) fn take(sim: &Sim, stack: Stack<'_>) {
    let internal = sim.modules.registry.globals.iter().map(|&(name, _)| name);
    stack.push_registry(LIBRARY_GLOBALS);
    stack.push_globals();
    for name in STANDARD.iter().copied().chain(internal) {
        if stack.raw_get_field(-1, name) == Type::Nil {
            stack.pop(1);
        } else {
            stack.raw_set_field(-3, name);
        }
    }
    stack.pop(2);
}

/// Lets the chunk on top, of the embedded file `name`, see the library's names.
pub(super) fn apply(stack: Stack<'_>, name: &str) {
    let first = name.split('/').next().unwrap_or_default();
    if !OF_SCRIPTS.contains(&first) {
        stack.push_registry(LIBRARY_GLOBALS);
        stack.set_environment();
    }
}

/// Pushes a standard function or library.
pub(super) fn push(stack: Stack<'_>, name: &str) {
    stack.push_registry(LIBRARY_GLOBALS);
    stack.raw_get_field(-1, name);
    stack.remove(-2);
}
