//! One dynamics call: sub-steps with the callbacks of scripts between them.

use std::rc::Rc;

use super::sim::Sim;

impl Sim {
    /// Advances the dynamics by `time_step` seconds; returns the number of sub-steps.
    pub(crate) fn handle_dynamics(self: &Rc<Self>, _time_step: f64) -> i64 {
        0
    }
}
