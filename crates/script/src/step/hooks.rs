//! The hooks of modules, at their moments.

use std::rc::Rc;

use crate::binding::hooks::{Hooks, Host, ModuleHook};
use crate::host::Sim;

impl Sim {
    /// Runs the hooks of one moment, module by module in the order of the registry.
    pub(crate) fn run_hooks(self: &Rc<Self>, moment: impl Fn(&Hooks) -> Option<ModuleHook>) {
        let host = Host(self);
        self.modules
            .registry
            .hooks
            .iter()
            .filter_map(moment)
            .for_each(|hook| hook(&host));
    }

    /// Whether a module holds the step back that is due. All are asked: each does what it has to do before a step.
    pub(crate) fn step_is_held(self: &Rc<Self>) -> bool {
        let host = Host(self);
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
