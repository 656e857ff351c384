//! What the host knows about one Lua state: whose it is, its yield levels, hooks, random numbers.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, HashSet};
use std::rc::{Rc, Weak};
use std::sync::Arc;

use super::instance::Script;
use super::random::Random;
use crate::script::binding::registry::Registry;
use crate::script::binding::states::States;
use crate::script::calls::callback::SysCall;
use crate::script::coverage::Coverage;
use crate::script::events::Filters;
use crate::script::log::verbosity;
use crate::script::lua::{Budget, FunctionRef, Stack, State};
use crate::script::sim::Sim;

/// The host's side of one Lua state.
pub(crate) struct Env {
    pub(in crate::script) sim: Weak<Sim>,
    pub script: Rc<Script>,
    /// What the script can reach.
    pub registry: Arc<Registry>,
    /// Callbacks whose function was there when the chunk had run.
    pub defined: Cell<u64>,
    pub hooks: RefCell<Hooks>,
    /// Calls of this state in progress.
    pub depth: Cell<usize>,
    pub yields: Yields,
    pub random: RefCell<Random>,
    /// The event filter of the state; None for all events.
    pub event_filters: RefCell<Option<Filters>>,
    /// Whether there are event listeners, so that changes must be collected.
    pub events_wanted: Rc<Cell<bool>>,
    /// What modules keep for the script; it goes with the state.
    pub module_states: States,
    /// The memory of the state.
    pub budget: Rc<Budget>,
    warned: RefCell<HashSet<&'static str>>,
    warned_deprecated: RefCell<HashSet<usize>>,
    watched: bool,
    /// What counts the lines that run, if they are counted.
    pub coverage: Option<Coverage>,
}

/// May code of this state yield, and when is it made to?
#[derive(Default)]
pub(crate) struct Yields {
    /// 0: pre-emption is allowed in code outside of coroutines that have a level of their own.
    pub auto: Cell<i64>,
    /// 0: yielding is allowed at all.
    pub overall: Cell<i64>,
    /// Whole milliseconds, as scripts set it.
    pub delay_ms: Cell<u32>,
    /// Instructions run by coroutines since the slice began.
    pub used: Cell<u64>,
    /// The count hook comes early, to end a slice.
    pub hastened: Cell<bool>,
}

/// Functions that run before and after callbacks.
#[derive(Default)]
pub(crate) struct Hooks {
    pub before: BTreeMap<SysCall, Vec<Hook>>,
    pub after: BTreeMap<SysCall, Vec<Hook>>,
}

/// One hook: a kept function, or the dotted name of a global.
#[derive(Clone)]
pub(crate) struct Hook {
    pub name: String,
    pub function: Option<FunctionRef>,
}

impl Env {
    fn new(sim: &Rc<Sim>, script: &Rc<Script>) -> Self {
        Self {
            sim: Rc::downgrade(sim),
            script: script.clone(),
            registry: sim.modules.registry.clone(),
            defined: Cell::new(0),
            hooks: RefCell::default(),
            depth: Cell::new(0),
            yields: Yields { delay_ms: Cell::new(2), ..Yields::default() },
            random: RefCell::new(Random::new(sim.options.seed)),
            event_filters: RefCell::default(),
            events_wanted: Rc::clone(&sim.events.listening),
            module_states: States::default(),
            budget: Rc::clone(&sim.scripts.budget),
            warned: RefCell::default(),
            warned_deprecated: RefCell::default(),
            watched: sim.options.limits.is_some(),
            coverage: sim.options.count_lines.then(Coverage::default),
        }
    }

    /// The environment of the state `stack` belongs to.
    pub(crate) fn of<'a>(stack: Stack<'a>) -> &'a Self {
        stack.owner()
    }

    /// Logs a warning at the first call of `name` in this state.
    pub(crate) fn warn_once(&self, name: &'static str, warning: &str) {
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
    pub(crate) fn log(&self, level: i64, text: &str) {
        if let Some(sim) = self.sim.upgrade() {
            sim.log_from(&self.script, level, text);
        }
    }

    /// Whether code of this state may be ended from outside at any time.
    pub(crate) fn is_interruptible(&self) -> bool {
        self.watched
    }

    /// Whether the user wants the program to end.
    pub(crate) fn is_interrupted(&self) -> bool {
        self.sim.upgrade().is_none_or(|sim| sim.is_interrupted())
    }

    /// Lets the runner of a test know where code is that has to stop.
    pub(crate) fn note_interruption(&self, stack: Stack<'_>) {
        if let Some(bench) = self.sim.upgrade().as_ref().and_then(|sim| sim.test_bench.get()) {
            bench.note_interruption(|| stack.traceback_from(0));
        }
    }

    /// Turns the changes of a call into events, if there are listeners.
    pub(crate) fn collect_events(&self) {
        if self.events_wanted.get()
            && let Some(sim) = self.sim.upgrade()
        {
            sim.collect_events();
        }
    }

    /// Whether the callback has a function or a hook to run.
    pub(crate) fn responds_to(&self, call: SysCall) -> bool {
        self.defined.get() & call.bit() != 0 || self.has_hooks(call)
    }

    pub(crate) fn has_hooks(&self, call: SysCall) -> bool {
        let hooks = self.hooks.borrow();
        [&hooks.before, &hooks.after].iter().any(|list| list.get(&call).is_some_and(|hooks| !hooks.is_empty()))
    }
}

/// A Lua state with its environment.
pub(crate) struct Runtime {
    // Dropped first: finalizers may still call API functions, which look at the environment.
    pub lua: State,
    pub env: Rc<Env>,
}

impl Runtime {
    /// A state with the standard libraries only; `startup` fills it.
    pub(crate) fn new(sim: &Rc<Sim>, script: &Rc<Script>) -> Self {
        let env = Rc::new(Env::new(sim, script));
        Self { lua: State::new(Rc::clone(&env)), env }
    }

    pub(crate) fn stack(&self) -> Stack<'_> {
        self.lua.stack()
    }
}

impl Drop for Runtime {
    fn drop(&mut self) {
        if let Some(sim) = self.env.sim.upgrade() {
            sim.collect_line_counts(self);
        }
    }
}
