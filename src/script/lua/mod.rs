//! The edge to Lua: mlua owns the virtual machine, and what is hot speaks to Lua's C interface through `mlua::ffi`.
//!
//! Why not mlua's own functions for everything: scripts must catch error *strings* with the caller's line, as CoppeliaSim raises them;
//! threads are pre-empted from a count hook; and a call must cost tens of nanoseconds.
//!
//! The discipline that makes it hold:
//! - A [`State`] is used from one thread and closed once, by mlua, when nobody holds it any more.
//! - A [`Stack`] is a view of one coroutine of a living state. It checks indices and types before it follows them, so that a mistake
//!   is a wrong answer and not a wild pointer.
//! - Lua raises errors by `longjmp`. Only [`Stack::protected_call`] runs code that may raise; callbacks raise as their very last
//!   act, from a frame that owns nothing ([`callback`]). Allocation failure aborts (see `Pool`), so that pushing never raises
//!   as long as what is pushed fits Lua's largest block: strings are cut to it, longer lists are refused before they are pushed
//!   ([`LONGEST_LIST`], `Data::MAX_ITEMS`).

mod api;
mod callback;
mod calls;
mod coroutine;
mod debug_library;
mod file;
mod functions;
mod guard;
mod object;
mod pool;
mod seal;
mod stack;
mod state;
mod tables;
mod text_only;

pub(crate) use callback::{Callback, push_callback};
pub(crate) use calls::{LuaError, MULTIPLE, compile};
pub(crate) use coroutine::{HOOK_INTERVAL, Verdict, hasten_count_hook, install_coroutine_hooks, set_count_hook};
pub(crate) use debug_library::restrict_debug;
pub(crate) use file::FileLock;
pub(crate) use object::Object;
pub(crate) use seal::seal_argument;
pub(crate) use stack::{Stack, Type};
pub(crate) use state::State;
pub(crate) use tables::LONGEST_LIST;
pub(crate) use text_only::refuse_bytecode;

use super::lifecycle::budget::Budget;

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use super::State;
    use crate::scene::object::script_object::ScriptType;
    use crate::script::lifecycle::env::Env;
    use crate::script::{Detached, Languages, Options, Registry, Silent, Sim};

    /// Calls `test` with a state that has the standard libraries only.
    pub(super) fn with_state<T>(test: impl FnOnce(&State) -> T) -> T {
        let registry = Registry::without_functions();
        let sim = Sim::new(Options::default(), registry, Box::new(Silent), Languages::default());
        let script = sim.scripts.add_detached(ScriptType::Sandbox, Detached::default());
        test(&State::new(Rc::new(Env::new(&sim, &script))))
    }
}
