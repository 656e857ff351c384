//! The usual main script without a Lua state: what its callbacks do is done in Rust until anything else is asked of the script.
//!
//! It begins anew with each simulation, and to make its state takes longer than a step of a small scene. Code that is run in the main
//! script, joints in kinematic motion, a debugger and captures get the Lua state, made as if it had been there from the beginning.

mod stages;

use std::cell::{Cell, OnceCell, RefCell};
use std::rc::Rc;

use super::{LuaInterpreter, LuaLanguage, startup};
use crate::coverage::LineCounts;
use crate::function_ref::FunctionRef;
use crate::host::{
    CallError, CallbackResult, Callee, Env, Hook, Interpreter, ScriptError, Sim, SourceText,
};
use crate::lua::{NativeCall, RunningCallback};
use crate::sys_call::SysCall;
use scene::Data;
use scene::object::script_object::ScriptType;
use stages::Stages;

/// What the usual main script requires: modules that an embedding program may have of its own.
const REQUIRED: [&str; 2] = ["defaultMainScript", "sim"];

/// A main script with the usual text.
pub(super) struct UsualMain {
    env: Rc<Env>,
    language: LuaLanguage,
    stages: Stages,
    /// The text, as it was loaded.
    text: RefCell<Option<Text>>,
    /// The interpreter, once it was needed.
    lua: OnceCell<LuaInterpreter>,
    /// Where its random numbers begin, which the usual text does not draw.
    random: Cell<[u64; 4]>,
}

struct Text {
    bytes: Vec<u8>,
    chunk_name: String,
}

impl UsualMain {
    /// The interpreter of a script that is the usual main script; None for all others.
    pub(super) fn new(language: &LuaLanguage, env: &Rc<Env>) -> Option<Self> {
        let sim = env.sim.upgrade()?;
        let is_usual = env.script.script_type == ScriptType::Main
            && env.script.detached.borrow().code == sim.modules.registry.main_script().as_bytes();
        let is_replaced = || {
            let mut modules = language.user_modules.iter();
            modules.any(|module| REQUIRED.contains(&module.name.as_str()))
        };
        if !is_usual || sim.has_traps() || is_replaced() {
            return None;
        }
        Some(Self {
            env: Rc::clone(env),
            language: language.clone(),
            stages: Stages::of(&sim.modules.registry)?,
            text: RefCell::default(),
            lua: OnceCell::new(),
            random: Cell::new(startup::random_of(sim.scripts.seed.get())),
        })
    }

    /// The interpreter, as if it had loaded the text when the script began. None of what the text does is seen outside of it.
    fn lua(&self) -> Result<&LuaInterpreter, ScriptError> {
        if self.lua.get().is_none() {
            let lua = self.language.interpreter(&self.env);
            lua.start()?;
            if let Some(text) = &*self.text.borrow() {
                lua.load(&SourceText {
                    text: &text.bytes,
                    chunk_name: &text.chunk_name,
                    counted_as: None,
                })?;
            }
            // It was empty a moment ago, and nothing else sets it.
            let _ = self.lua.set(lua);
        }
        self.lua
            .get()
            .ok_or_else(|| ScriptError::new("there is no Lua interpreter."))
    }
}

impl Interpreter for UsualMain {
    fn start(&self) -> Result<(), ScriptError> {
        Ok(())
    }

    fn load(&self, source: &SourceText<'_>) -> Result<(), ScriptError> {
        self.text.replace(Some(Text {
            bytes: source.text.to_vec(),
            chunk_name: source.chunk_name.to_owned(),
        }));
        Ok(())
    }

    fn defines(&self, call: SysCall) -> bool {
        self.lua
            .get()
            .map_or_else(|| stages::defines(call), |lua| lua.defines(call))
    }

    fn call_callback(&self, call: SysCall, args: &[Data]) -> Result<CallbackResult, ScriptError> {
        if let Some(lua) = self.lua.get() {
            return lua.call_callback(call, args);
        }
        if !stages::defines(call) {
            return Ok(CallbackResult::NotDefined);
        }
        if !stages::are_known(call) {
            return self.lua()?.call_callback(call, args);
        }
        let _running = RunningCallback::begin(call as usize);
        let _call = NativeCall::begin();
        self.stages.run(&self.env, call)?;
        Ok(CallbackResult::Returned(None))
    }

    fn random_state(&self) -> Option<[u64; 4]> {
        self.lua
            .get()
            .map_or(Some(self.random.get()), Interpreter::random_state)
    }

    fn seed_random(&self, seed: u32) -> Result<(), ScriptError> {
        self.random.set(startup::random_of(seed));
        self.lua.get().map_or(Ok(()), |lua| lua.seed_random(seed))
    }

    fn host_calls(&self) -> Option<u64> {
        self.lua.get().and_then(Interpreter::host_calls)
    }

    fn is_idle(&self, call: SysCall, is_defined: bool) -> bool {
        self.lua
            .get()
            .map_or(!is_defined, |lua| lua.is_idle(call, is_defined))
    }

    fn call_hook(&self, hook: &Hook, args: &[Data]) -> Result<bool, ScriptError> {
        self.lua()?.call_hook(hook, args)
    }

    fn call(&self, function: Callee<'_>, args: &[Data]) -> Result<Vec<Data>, CallError> {
        self.lua()?.call(function, args)
    }

    fn run(&self, text: &[u8], chunk_name: &str) -> Result<(), ScriptError> {
        self.lua()?.run(text, chunk_name)
    }

    fn evaluate(&self, text: &[u8]) -> Result<Vec<Data>, ScriptError> {
        self.lua()?.evaluate(text)
    }

    fn call_library(
        &self,
        module: &str,
        function: &str,
        args: &[Data],
    ) -> Result<Vec<Data>, ScriptError> {
        self.lua()?.call_library(module, function, args)
    }

    fn release(&self, function: FunctionRef) {
        if let Some(lua) = self.lua.get() {
            lua.release(function);
        }
    }

    fn traceback(&self) -> String {
        self.lua().map(Interpreter::traceback).unwrap_or_default()
    }

    fn take_line_counts(&self, sim: &Sim) -> LineCounts {
        self.lua
            .get()
            .map(|lua| lua.take_line_counts(sim))
            .unwrap_or_default()
    }
}
