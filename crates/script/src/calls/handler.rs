//! Handlers: script functions called on external events.

use std::rc::{Rc, Weak};

use crate::error::{ApiError, ApiResult};
use crate::function_ref::FunctionRef;
use crate::host::{CallError, Callee, Env, Level, MAX_DEPTH, Runtime, Script, Sim};
use crate::log::verbosity;
use crate::sys_call::SysCall;
use scene::Data;

/// A function by name, looked up at each call in a script of the caller's choice, or by value.
pub enum Handler {
    /// A function by name.
    Name(String),
    /// A function by value.
    Function(HeldFunction),
}

/// A function of an interpreter, released when this is dropped.
pub struct HeldFunction {
    runtime: Option<Weak<Runtime>>,
    function: FunctionRef,
}

impl Drop for HeldFunction {
    fn drop(&mut self) {
        if let Some(runtime) = self.runtime() {
            runtime.interpreter.release(self.function);
        }
    }
}

impl HeldFunction {
    /// A function that the script with that environment has passed to the host.
    pub fn new(env: &Env, function: FunctionRef) -> Self {
        Self {
            runtime: env.runtime().as_ref().map(Rc::downgrade),
            function,
        }
    }

    fn runtime(&self) -> Option<Rc<Runtime>> {
        self.runtime.as_ref()?.upgrade()
    }
}

impl Handler {
    /// The name, without the part after its last `@`; none for a function by value.
    fn name(&self) -> Option<&str> {
        match self {
            Self::Name(name) => Some(name.rsplit_once('@').map_or(name, |(name, _language)| name)),
            Self::Function(_) => None,
        }
    }
}

/// A function of a script that native code may call for as long as the script runs.
pub struct ScriptCallback {
    sim: Weak<Sim>,
    script: Weak<Script>,
    handler: Handler,
}

impl ScriptCallback {
    /// A handler of a script with that environment.
    pub(crate) fn of(env: &Env, handler: Handler) -> Self {
        Self {
            sim: env.sim.clone(),
            script: Rc::downgrade(&env.script),
            handler,
        }
    }

    /// # Errors
    /// When the function fails, or its script has ended.
    pub fn call(&self, args: &[Data]) -> ApiResult<Vec<Data>> {
        let alive = self.sim.upgrade().zip(self.script.upgrade());
        let (sim, script) = alive.ok_or(ApiError::ScriptNotInitialized)?;
        sim.try_handler(&script, &self.handler, args)
    }

    /// As [`ScriptCallback::call`], but a failure is logged and counted. None then, and when the script has ended.
    pub fn call_logged(&self, args: &[Data]) -> Option<Vec<Data>> {
        let (sim, script) = self.sim.upgrade().zip(self.script.upgrade())?;
        sim.call_handler(&script, &self.handler, args)
    }

    /// Logs a line in the name of the script, if it still runs.
    pub fn log(&self, level: i64, text: &str) {
        if let Some((sim, script)) = self.sim.upgrade().zip(self.script.upgrade()) {
            sim.log_from(&script, level, text);
        }
    }

    /// Logs a warning, if the script still runs.
    pub fn warn(&self, text: &str) {
        if let Some(sim) = self.sim.upgrade() {
            sim.log(verbosity::SCRIPT_WARNINGS, text);
        }
    }
}

impl Sim {
    /// Calls a handler; one by name is a function of `script`. A failure is logged and counted, and the script continues: it must not
    /// end because of what a peer has sent.
    pub fn call_handler(
        self: &Rc<Self>,
        script: &Rc<Script>,
        handler: &Handler,
        args: &[Data],
    ) -> Option<Vec<Data>> {
        match self.try_handler(script, handler, args) {
            Ok(results) => Some(results),
            Err(error) => {
                let name = handler.name().unwrap_or("function");
                self.log.count_error();
                self.log(
                    verbosity::ERRORS,
                    &format!("External call to simCallScriptFunction failed ('{name}'): {error}"),
                );
                None
            }
        }
    }

    fn try_handler(
        self: &Rc<Self>,
        script: &Rc<Script>,
        handler: &Handler,
        args: &[Data],
    ) -> ApiResult<Vec<Data>> {
        let runtime = match handler {
            Handler::Name(_) => script.current_runtime(),
            Handler::Function(held) => held.runtime(),
        };
        let runtime = runtime
            .filter(|runtime| runtime.env.script.is_running())
            .ok_or(ApiError::ScriptNotInitialized)?;
        let results = self.run_handler(&runtime, handler, args);
        if runtime.env.depth.get() == 0 {
            self.complete_call(&runtime.env.script, SysCall::Ext, None);
        }
        results
    }

    fn run_handler(
        self: &Rc<Self>,
        runtime: &Rc<Runtime>,
        handler: &Handler,
        args: &[Data],
    ) -> ApiResult<Vec<Data>> {
        let level = Level::enter(&self.scripts, &runtime.env);
        if level.too_deep {
            return Err(ApiError::TooDeep(MAX_DEPTH));
        }
        let function = match handler {
            Handler::Name(_) => Callee::Named(handler.name().unwrap_or_default()),
            Handler::Function(held) => Callee::Function(held.function),
        };
        runtime
            .interpreter
            .call(function, args)
            .map_err(|error| match error {
                CallError::NoSuchFunction => ApiError::CallFailed,
                CallError::Script(error) => ApiError::Other(error.text),
            })
    }
}
