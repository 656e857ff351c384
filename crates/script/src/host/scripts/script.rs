//! A script as seen by the host: identity, state, runtime.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use crate::host::Runtime;
use crate::sys_call::SysCall;
use scene::Handle;
use scene::object::script_object::{ExecutionPriority, ScriptType};

/// Base states and bits of a script's state (spec: scripts 3).
pub(crate) mod state {
    pub const UNLOADED: i64 = 0;
    pub const UNINITIALIZED: i64 = 1;
    pub const INITIALIZED: i64 = 2;
    pub const ENDED: i64 = 3;
    pub const ERROR: i64 = 8;
}

/// A script of the simulator. What every call looks at comes first: with thousands of scripts, a call takes as long as the memory it
/// has to wait for.
#[repr(C)]
pub struct Script {
    /// The handle scripts know it by.
    pub id: i64,
    state: Cell<i64>,
    pub(crate) runtime: RefCell<Option<Rc<Runtime>>>,
    /// Whether the object is disabled, and the edition of the scripts of the scene that this is from.
    pub(crate) disabled: Cell<(u64, bool)>,
    /// Its type, which decides when its callbacks are called.
    pub script_type: ScriptType,
    pub(crate) removed: Cell<bool>,
    /// Callbacks that do nothing, until code of the script runs.
    pub(crate) idle: Cell<IdleCallbacks>,
    /// The scene object that holds text and flags; None for main, sandbox and add-ons.
    pub object: Option<Handle>,
    /// The data of a detached script, which has no object.
    pub detached: Box<RefCell<Detached>>,
    /// The file its text comes from, as the user named it: errors name it in the log.
    pub file: RefCell<Option<String>>,
    /// The run counter of an old script, from before callbacks had one.
    pub execution_count: Cell<i64>,
}

/// Callbacks of a script that need not be called, as bits: their interpreters, of which there may be thousands, are not touched then.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct IdleCallbacks {
    undefined: u64,
    empty: u64,
}

impl IdleCallbacks {
    /// The same with one more, which has an empty function or none.
    pub(crate) fn with(mut self, call: SysCall, is_defined: bool) -> Self {
        if is_defined {
            self.empty |= call.bit();
        } else {
            self.undefined |= call.bit();
        }
        self
    }

    /// Whether a function would run if this one were called; None where it has to be called.
    pub(crate) fn would_run(self, call: SysCall) -> Option<bool> {
        let is_empty = self.empty & call.bit() != 0;
        (is_empty || self.undefined & call.bit() != 0).then_some(is_empty)
    }
}

/// Text and flags of a script that is no scene object.
#[derive(Debug, Clone, Default)]
pub struct Detached {
    /// Its name in the log.
    pub name: String,
    /// Its text, with bytes as in the file.
    pub code: Vec<u8>,
    /// The name of the text in error positions.
    pub chunk_name: String,
    /// The file of the text, used as its name.
    pub source: Option<String>,
    /// Whether it does not run.
    pub disabled: bool,
    /// Whether it starts again after an error.
    pub restart_on_error: bool,
    /// Its place among the scripts of its type.
    pub priority: ExecutionPriority,
    /// The path of an add-on's file, which is the property `addOnPath`; empty without one.
    pub path: String,
    /// The language of the text; empty for Lua.
    pub language: String,
    /// The object an old script is attached to.
    pub owner: Option<Handle>,
}

impl Detached {
    /// A script of the simulator's own, with the name that Lua shows in error positions as well.
    pub fn of_text(name: &str, code: &[u8]) -> Self {
        Self {
            name: name.to_owned(),
            chunk_name: name.to_owned(),
            code: code.to_vec(),
            priority: ExecutionPriority::Normal,
            ..Self::default()
        }
    }

    /// Scripts that are no objects are in Lua, unless a scene specifies another language.
    pub(crate) fn language(&self) -> &str {
        if self.language.is_empty() {
            "lua"
        } else {
            &self.language
        }
    }
}

impl Script {
    pub(crate) fn of_object(handle: Handle, script_type: ScriptType) -> Self {
        Self::new(handle.raw(), script_type, Some(handle), Detached::default())
    }

    pub(crate) fn detached(id: i64, script_type: ScriptType, detached: Detached) -> Self {
        Self::new(id, script_type, None, detached)
    }

    fn new(id: i64, script_type: ScriptType, object: Option<Handle>, detached: Detached) -> Self {
        Self {
            id,
            script_type,
            object,
            detached: Box::new(RefCell::new(detached)),
            state: Cell::new(state::UNLOADED),
            runtime: RefCell::new(None),
            removed: Cell::new(false),
            idle: Cell::default(),
            disabled: Cell::new((0, false)),
            file: RefCell::default(),
            execution_count: Cell::new(0),
        }
    }

    /// Replaces its text, which comes from a file or from a program.
    pub fn set_text(&self, language: &str, code: &[u8], file: Option<String>) {
        let mut detached = self.detached.borrow_mut();
        detached.language = language.to_owned();
        detached.code = code.to_vec();
        self.file.replace(file);
    }

    /// The object an old script is attached to, instead of being one itself.
    pub fn owner(&self) -> Option<Handle> {
        self.detached.borrow().owner
    }

    /// `scriptState`: base state, error bit, suspended bit.
    pub fn state(&self) -> i64 {
        self.state.get()
    }

    /// The state without its bits.
    pub(crate) fn base_state(&self) -> i64 {
        self.state.get() & 7
    }

    pub(crate) fn set_base_state(&self, base: i64) {
        self.state.set(self.state.get() & !7 | base);
    }

    pub(crate) fn set_state(&self, state: i64) {
        self.state.set(state);
    }

    pub(crate) fn mark_error(&self) {
        self.state.set(self.state.get() | state::ERROR);
    }

    /// Initialised, without error, not suspended.
    pub(crate) fn is_running(&self) -> bool {
        self.state.get() == state::INITIALIZED
    }

    /// Whether none of these callbacks does anything in it. They do not start scripts.
    pub(crate) fn ignores(&self, callbacks: u64) -> bool {
        match self.state.get() {
            state::UNINITIALIZED => false,
            state::INITIALIZED => self
                .runtime
                .borrow()
                .as_ref()
                .is_none_or(|runtime| runtime.env.may_respond() & callbacks == 0),
            _ => true,
        }
    }

    /// Its interpreter, while it runs.
    pub fn current_runtime(&self) -> Option<Rc<Runtime>> {
        self.runtime.borrow().clone()
    }

    /// Calls of this script in progress.
    pub(crate) fn depth(&self) -> usize {
        self.runtime
            .borrow()
            .as_ref()
            .map_or(0, |runtime| runtime.env.depth.get())
    }
}
