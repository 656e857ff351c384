//! The life of a script: loading, initialization, callbacks, cleanup (spec: scripts 3, scripts 4, scripts 5).

mod broadcast;
mod removal;
mod selection;

use std::rc::Rc;

use crate::error::ApiError;
use crate::host::{
    CallbackResult, Env, Hook, Level, MAX_DEPTH, Runtime, Script, ScriptError, Sim, SourceText,
    state,
};
use crate::sys_call::SysCall;
use scene::Data;
use scene::object::script_object::ScriptType;

pub(crate) use selection::selection_data;

/// The result of a callback.
#[derive(Debug, Default)]
pub struct Reply {
    /// The script's function or a hook was there and ran.
    pub ran: bool,
    /// The last value returned; None when nothing was.
    pub value: Option<Data>,
}

impl Sim {
    /// Delivers a callback to one script, loading and initialising it first where the callback does that.
    pub fn deliver(self: &Rc<Self>, script: &Rc<Script>, call: SysCall, args: &[Data]) -> Reply {
        if script.removed.get() || (call != SysCall::Cleanup && self.is_disabled(script)) {
            return Reply::default();
        }
        if script.state() == state::UNLOADED {
            if !call.wakes() || self.is_disabled(script) {
                return Reply::default();
            }
            self.load(script);
        }
        if script.state() == state::UNINITIALIZED && call != SysCall::Info {
            self.initialize(script);
            if call == SysCall::Init {
                return Reply {
                    ran: true,
                    value: None,
                };
            }
        }
        if !script.is_running() {
            return Reply::default();
        }
        match script.idle.get().would_run(call) {
            Some(ran) if args.is_empty() => Reply { ran, value: None },
            _ => self.run_callback(script, call, args),
        }
    }

    /// Whether a script is not to be called. The scene is only looked into after a change that can concern it.
    pub(crate) fn is_disabled(&self, script: &Script) -> bool {
        let scene = self.scene.borrow();
        if script.object.is_none() {
            return script.is_disabled(&scene);
        }
        let edition = self.scripts.edition(&scene);
        match script.disabled.get() {
            (known, disabled) if known == edition => disabled,
            _ => {
                let disabled = script.is_disabled(&scene);
                script.disabled.set((edition, disabled));
                disabled
            }
        }
    }

    /// Runs the text in a fresh interpreter, then `sysCall_info`.
    fn load(self: &Rc<Self>, script: &Rc<Script>) {
        script.set_state(state::UNINITIALIZED);
        let runtime = match self.run_text(script) {
            Ok(runtime) => runtime,
            Err(error) => {
                self.report_error(script, &error.text);
                script.set_state(state::ENDED | state::ERROR);
                self.close(script);
                return self.restart_if_requested(script);
            }
        };
        let defined = defined_callbacks(&runtime);
        runtime.env.defined.set(defined);
        self.note_callbacks(defined);
        // Add-ons were checked before they were started.
        if script.script_type != ScriptType::AddOn {
            self.run_callback(script, SysCall::Info, &[]);
        }
    }

    /// A new interpreter for a script.
    ///
    /// # Errors
    /// When there is no such language.
    pub fn create_runtime(
        self: &Rc<Self>,
        script: &Rc<Script>,
        language: &str,
    ) -> Result<Rc<Runtime>, ScriptError> {
        self.scripts
            .languages
            .create(language, Rc::new(Env::new(self, script)))
    }

    fn run_text(self: &Rc<Self>, script: &Rc<Script>) -> Result<Rc<Runtime>, ScriptError> {
        let language = script.language(&self.scene.borrow());
        let runtime = self.create_runtime(script, &language)?;
        script.runtime.replace(Some(runtime.clone()));
        runtime.interpreter.start()?;
        let (text, chunk_name) = script.code(&self.scene.borrow());
        if let Some(file) = &*script.file.borrow() {
            self.log.files.borrow_mut().insert(&chunk_name, file);
        }
        let level = Level::enter(&self.scripts, &runtime.env);
        if level.too_deep {
            return Err(ScriptError::new(ApiError::TooDeep(MAX_DEPTH).to_string()));
        }
        let counted_as = self.counted_as(script, &text);
        runtime.interpreter.load(&SourceText {
            text: &text,
            chunk_name: &chunk_name,
            counted_as,
        })?;
        drop(level);
        Ok(runtime)
    }

    fn initialize(self: &Rc<Self>, script: &Rc<Script>) {
        script.set_state(state::INITIALIZED);
        self.run_callback(script, SysCall::Init, &[]);
        // As in the original, a script is notified of the selection once it is initialized.
        if script.is_running() {
            let selection = selection_data(&self.scene.borrow());
            self.run_callback(script, SysCall::SelChange, &[selection]);
        }
    }

    /// Runs hooks and function of a callback in an interpreter that is ready for it.
    fn run_callback(self: &Rc<Self>, script: &Rc<Script>, call: SysCall, args: &[Data]) -> Reply {
        let Some(runtime) = script.current_runtime() else {
            return Reply::default();
        };
        if !runtime.env.responds_to(call)
            && !call.resumes_threads()
            && !has_late_cleanup(&runtime, call)
        {
            // Code of the script that runs now could give it a hook.
            if call != SysCall::Cleanup && runtime.env.depth.get() == 0 {
                script.idle.set(script.idle.get().with(call, false));
            }
            return Reply::default();
        }
        if call == SysCall::Cleanup {
            script.set_base_state(state::ENDED);
        }
        let idle = script.idle.get();
        let outcome = self.call_with_hooks(&runtime, call, args);
        if call.may_be_idle() && outcome.did_nothing(&runtime, call) {
            script.idle.set(idle.with(call, outcome.function_ran));
        }
        if let Some(error) = ScriptError::joined(&outcome.errors) {
            self.fail(script, &error);
        } else if call.is_announced() && outcome.function_ran {
            self.broadcast_system_call(script, call);
        }
        if runtime.env.depth.get() == 0 {
            self.complete_call(script, call, outcome.value.as_ref());
        }
        Reply {
            ran: outcome.ran,
            value: outcome.value,
        }
    }

    fn call_with_hooks(
        self: &Rc<Self>,
        runtime: &Rc<Runtime>,
        call: SysCall,
        args: &[Data],
    ) -> Outcome {
        let env = &runtime.env;
        let level = Level::enter(&self.scripts, env);
        let mut outcome = Outcome::default();
        if level.too_deep {
            outcome
                .errors
                .push(ScriptError::new(ApiError::TooDeep(MAX_DEPTH).to_string()));
            return outcome;
        }
        if call.resumes_threads() {
            outcome.resume_thread(runtime);
        }
        let before = env.hooks_of(call, true);
        for hook in before.iter().flat_map(|hooks| hooks.iter().rev()) {
            outcome.call_hook(runtime, hook, args);
        }
        outcome.call_function(runtime, call, args);
        let after = env.hooks_of(call, false);
        for hook in after.iter().flat_map(|hooks| hooks.iter()) {
            outcome.call_hook(runtime, hook, args);
        }
        outcome
    }

    /// Logs an error of a script and marks it; it ends when its last call has returned.
    pub(crate) fn fail(self: &Rc<Self>, script: &Rc<Script>, error: &ScriptError) {
        // An error does not end the sandbox.
        if script.script_type != ScriptType::Sandbox {
            script.mark_error();
        }
        if !error.is_silent {
            self.report_error(script, &error.text);
        }
    }

    fn report_error(self: &Rc<Self>, script: &Rc<Script>, text: &str) {
        self.log.count_error();
        self.log_error(script, text);
        if !matches!(script.script_type, ScriptType::AddOn | ScriptType::Sandbox) {
            self.request_pause_after_error();
        }
    }

    /// Completes the outermost call of a script: ends it after an error, or does what it requested by `cmd`.
    pub(crate) fn complete_call(
        self: &Rc<Self>,
        script: &Rc<Script>,
        call: SysCall,
        value: Option<&Data>,
    ) {
        if script.state() & state::ERROR != 0 {
            return self.end_failed(script);
        }
        if call == SysCall::Info || script.base_state() != state::INITIALIZED {
            return;
        }
        match value.and_then(|v| v.field("cmd")) {
            Some(Data::Text(cmd)) if cmd == b"restart" => self.reset(script),
            Some(Data::Text(cmd)) if cmd == b"cleanup" => self.end(script),
            _ if script.script_type == ScriptType::AddOn && value == Some(&Data::Int(1)) => {
                self.end(script);
            }
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

    /// Ends a script as a crash would: without its cleanup callback.
    pub(crate) fn abort(self: &Rc<Self>, script: &Script) {
        script.set_base_state(state::ENDED);
        self.close(script);
    }

    /// Resets a script; it starts again at its next eligible call.
    pub fn reset(self: &Rc<Self>, script: &Rc<Script>) {
        self.end(script);
        script.set_state(state::UNLOADED);
    }

    /// Runs `sysCall_cleanup` in a script that is ending. Errors are logged and have no other effect.
    fn clean_up(self: &Rc<Self>, script: &Rc<Script>) {
        let Some(runtime) = script.current_runtime() else {
            return;
        };
        script.set_base_state(state::ENDED);
        if !runtime.env.responds_to(SysCall::Cleanup)
            && !has_late_cleanup(&runtime, SysCall::Cleanup)
        {
            return;
        }
        let outcome = self.call_with_hooks(&runtime, SysCall::Cleanup, &[]);
        if let Some(error) = ScriptError::joined(&outcome.errors) {
            script.mark_error();
            self.report_error(script, &error.text);
        } else if outcome.function_ran {
            self.broadcast_system_call(script, SysCall::Cleanup);
        }
    }

    /// Releases the interpreter, which is closed when its last call has returned, and what belongs to the script: signals, collections,
    /// drawing objects.
    fn close(self: &Rc<Self>, script: &Script) {
        self.scripts.announce_end(self, script);
        script.runtime.replace(None);
        self.drop_signals_of(script);
        self.scene.borrow_mut().forget_owner(script.id);
    }

    fn request_pause_after_error(&self) {
        if self
            .scene
            .try_borrow()
            .is_ok_and(|scene| scene.settings().pause_at_error)
        {
            self.clock.request_pause();
        }
    }

    /// `restartOnError` is a one-shot.
    fn restart_if_requested(&self, script: &Script) {
        let requested = match script.object {
            Some(handle) => self.scene.borrow_mut().take_restart_request(handle),
            None => std::mem::take(&mut script.detached.borrow_mut().restart_on_error),
        };
        if requested {
            script.set_state(state::UNLOADED);
        }
    }
}

/// The outcome of the hooks and the function of one callback.
#[derive(Default)]
struct Outcome {
    ran: bool,
    function_ran: bool,
    value: Option<Data>,
    errors: Vec<ScriptError>,
}

impl Outcome {
    /// Whether the callback does nothing, this time and until code of the script runs again.
    fn did_nothing(&self, runtime: &Runtime, call: SysCall) -> bool {
        self.ran == self.function_ran
            && self.value.is_none()
            && self.errors.is_empty()
            && runtime.env.depth.get() == 0
            && !runtime.env.has_hooks(call)
            && runtime.interpreter.is_idle(call, self.function_ran)
    }

    fn resume_thread(&mut self, runtime: &Runtime) {
        if let Err(error) = runtime.interpreter.resume_thread() {
            self.errors.push(error);
        }
    }

    fn call_hook(&mut self, runtime: &Runtime, hook: &Hook, args: &[Data]) {
        match runtime.interpreter.call_hook(hook, args) {
            Ok(ran) => self.ran |= ran,
            Err(error) => {
                self.ran = true;
                self.errors.push(error);
            }
        }
    }

    fn call_function(&mut self, runtime: &Runtime, call: SysCall, args: &[Data]) {
        match runtime.interpreter.call_callback(call, args) {
            Ok(CallbackResult::NotDefined) => {}
            Ok(CallbackResult::Returned(value)) => {
                (self.ran, self.function_ran, self.value) = (true, true, value);
            }
            Err(error) => {
                self.ran = true;
                self.errors.push(error);
            }
        }
    }
}

/// The callbacks that are there now that the text has run, as bits.
fn defined_callbacks(runtime: &Runtime) -> u64 {
    let defined = SysCall::ALL
        .iter()
        .filter(|&&call| runtime.interpreter.defines(call));
    defined.fold(0, |bits, call| bits | call.bit())
}

/// Whether a cleanup was defined after the text had run.
fn has_late_cleanup(runtime: &Runtime, call: SysCall) -> bool {
    call == SysCall::Cleanup && runtime.interpreter.defines(call)
}
