//! The life of a script: loading, initialization, callbacks, cleanup (spec: scripts 3, scripts 4, scripts 5).

pub(in crate::script) mod attached;
pub(in crate::script) mod embedded;
pub(in crate::script) mod env;
pub(in crate::script) mod instance;
pub(in crate::script) mod level;
pub(in crate::script) mod lookup;
pub(in crate::script) mod old_calls;
pub(in crate::script) mod order;
pub(in crate::script) mod random;
pub(in crate::script) mod removal;
pub(in crate::script) mod script_set;
pub(in crate::script) mod shared_process;
pub(in crate::script) mod source;
pub(in crate::script) mod startup;
pub(in crate::script) mod user_modules;

use std::rc::Rc;

use super::binding::data;
use super::calls::callback::SysCall;
use super::error::ApiError;
use super::log::verbosity;
use super::lua::{LuaError, MULTIPLE, Stack, Type};
use super::sim::Sim;
use crate::scene::Data;
use crate::scene::object::script_object::ScriptType;
use env::{Hook, Runtime};
use instance::{Script, state};
use level::Level;
use script_set::MAX_DEPTH;

/// The result of a callback.
#[derive(Debug, Default)]
pub(crate) struct Reply {
    /// The script's function or a hook was there and ran.
    pub ran: bool,
    /// The last value returned; None when nothing was.
    pub value: Option<Data>,
}

impl Sim {
    /// Delivers a callback to one script, loading and initialising it first where the callback does that.
    pub(crate) fn deliver(self: &Rc<Self>, script: &Rc<Script>, call: SysCall, args: &[Data]) -> Reply {
        if script.removed.get() || (call != SysCall::Cleanup && script.is_disabled(&self.scene.borrow())) {
            return Reply::default();
        }
        if script.state() == state::UNLOADED {
            if !call.wakes() || script.is_disabled(&self.scene.borrow()) {
                return Reply::default();
            }
            self.load(script);
        }
        if script.state() == state::UNINITIALIZED && call != SysCall::Info {
            self.initialize(script);
            if call == SysCall::Init {
                return Reply { ran: true, value: None };
            }
        }
        if !script.is_running() {
            return Reply::default();
        }
        self.run_callback(script, call, args)
    }

    /// Runs the chunk in a fresh interpreter, then `sysCall_info`.
    fn load(self: &Rc<Self>, script: &Rc<Script>) {
        let runtime = Rc::new(Runtime::new(self, script));
        script.set_state(state::UNINITIALIZED);
        script.runtime.replace(Some(runtime.clone()));
        if let Err(error) = self.run_chunk(script, &runtime) {
            self.report_error(script, &error.text);
            script.set_state(state::ENDED | state::ERROR);
            self.close(script);
            self.restart_if_requested(script);
            return;
        }
        let defined = defined_callbacks(runtime.stack());
        runtime.env.defined.set(defined);
        self.note_callbacks(defined);
        // Add-ons have been asked before they were started.
        if script.script_type != ScriptType::AddOn {
            self.run_callback(script, SysCall::Info, &[]);
        }
    }

    fn run_chunk(self: &Rc<Self>, script: &Rc<Script>, runtime: &Rc<Runtime>) -> Result<(), LuaError> {
        let stack = runtime.stack();
        startup::fill(self, runtime)?;
        if script.language(&self.scene.borrow()) == "python" {
            return Err(LuaError { text: "scripts in Python are not implemented in Swanilda.".into() });
        }
        let (code, name) = script.code(&self.scene.borrow());
        let level = Level::enter(&self.scripts, &runtime.env);
        if level.too_deep {
            return Err(LuaError { text: ApiError::TooDeep(MAX_DEPTH).to_string() });
        }
        stack.load(&code, &name, false)?;
        self.begin_coverage(script, runtime, &name, &code);
        if old_calls::are_expected_by(&code) { old_calls::begin(stack, self) } else { stack.protected_call(0, 0) }
    }

    fn initialize(self: &Rc<Self>, script: &Rc<Script>) {
        script.set_state(state::INITIALIZED);
        self.run_callback(script, SysCall::Init, &[]);
        // As in the original, a script is notified of the selection once it is initialized.
        if script.is_running() {
            self.run_callback(script, SysCall::SelChange, &[self.selection_data()]);
        }
    }

    /// Runs hooks and function of a callback in an interpreter that is ready for it.
    fn run_callback(self: &Rc<Self>, script: &Rc<Script>, call: SysCall, args: &[Data]) -> Reply {
        let Some(runtime) = script.current_runtime() else { return Reply::default() };
        if !runtime.env.responds_to(call) && !call.always_delivered() && !has_late_cleanup(&runtime, call) {
            return Reply::default();
        }
        if call == SysCall::Cleanup {
            script.set_base_state(state::ENDED);
        }
        let outcome = self.call_with_hooks(&runtime, call, args);
        if !outcome.errors.is_empty() {
            self.fail(script, &outcome.errors.join("\n\n"));
        } else if call.is_announced() && outcome.function_ran {
            self.broadcast_system_call(script, call);
        }
        if runtime.env.depth.get() == 0 {
            self.complete_call(script, call, outcome.value.as_ref());
        }
        Reply { ran: outcome.ran, value: outcome.value }
    }

    fn call_with_hooks(self: &Rc<Self>, runtime: &Rc<Runtime>, call: SysCall, args: &[Data]) -> Outcome {
        let env = &runtime.env;
        let stack = runtime.stack();
        let level = Level::enter(&self.scripts, env);
        let mut outcome = Outcome::default();
        if level.too_deep {
            outcome.errors.push(ApiError::TooDeep(MAX_DEPTH).to_string());
            return outcome;
        }
        let before = hooks_of(&env.hooks.borrow().before, call);
        for hook in before.into_iter().rev() {
            outcome.run_hook(stack, &hook, args);
        }
        if stack.push_global(call.name()) == Type::Function {
            outcome.run_function(stack, args);
        } else {
            stack.pop(1);
        }
        let after = hooks_of(&env.hooks.borrow().after, call);
        for hook in after {
            outcome.run_hook(stack, &hook, args);
        }
        outcome
    }

    /// Logs an error of a script and marks it; it ends when its last call has returned.
    pub(crate) fn fail(self: &Rc<Self>, script: &Rc<Script>, text: &str) {
        let from_yield = text.contains("attempt to yield across a C-call boundary")
            || text.contains("attempt to yield from outside a coroutine");
        // An error does not end the sandbox.
        if script.script_type != ScriptType::Sandbox {
            script.mark_error();
        }
        if !from_yield {
            self.report_error(script, text);
        }
    }

    fn report_error(self: &Rc<Self>, script: &Rc<Script>, text: &str) {
        self.log.count_error();
        self.log_from(script, verbosity::SCRIPT_ERRORS, text);
        if !matches!(script.script_type, ScriptType::AddOn | ScriptType::Sandbox) {
            self.request_pause_after_error();
        }
    }

    /// Completes the outermost call of a script: ends it after an error, or does what it requested by `cmd`.
    pub(crate) fn complete_call(self: &Rc<Self>, script: &Rc<Script>, call: SysCall, value: Option<&Data>) {
        if script.state() & state::ERROR != 0 {
            return self.end_failed(script);
        }
        if call == SysCall::Info || script.base_state() != state::INITIALIZED {
            return;
        }
        match value.and_then(|v| v.field("cmd")) {
            Some(Data::Text(cmd)) if cmd == b"restart" => self.reset(script),
            Some(Data::Text(cmd)) if cmd == b"cleanup" => self.end(script),
            _ if script.script_type == ScriptType::AddOn && value == Some(&Data::Int(1)) => self.end(script),
            _ => {}
        }
    }

    /// Ends a script that has failed: cleanup if it was initialized, then no interpreter.
    fn end_failed(self: &Rc<Self>, script: &Rc<Script>) {
        if script.base_state() == state::INITIALIZED {
            self.clean_up(script);
        }
        script.set_base_state(state::ENDED);
        self.close(script);
        self.restart_if_requested(script);
    }

    /// Ends a script for good: cleanup, then no interpreter.
    pub(crate) fn end(self: &Rc<Self>, script: &Rc<Script>) {
        if script.base_state() == state::INITIALIZED {
            self.clean_up(script);
        }
        script.set_base_state(state::ENDED);
        self.close(script);
    }

    /// Ends a script as a crash would: it is not asked to clean up.
    pub(crate) fn abort(&self, script: &Script) {
        script.set_base_state(state::ENDED);
        self.close(script);
    }

    /// Resets a script; it starts again at its next eligible call.
    pub(crate) fn reset(self: &Rc<Self>, script: &Rc<Script>) {
        self.end(script);
        script.set_state(state::UNLOADED);
    }

    /// Runs `sysCall_cleanup` in a script that is ending. Errors are logged and have no other effect.
    fn clean_up(self: &Rc<Self>, script: &Rc<Script>) {
        let Some(runtime) = script.current_runtime() else { return };
        script.set_base_state(state::ENDED);
        if !runtime.env.responds_to(SysCall::Cleanup) && !has_late_cleanup(&runtime, SysCall::Cleanup) {
            return;
        }
        let outcome = self.call_with_hooks(&runtime, SysCall::Cleanup, &[]);
        if !outcome.errors.is_empty() {
            script.mark_error();
            self.report_error(script, &outcome.errors.join("\n\n"));
        } else if outcome.function_ran {
            self.broadcast_system_call(script, SysCall::Cleanup);
        }
    }

    /// Releases the interpreter, which is closed when its last call has returned, and what goes with it: signals and tubes.
    fn close(&self, script: &Script) {
        script.runtime.replace(None);
        self.drop_signals_of(script);
        self.channels.end_script(script.id);
    }

    /// `restartOnError` is a one-shot.
    fn restart_if_requested(&self, script: &Script) {
        let asked = match script.object {
            Some(handle) => self.clear_restart_flag(handle),
            None => std::mem::take(&mut script.detached.borrow_mut().restart_on_error),
        };
        if asked {
            script.set_state(state::UNLOADED);
        }
    }

    fn clear_restart_flag(&self, handle: crate::scene::Handle) -> bool {
        let mut scene = self.scene.borrow_mut();
        let Ok(true) = scene.object(handle).and_then(|o| o.script()).map(|s| s.restart_on_error) else { return false };
        let cleared = scene
            .try_modify(handle, crate::scene::Field::Other, |o| o.script_mut().map(|s| s.restart_on_error = false));
        cleared.is_ok()
    }
}

/// What hooks and function of one callback did.
#[derive(Default)]
struct Outcome {
    ran: bool,
    function_ran: bool,
    value: Option<Data>,
    errors: Vec<String>,
}

impl Outcome {
    fn run_hook(&mut self, stack: Stack<'_>, hook: &Hook, args: &[Data]) {
        let base = stack.top();
        push_hook(stack, hook);
        if stack.kind(-1) == Type::Function {
            self.ran = true;
            if let Err(error) = push_args(stack, args).and_then(|n| stack.protected_call(n, 0)) {
                self.errors.push(error.text);
            }
        }
        stack.set_top(base.min(stack.top()));
    }

    /// Calls the function on top of the stack.
    fn run_function(&mut self, stack: Stack<'_>, args: &[Data]) {
        let base = stack.top() - 1;
        (self.ran, self.function_ran) = (true, true);
        match push_args(stack, args).and_then(|n| stack.protected_call(n, MULTIPLE)) {
            Ok(()) if stack.top() > base => self.value = Some(data::read_data(stack, -1)),
            Ok(()) => {}
            Err(error) => {
                self.function_ran = false;
                self.errors.push(error.text);
            }
        }
        stack.set_top(base.min(stack.top()));
    }
}

/// Pushes arguments for a call; returns their number.
pub(crate) fn push_args(stack: Stack<'_>, args: &[Data]) -> Result<i32, LuaError> {
    if !stack.reserve(args.len() + 8) {
        return Err(LuaError { text: "stack overflow: too many arguments.".into() });
    }
    args.iter().for_each(|arg| data::push_data(stack, arg));
    Ok(args.len() as i32)
}

fn push_hook(stack: Stack<'_>, hook: &Hook) {
    match hook.function {
        Some(function) => {
            stack.push_function(function);
        }
        None => push_dotted(stack, &hook.name),
    }
}

/// Pushes the global `a.b.c`, walking through plain tables; nil when it is not there.
pub(crate) fn push_dotted(stack: Stack<'_>, name: &str) {
    stack.push_globals();
    for part in name.split('.') {
        if stack.kind(-1) != Type::Table {
            stack.pop(1);
            return stack.push_nil();
        }
        stack.raw_get_field(-1, part);
        stack.remove(-2);
    }
}

fn hooks_of(hooks: &std::collections::BTreeMap<SysCall, Vec<Hook>>, call: SysCall) -> Vec<Hook> {
    hooks.get(&call).cloned().unwrap_or_default()
}

/// The callbacks that are there now that the chunk has run, as bits.
fn defined_callbacks(stack: Stack<'_>) -> u64 {
    let defined = SysCall::ALL.iter().filter(|call| {
        let kind = stack.push_global(call.name());
        stack.pop(1);
        kind == Type::Function
    });
    defined.fold(0, |bits, call| bits | call.bit())
}

/// Whether a cleanup was defined after the chunk had run.
fn has_late_cleanup(runtime: &Runtime, call: SysCall) -> bool {
    if call != SysCall::Cleanup {
        return false;
    }
    let stack = runtime.stack();
    let kind = stack.push_global(call.name());
    stack.pop(1);
    kind == Type::Function
}
