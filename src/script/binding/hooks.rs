//! Hooks of modules: functions that run at fixed moments, so that a module owns all of its state.

use std::rc::Rc;

use crate::io::EventLoop;
use crate::scene::Data;
use crate::script::calls::handler::Handler;
use crate::script::lifecycle::instance::Script;
use crate::script::sim::Sim;

/// A function of a module that runs outside of calls.
pub type ModuleHook = fn(&Host<'_>);

/// When a module acts without being called.
#[derive(Debug, Clone, Copy, Default)]
pub struct Hooks {
    /// At the start of each loop iteration, before any script runs.
    pub start_of_iteration: Option<ModuleHook>,
    /// At the end of a simulation, after `sysCall_afterSimulation`.
    pub end_of_simulation: Option<ModuleHook>,
}

impl Hooks {
    pub const NONE: Self = Self { start_of_iteration: None, end_of_simulation: None };
}

/// The parts of the simulator that a hook may access.
pub struct Host<'a> {
    sim: &'a Rc<Sim>,
}

impl Host<'_> {
    /// The state of a module, if a call has created it.
    pub(crate) fn module_state<T: 'static>(&self) -> Option<Rc<T>> {
        self.sim.modules.states.existing()
    }

    /// The event loop of this simulator's sockets.
    ///
    /// # Errors
    /// When the system cannot create one.
    pub(crate) fn event_loop(&self) -> std::io::Result<Rc<EventLoop>> {
        self.sim.event_loop.get()
    }

    /// Calls a handler of a script; None if it fails, which is logged.
    pub(crate) fn call_handler(&self, script: &Rc<Script>, handler: &Handler, args: &[Data]) -> Option<Vec<Data>> {
        self.sim.call_handler(script, handler, args)
    }

    /// The value of a named parameter of the application.
    pub(crate) fn named_param(&self, name: &str) -> Option<Vec<u8>> {
        self.sim.app.borrow().named_params.get(name).cloned()
    }

    pub(crate) fn log(&self, level: i64, text: &str) {
        self.sim.log(level, text);
    }
}

impl Sim {
    /// Runs the hooks of one moment, module by module in the order of the registry.
    pub(in crate::script) fn run_hooks(self: &Rc<Self>, moment: impl Fn(&Hooks) -> Option<ModuleHook>) {
        let host = Host { sim: self };
        self.modules.registry.hooks.iter().filter_map(moment).for_each(|hook| hook(&host));
    }
}
