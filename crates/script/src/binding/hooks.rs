//! Hooks of modules: functions that run at fixed moments, so that a module owns all of its state.

use std::cell::Ref;
use std::rc::Rc;

use crate::calls::handler::Handler;
use crate::error::{ApiError, ApiResult};
use crate::lifecycle::instance::Script;
use crate::sim::{Options, Sim};
use crate::step::clock::Clock;
use io::EventLoop;
use scene::object::script_object::ScriptType;
use scene::{Data, Scene};

/// A function of a module that runs outside of calls.
pub type ModuleHook = fn(&Host<'_>);

/// When a module acts without being called.
#[derive(Debug, Clone, Copy, Default)]
pub struct Hooks {
    /// At the start of each loop iteration, before any script runs.
    pub start_of_iteration: Option<ModuleHook>,
    /// Before each simulation step that is due; true holds it back. It is asked again in the next iteration.
    pub before_step: Option<fn(&Host<'_>) -> bool>,
    /// After each simulation step, before time goes on.
    pub after_step: Option<ModuleHook>,
    /// At the end of a simulation, after `sysCall_afterSimulation`.
    pub end_of_simulation: Option<ModuleHook>,
}

impl Hooks {
    /// No hooks.
    pub const NONE: Self = Self {
        start_of_iteration: None,
        before_step: None,
        after_step: None,
        end_of_simulation: None,
    };
}

/// The parts of the simulator that a hook may access.
pub struct Host<'a> {
    sim: &'a Rc<Sim>,
}

impl Host<'_> {
    /// The state of a module, if a call has created it.
    pub fn module_state<T: 'static>(&self) -> Option<Rc<T>> {
        self.sim.modules.states.existing()
    }

    /// The event loop of this simulator's sockets.
    ///
    /// # Errors
    /// When the system cannot create one.
    pub fn event_loop(&self) -> std::io::Result<Rc<EventLoop>> {
        self.sim.event_loop.get()
    }

    /// Calls a handler of a script; None if it fails, which is logged.
    pub fn call_handler(
        &self,
        script: &Rc<Script>,
        handler: &Handler,
        args: &[Data],
    ) -> Option<Vec<Data>> {
        self.sim.call_handler(script, handler, args)
    }

    /// The value of a named parameter of the application.
    pub fn named_param(&self, name: &str) -> Option<Vec<u8>> {
        self.sim.app.borrow().named_params.get(name).cloned()
    }

    /// Logs a line in the name of the simulator; `level` is one of `sim.verbosity_*`.
    pub fn log(&self, level: i64, text: &str) {
        self.sim.log(level, text);
    }

    /// The options of the simulator.
    pub fn options(&self) -> &Options {
        &self.sim.options
    }

    /// State and time of the simulation.
    pub fn clock(&self) -> &Clock {
        &self.sim.clock
    }

    /// The scene, to read. The borrow must end before scripts are called.
    pub fn scene(&self) -> Ref<'_, Scene> {
        self.sim.scene.borrow()
    }

    /// Distinguishes this scene from others.
    pub fn scene_uid(&self) -> i64 {
        self.sim.scene_uid()
    }

    /// Calls `module.function` in the name of the sandbox, with plain values.
    ///
    /// # Errors
    /// Those of the function.
    pub fn call_api(&self, name: &str, args: &[Data]) -> ApiResult<Vec<Data>> {
        let sandbox = self
            .sim
            .scripts
            .detached(ScriptType::Sandbox)
            .ok_or(ApiError::NoSuchScript)?;
        self.sim.call_api(&sandbox, name, args)
    }

    /// Calls a global function of a script.
    ///
    /// # Errors
    /// When there is no such script or function, or the function fails.
    pub fn call_function(&self, script: i64, name: &str, args: &[Data]) -> ApiResult<Vec<Data>> {
        let script = self.sim.script(script).ok_or(ApiError::NoSuchScript)?;
        self.sim.call_function(&script, name, args)
    }
}

impl Sim {
    /// Runs the hooks of one moment, module by module in the order of the registry.
    pub(crate) fn run_hooks(self: &Rc<Self>, moment: impl Fn(&Hooks) -> Option<ModuleHook>) {
        let host = Host { sim: self };
        self.modules
            .registry
            .hooks
            .iter()
            .filter_map(moment)
            .for_each(|hook| hook(&host));
    }

    /// Whether a module holds the step back that is due. All are asked: each does what it has to do before a step.
    pub(crate) fn step_is_held(self: &Rc<Self>) -> bool {
        let host = Host { sim: self };
        let mut held = false;
        for hook in self
            .modules
            .registry
            .hooks
            .iter()
            .filter_map(|hooks| hooks.before_step)
        {
            held |= hook(&host);
        }
        held
    }
}
