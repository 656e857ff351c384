//! Environment of one running script: its owner, yield levels, hooks, random numbers.

pub(super) mod level;
pub(super) mod yields;

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::{BTreeMap, HashSet};
use std::rc::{Rc, Weak};
use std::sync::Arc;

use capture::Tape;

use super::{Runtime, Script, Sim};
use crate::binding::registry::{Bound, Registry};
use crate::binding::source::Values;
use crate::binding::states::States;
use crate::error::ApiResult;
use crate::event_stream::EventFilters;
use crate::function_ref::FunctionRef;
use crate::log::verbosity;
use crate::random::Random;
use crate::sys_call::SysCall;
use scene::Data;
use yields::Yields;

/// The host's side of one interpreter.
pub struct Env {
    /// The simulator, as long as it is there.
    pub(crate) sim: Weak<Sim>,
    /// The script that the environment belongs to.
    pub script: Rc<Script>,
    /// The interpreter this belongs to; there from its creation on.
    pub(crate) runtime: OnceCell<Weak<Runtime>>,
    /// The functions and modules that the script can reach.
    pub registry: Rc<Arc<Registry>>,
    /// Callbacks whose function existed after the chunk had run.
    pub defined: Cell<u64>,
    /// Callbacks that have or had hooks: most have none, which is all that a call needs to know.
    pub hooked: Cell<u64>,
    /// The hooks of the script, by callback.
    pub hooks: RefCell<Hooks>,
    /// Calls of this state in progress.
    pub depth: Cell<usize>,
    /// Whether code of the script may yield, and the length of its time slice.
    pub yields: Yields,
    /// The random numbers of the script, seeded with the seed of the simulator.
    pub random: RefCell<Random>,
    /// The event filter of the state; None for all events.
    pub event_filters: RefCell<Option<EventFilters>>,
    /// Whether there are event listeners, so that changes must be collected.
    pub events_wanted: Rc<Cell<bool>>,
    /// The state of modules for the script; it is dropped with the interpreter.
    pub module_states: States,
    /// Whether refused calls raise errors; they only return -1 otherwise.
    pub raises_errors: Cell<bool>,
    /// Reason of the last refused call.
    pub last_error: RefCell<String>,
    warned: RefCell<HashSet<&'static str>>,
    warned_deprecated: RefCell<HashSet<usize>>,
    watched: bool,
    tape: Tape,
    is_debugged: bool,
}

/// Functions that run before and after callbacks. The lists are shared with the callback that is running, which may change them.
#[derive(Default)]
pub struct Hooks {
    /// Hooks that run before a callback.
    pub before: BTreeMap<SysCall, Rc<Vec<Hook>>>,
    /// Hooks that run after a callback.
    pub after: BTreeMap<SysCall, Rc<Vec<Hook>>>,
}

/// One hook: a kept function, or the dotted name of a global.
#[derive(Clone)]
pub struct Hook {
    /// The name of the function, with dots for fields of tables.
    pub name: String,
    /// The function, where the script passed it by value.
    pub function: Option<FunctionRef>,
}

impl Env {
    pub(crate) fn new(sim: &Rc<Sim>, script: &Rc<Script>) -> Self {
        Self {
            sim: Rc::downgrade(sim),
            script: script.clone(),
            runtime: OnceCell::new(),
            registry: sim.modules.registry.clone(),
            defined: Cell::new(0),
            hooked: Cell::new(0),
            hooks: RefCell::default(),
            depth: Cell::new(0),
            yields: Yields {
                delay_ms: Cell::new(2),
                ..Yields::default()
            },
            random: RefCell::new(Random::new(sim.scripts.seed.get())),
            event_filters: RefCell::default(),
            events_wanted: Rc::clone(&sim.events.listening),
            module_states: States::default(),
            raises_errors: Cell::new(true),
            last_error: RefCell::default(),
            warned: RefCell::default(),
            warned_deprecated: RefCell::default(),
            watched: sim.options.limits.is_some(),
            tape: sim.options.permissions.tape().clone(),
            is_debugged: sim.scripts.debugger.get().is_some(),
        }
    }

    /// Logs a warning at the first call of `name` in this state.
    pub fn warn_once(&self, name: &'static str, warning: &str) {
        if self.warned.borrow_mut().insert(name) {
            self.log(verbosity::SCRIPT_WARNINGS, warning);
        }
    }

    /// Logs a deprecation at the first call of native function `number` in this state.
    pub(crate) fn warn_deprecated(&self, number: usize, notice: impl FnOnce() -> String) {
        if self.warned_deprecated.borrow_mut().insert(number) {
            self.log(verbosity::SCRIPT_WARNINGS, &notice());
        }
    }

    /// Logs in the name of the script.
    pub fn log(&self, level: i64, text: &str) {
        if let Some(sim) = self.sim.upgrade() {
            sim.log_from(&self.script, level, text);
        }
    }

    /// Whether code of this state may be ended from outside at any time.
    pub(crate) fn is_interruptible(&self) -> bool {
        self.watched
    }

    /// The error that has to end the running code, if it has to end. An interpreter asks this while a script runs: the thread that could
    /// interrupt it is waiting for it. The runner of a test learns where the code was.
    pub fn interruption(&self, traceback: impl FnOnce() -> String) -> Option<&'static str> {
        if !self.watched {
            return None;
        }
        let sim = self.sim.upgrade();
        if !sim.as_ref().is_none_or(|sim| sim.options.is_interrupted()) {
            return None;
        }
        if let Some(bench) = sim.as_ref().and_then(|sim| sim.test_bench.get()) {
            bench.note_interruption(traceback);
        }
        Some("interrupted.")
    }

    /// The simulator, until it is gone.
    pub fn simulator(&self) -> Option<Rc<Sim>> {
        self.sim.upgrade()
    }

    /// The tape on which everything comes from outside.
    pub(crate) fn tape(&self) -> &Tape {
        &self.tape
    }

    /// The script in the words of a message.
    pub(crate) fn script_name(&self) -> String {
        let sim = self.sim.upgrade();
        let scene = sim.as_ref().and_then(|sim| sim.scene.try_borrow().ok());
        scene.map_or_else(
            || "a script".into(),
            |scene| format!("script {}", self.script.log_name(&scene)),
        )
    }

    /// Notifies a debugger that a call of the script may have changed the scene.
    pub(crate) fn tell_of_change(&self) {
        if self.is_debugged
            && let Some(sim) = self.sim.upgrade()
        {
            sim.notify_debugger(|debugger| debugger.scene_changed(&sim, Some(&self.script)));
        }
    }

    /// The interpreter this belongs to, until it is closed.
    pub(crate) fn runtime(&self) -> Option<Rc<Runtime>> {
        self.runtime.get()?.upgrade()
    }

    /// Calls a native function on behalf of the script, with plain values.
    pub(crate) fn call_native(&self, bound: &Bound, args: &[Data]) -> ApiResult<Vec<Data>> {
        let values = Values::new(args, self);
        let results = bound.call_data(self.tape(), values, || self.script_name());
        if bound.function.mutates {
            self.collect_events();
        }
        results.map_err(|error| bound.worded(error))
    }

    /// Whether the callback has a function or a hook to run.
    pub(crate) fn responds_to(&self, call: SysCall) -> bool {
        self.defined.get() & call.bit() != 0 || self.has_hooks(call)
    }

    /// The callbacks that have or had a function or hooks, as bits.
    pub(crate) fn may_respond(&self) -> u64 {
        self.defined.get() | self.hooked.get()
    }

    pub(crate) fn has_hooks(&self, call: SysCall) -> bool {
        if self.hooked.get() & call.bit() == 0 {
            return false;
        }
        let hooks = self.hooks.borrow();
        [&hooks.before, &hooks.after]
            .iter()
            .any(|list| list.get(&call).is_some_and(|hooks| !hooks.is_empty()))
    }

    /// Notes that the callback gets a hook.
    pub fn note_hook(&self, call: SysCall) {
        self.hooked.set(self.hooked.get() | call.bit());
    }

    /// The hooks that run before the callback, or those that run after it.
    pub(crate) fn hooks_of(&self, call: SysCall, before: bool) -> Option<Rc<Vec<Hook>>> {
        if self.hooked.get() & call.bit() == 0 {
            return None;
        }
        let hooks = self.hooks.borrow();
        if before { &hooks.before } else { &hooks.after }
            .get(&call)
            .cloned()
    }
}
