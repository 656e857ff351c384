//! Calls between scripts: functions by name, code strings, initialisation (spec: calls).

mod api_call;
pub(in crate::script) mod callback;
pub(in crate::script) mod data_changes;
pub(in crate::script) mod dispatch;
pub(in crate::script) mod handler;
pub(in crate::script) mod threads;

use std::rc::Rc;

use super::binding::data;
use super::error::{ApiError, ApiResult};
use super::lifecycle::env::Runtime;
use super::lifecycle::instance::{Script, state};
use super::lifecycle::level::Level;
use super::lifecycle::script_set::MAX_DEPTH;
use super::lifecycle::startup;
use super::lifecycle::{push_args, push_dotted};
use super::lua::{LuaError, MULTIPLE, Stack, Type};
use super::sim::Sim;
use crate::scene::Data;
use crate::scene::object::script_object::ScriptType;
use callback::SysCall;

impl Sim {
    /// Calls the global function `name` (dots walk through tables) of a script.
    ///
    /// # Errors
    /// In CoppeliaSim's words; the callee's own error is logged under its name and ends it.
    pub(crate) fn call_function(
        self: &Rc<Self>,
        script: &Rc<Script>,
        name: &str,
        args: &[Data],
    ) -> ApiResult<Vec<Data>> {
        let runtime = script.current_runtime().ok_or(ApiError::ScriptNotInitialized)?;
        if !script.is_running() {
            return Err(ApiError::CallFailed);
        }
        let results = self.call_in_state(&runtime, name, args)?.map_err(|error| {
            self.fail(script, &error.text);
            ApiError::ErrorInCallee
        });
        if runtime.env.depth.get() == 0 {
            self.complete_call(script, SysCall::Ext, None);
        }
        results
    }

    /// The inner result is the callee's own.
    fn call_in_state(&self, runtime: &Runtime, name: &str, args: &[Data]) -> ApiResult<Result<Vec<Data>, LuaError>> {
        let level = Level::enter_from_script(&self.scripts, &runtime.env);
        if level.too_deep {
            return Err(ApiError::TooDeep(MAX_DEPTH));
        }
        let stack = runtime.stack();
        let base = stack.top();
        let outcome = push_callee(stack, name, args).map(|count| collect(stack, base, count));
        stack.set_top(base.min(stack.top()));
        outcome
    }

    /// Runs a string in a script: as an expression if it is one, else as a chunk. The script is not marked when it fails.
    pub(crate) fn execute_string(self: &Rc<Self>, script: &Rc<Script>, code: &[u8]) -> ApiResult<Vec<Data>> {
        let runtime = script.current_runtime().ok_or(ApiError::Scene(crate::scene::SceneError::OperationFailed))?;
        let level = Level::enter_from_script(&self.scripts, &runtime.env);
        if level.too_deep {
            return Err(ApiError::TooDeep(MAX_DEPTH));
        }
        let stack = runtime.stack();
        let base = stack.top();
        let outcome = load_expression_or_chunk(stack, code).and_then(|()| collect(stack, base, 0));
        stack.set_top(base.min(stack.top()));
        outcome.map_err(|_| crate::scene::SceneError::OperationFailed.into())
    }

    /// Runs a file's text as a chunk in a script that lives already, as the sandbox does.
    ///
    /// # Errors
    /// The text of the error, which has been logged.
    pub(crate) fn run_in(self: &Rc<Self>, script: &Rc<Script>, code: &[u8], chunk_name: &str) -> Result<(), String> {
        let Some(runtime) = script.current_runtime() else { return Err(ApiError::ScriptNotInitialized.to_string()) };
        let outcome = {
            let _level = Level::enter(&self.scripts, &runtime.env);
            let stack = runtime.stack();
            stack.load(code, chunk_name, false).and_then(|()| stack.protected_call(0, 0))
        };
        outcome.map_err(|error| {
            self.fail(script, &error.text);
            self.complete_call(script, SysCall::Ext, None);
            error.text
        })
    }

    /// Resets a script and initialises it at once where 4.10 does.
    pub(crate) fn init_script(self: &Rc<Self>, script: &Rc<Script>) {
        if script.depth() > 0 {
            // Its interpreter is in use: it starts anew when it is called next.
            return;
        }
        self.reset(script);
        if !matches!(script.script_type, ScriptType::AddOn | ScriptType::Main) {
            self.deliver(script, SysCall::Init, &[]);
        }
    }

    /// Starts sandbox and add-ons.
    pub(crate) fn start_detached(self: &Rc<Self>, script: &Rc<Script>) {
        if script.script_type == ScriptType::AddOn && !self.add_on_starts_itself(script) {
            return;
        }
        self.deliver(script, SysCall::Init, &[]);
    }

    /// Whether an add-on starts without being asked to; its menu entry becomes its name.
    fn add_on_starts_itself(self: &Rc<Self>, script: &Rc<Script>) -> bool {
        let Some(info) = self.add_on_info(script) else { return true };
        if let Some(Data::Text(menu)) = info.field("menu") {
            let menu = String::from_utf8_lossy(menu).replace('\n', " >> ");
            script.detached.borrow_mut().name = format!("{menu}@addOnScript");
        }
        info.field("autoStart").is_none_or(Data::truthy)
    }

    /// The value of an add-on's `sysCall_info`, for which it is loaded once more.
    fn add_on_info(self: &Rc<Self>, script: &Rc<Script>) -> Option<Data> {
        let runtime = Rc::new(Runtime::new(self, script));
        let stack = runtime.stack();
        let (code, name) = {
            let detached = script.detached.borrow();
            (detached.code.clone(), detached.chunk_name.clone())
        };
        let _level = Level::enter(&self.scripts, &runtime.env);
        let loaded = startup::fill(self, &runtime)
            .and_then(|()| stack.load(&code, &name, false))
            .and_then(|()| stack.protected_call(0, 0));
        // What is wrong with it is reported when it is loaded to run.
        if loaded.is_err() || stack.push_global(SysCall::Info.name()) != Type::Function {
            return None;
        }
        let base = stack.top() - 1;
        collect(stack, base, 0).ok()?.pop()
    }

    /// Closes every interpreter. A script and its interpreter know each other: without this neither would ever go.
    pub(crate) fn close_all(&self) {
        self.scripts.all().iter().for_each(|script| drop(script.runtime.take()));
    }

    /// Ends an add-on or the sandbox at application exit.
    pub(crate) fn end_detached(self: &Rc<Self>) {
        for script in self.active_scripts().iter() {
            if matches!(script.script_type, ScriptType::AddOn | ScriptType::Sandbox)
                && script.base_state() == state::INITIALIZED
            {
                self.end(script);
            }
        }
    }
}

/// Pushes the function and its arguments; the script's `sysCall_ext`, if there is one, stands in for every function.
pub(crate) fn push_callee(stack: Stack<'_>, name: &str, args: &[Data]) -> ApiResult<i32> {
    let mut extra = 0;
    if stack.push_global(SysCall::Ext.name()) == Type::Function {
        stack.push_bytes(name.as_bytes());
        extra = 1;
    } else {
        stack.pop(1);
        push_dotted(stack, name);
        if stack.kind(-1) != Type::Function {
            stack.pop(1);
            return Err(ApiError::CallFailed);
        }
    }
    Ok(push_args(stack, args)? + extra)
}

/// Calls what is on the stack and reads its results.
pub(crate) fn collect(stack: Stack<'_>, base: i32, arguments: i32) -> Result<Vec<Data>, LuaError> {
    stack.protected_call(arguments, MULTIPLE)?;
    Ok((base + 1..=stack.top()).map(|index| data::read_data(stack, index)).collect())
}

fn load_expression_or_chunk(stack: Stack<'_>, code: &[u8]) -> Result<(), LuaError> {
    let name = String::from_utf8_lossy(code);
    let expression = [b"return ", code].concat();
    stack.load(&expression, &name, false).or_else(|_| stack.load(code, &name, false))
}
