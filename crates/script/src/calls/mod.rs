//! Calls between scripts: functions by name, code strings, initialisation (spec: calls).

mod api_call;
pub(crate) mod contacts;
mod data_changes;
mod event_batches;
pub(crate) mod handler;
mod ui_events;
pub(crate) mod vision;

use std::rc::Rc;

use super::error::{ApiError, ApiResult};
use crate::host::{
    CallError, CallbackResult, Callee, Level, MAX_DEPTH, Runtime, Script, ScriptError, Sim, state,
};
use crate::sys_call::SysCall;
use scene::object::script_object::ScriptType;
use scene::{Data, Field, Handle};

impl Sim {
    /// Calls the global function `name` (dots walk through tables) of a script.
    ///
    /// # Errors
    /// In CoppeliaSim's words; the callee's own error is logged under its name and ends it.
    pub fn call_function(
        self: &Rc<Self>,
        script: &Rc<Script>,
        name: &str,
        args: &[Data],
    ) -> ApiResult<Vec<Data>> {
        self.call_for_results(script, name, args)?
            .map_err(|_| ApiError::ErrorInCallee)
    }

    /// The same; the callee's own error is returned.
    ///
    /// # Errors
    /// In CoppeliaSim's words, or the message of the callee's error.
    pub(crate) fn call_for_program(
        self: &Rc<Self>,
        script: &Rc<Script>,
        name: &str,
        args: &[Data],
    ) -> Result<Vec<Data>, String> {
        match self.call_for_results(script, name, args) {
            Ok(results) => results.map_err(|error| error.message().to_owned()),
            Err(error) => Err(error.to_string()),
        }
    }

    /// The inner result is the callee's own; its error is logged and ends it.
    fn call_for_results(
        self: &Rc<Self>,
        script: &Rc<Script>,
        name: &str,
        args: &[Data],
    ) -> ApiResult<Result<Vec<Data>, ScriptError>> {
        let runtime = script
            .current_runtime()
            .ok_or(ApiError::ScriptNotInitialized)?;
        if !script.is_running() {
            return Err(ApiError::CallFailed);
        }
        let results = self.call_named(script, &runtime, name, args)?;
        if let Err(error) = &results {
            self.fail(script, error);
        }
        if runtime.env.depth.get() == 0 {
            self.complete_call(script, SysCall::Ext, None);
        }
        Ok(results)
    }

    /// The inner result is the callee's own.
    fn call_named(
        &self,
        script: &Rc<Script>,
        runtime: &Runtime,
        name: &str,
        args: &[Data],
    ) -> ApiResult<Result<Vec<Data>, ScriptError>> {
        let level = Level::enter_from_script(&self.scripts, &runtime.env);
        if level.too_deep {
            return Err(ApiError::TooDeep(MAX_DEPTH));
        }
        match runtime.interpreter.call(Callee::Named(name), args) {
            Ok(results) => Ok(Ok(results)),
            Err(CallError::Script(error)) => Ok(Err(error)),
            Err(CallError::NoSuchFunction) => self.call_builtin(script, name, args).map(Ok),
        }
    }

    /// Calls a function of a module by its full name: tables of modules are filled as scripts use them.
    fn call_builtin(&self, script: &Rc<Script>, name: &str, args: &[Data]) -> ApiResult<Vec<Data>> {
        let name = name.strip_suffix("@lua").unwrap_or(name);
        if !name.contains('.') || self.modules.registry.find(name).is_none() {
            return Err(ApiError::CallFailed);
        }
        self.call_api(script, name, args)
    }

    /// Runs a string in a script: as an expression if it is one, else as a chunk. The script is not marked when it fails.
    pub(crate) fn execute_string(
        self: &Rc<Self>,
        script: &Rc<Script>,
        code: &[u8],
    ) -> ApiResult<Vec<Data>> {
        let runtime = script
            .current_runtime()
            .ok_or(ApiError::Scene(scene::SceneError::OperationFailed))?;
        let level = Level::enter_from_script(&self.scripts, &runtime.env);
        if level.too_deep {
            return Err(ApiError::TooDeep(MAX_DEPTH));
        }
        runtime
            .interpreter
            .evaluate(code)
            .map_err(|_| scene::SceneError::OperationFailed.into())
    }

    /// Runs a file's text as a chunk in a script that lives already, as the sandbox does.
    ///
    /// # Errors
    /// The text of the error, which has been logged.
    pub fn run_in(
        self: &Rc<Self>,
        script: &Rc<Script>,
        code: &[u8],
        chunk_name: &str,
        file: Option<&str>,
    ) -> Result<(), String> {
        if let Some(file) = file {
            self.log.files.borrow_mut().insert(chunk_name, file);
        }
        let Some(runtime) = script.current_runtime() else {
            return Err(ApiError::ScriptNotInitialized.to_string());
        };
        let outcome = {
            let _level = Level::enter(&self.scripts, &runtime.env);
            runtime.interpreter.run(code, chunk_name)
        };
        outcome.map_err(|error| {
            self.fail(script, &error);
            self.complete_call(script, SysCall::Ext, None);
            error.text
        })
    }

    /// Resets a script and initialises it at once where 4.10 does. Add-ons that scripts have made are enabled by it: they are disabled
    /// objects before.
    pub fn init_script(self: &Rc<Self>, script: &Rc<Script>) {
        if script.depth() > 0 {
            // Its interpreter is in use: it restarts at the next call.
            return;
        }
        self.reset(script);
        match (script.script_type, script.object) {
            (ScriptType::Main, _) | (ScriptType::AddOn, None) => return,
            (ScriptType::AddOn, Some(object)) => self.enable(object),
            _ => {}
        }
        self.deliver(script, SysCall::Init, &[]);
    }

    fn enable(&self, object: Handle) {
        let mut scene = self.scene.borrow_mut();
        // One that is being removed stays as it is.
        let _ = scene.try_modify(object, Field::Script, |object| {
            object.script_mut()?.disabled = false;
            Ok(())
        });
    }

    /// Starts sandbox and add-ons.
    pub fn start_detached(self: &Rc<Self>, script: &Rc<Script>) {
        if script.script_type == ScriptType::AddOn && !self.add_on_starts_itself(script) {
            return;
        }
        self.deliver(script, SysCall::Init, &[]);
    }

    /// Whether an add-on starts by itself; its menu entry becomes its name.
    fn add_on_starts_itself(self: &Rc<Self>, script: &Rc<Script>) -> bool {
        let Some(info) = self.add_on_info(script) else {
            return true;
        };
        if let Some(Data::Text(menu)) = info.field("menu") {
            let menu = String::from_utf8_lossy(menu).replace('\n', " >> ");
            script.detached.borrow_mut().name = format!("{menu}@addOnScript");
        }
        info.field("autoStart").is_none_or(Data::truthy)
    }

    /// The value of an add-on's `sysCall_info`, for which it is loaded once more.
    fn add_on_info(self: &Rc<Self>, script: &Rc<Script>) -> Option<Data> {
        // Its errors are reported when it is loaded to run.
        let language = script.language(&self.scene.borrow());
        let runtime = self.create_runtime(script, &language).ok()?;
        let (code, name) = {
            let detached = script.detached.borrow();
            (detached.code.clone(), detached.chunk_name.clone())
        };
        let _level = Level::enter(&self.scripts, &runtime.env);
        runtime.interpreter.start().ok()?;
        runtime.interpreter.run(&code, &name).ok()?;
        match runtime.interpreter.call_callback(SysCall::Info, &[]) {
            Ok(CallbackResult::Returned(value)) => value,
            Ok(CallbackResult::NotDefined) | Err(_) => None,
        }
    }

    /// The end of the application: add-ons and the sandbox are notified that the objects go, and clean up.
    pub fn end_detached(self: &Rc<Self>) {
        let active = self.active_scripts();
        let ending = || {
            active.iter().filter(|script| {
                matches!(script.script_type, ScriptType::AddOn | ScriptType::Sandbox)
                    && script.base_state() == state::INITIALIZED
            })
        };
        self.remove_scene_at_exit(|call, args| {
            for script in ending() {
                self.deliver(script, call, args);
            }
        });
        for script in ending() {
            self.end(script);
        }
    }
}
