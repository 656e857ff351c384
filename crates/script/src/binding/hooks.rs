//! Hooks of modules: functions that run at fixed moments, so that a module owns all of its state.

use std::any::Any;

/// A function of a module that runs outside of calls.
pub type ModuleHook = fn(&Host<'_>);

/// When a module acts without being called.
#[derive(Debug, Clone, Copy, Default)]
pub struct Hooks {
    /// At the start of each loop iteration, before any script runs.
    pub start_of_iteration: Option<ModuleHook>,
    /// Before each simulation step that is due; true holds it back. It is asked again in the next iteration.
    pub before_step: Option<fn(&Host<'_>) -> bool>,
    /// Before the physics moves the scene.
    pub before_dynamics: Option<ModuleHook>,
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
        before_dynamics: None,
        after_step: None,
        end_of_simulation: None,
    };
}

/// The parts of the simulator that a hook may access. This room knows no simulator: what a hook may do with it is in `cx`.
pub struct Host<'a>(pub(crate) &'a dyn Any);
