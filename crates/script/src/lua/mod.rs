//! The interface to Lua: mlua owns the virtual machine, and hot code calls Lua's C interface through `mlua::ffi`.
//!
//! Why not mlua's own functions for everything: scripts must catch error *strings* with the caller's line, as CoppeliaSim raises them;
//! threads are pre-empted from a count hook; and a call must cost tens of nanoseconds.
//!
//! The discipline that makes it hold:
//! - A [`State`] is used from one thread and closed once, by mlua, when the last reference is dropped.
//! - A [`Stack`] is a view of one coroutine of a living state. It checks indices and types before it follows them, so that a mistake
//!   is a wrong answer or a panic, and not a wild pointer. Every push makes room for what it pushes.
//! - [`api`] declares Lua's functions that cannot fail, with argument types that prove it; so they need no `unsafe` where they are called.
//! - What reads the bytes of a string in place ([`Stack::with_bytes`]) is `Send`, so it has no access to the state that could free them.
//! - Lua raises errors by `longjmp`. Only [`Stack::protected_call`] runs code that may raise; functions of ours raise as their very last
//!   act, from a frame that owns nothing ([`calls::entry`]). Going through a table ([`Entries`]) looks whether the table still has the key, since Lua
//!   raises where it has not. Allocation failure aborts (see `Pool`), so that pushing never raises as long as what is pushed fits
//!   Lua's largest block: strings are cut to it, longer lists are refused before they are pushed ([`MAX_LIST_LENGTH`], `Data::MAX_ITEMS`).

// The library that mlua's declarations need.
use lua_sys as _;

mod api;
mod bytecode;
mod calls;
mod file;
mod hooks;
mod live;
mod object;
mod owner;
mod permissions;
mod pool;
mod random_state;
mod seal;
mod stack;
mod state;
mod subjects;

pub(crate) use api::{Entries, Room, Scalar};
pub(crate) use bytecode::{Bytecode, PassedFunction, Prototype};
pub(crate) use calls::callback::{Callback, Outcome, push_callback, push_plain};
pub(crate) use calls::{LuaError, MULTIPLE};
pub(crate) use file::report_closed_pipes;
pub(crate) use hooks::count::{
    HOOK_INTERVAL, HookAction, hasten_count_hook, install_coroutine_hooks, set_count_hook,
};
pub(crate) use hooks::debug_library::restrict_debug;
pub use hooks::interrupt::{
    interrupt_running_code, only_ask, place_is_exact, place_of_interruption,
};
pub use hooks::listener::ask_running_code;
pub(crate) use hooks::listener::{Catcher, Listener, listen, report_caught_errors};
pub(crate) use hooks::resume::report_dropped_errors;
pub(crate) use hooks::running::{NativeCall, RunningCallback, running_callback_number};
pub use hooks::running::{calls_begun, is_call};
pub(crate) use live::{Call, LiveCode};
pub use object::LuaObject;
pub(crate) use owner::Owner;
pub(crate) use permissions::{restrict_libraries, search_by_permissions};
pub(crate) use random_state::seeded;
pub(crate) use seal::seal_argument;
pub(crate) use stack::tables::MAX_LIST_LENGTH;
pub use stack::{Stack, Type};
pub(crate) use state::State;
pub(crate) use subjects::accept_buffers;

use crate::budget::Budget;

#[cfg(test)]
mod tests;
