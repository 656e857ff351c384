//! The motion of the bodies over the step that was solved, where no engine has to move them.

use crate::joint::JointKind;
use crate::linked_body::{BodyMotion, LinkedBody};
use crate::mechanism::Mechanism;

impl Mechanism {
    /// Where the bodies are after the step, and how they move then: semi-implicit Euler, velocities first. To be corrected by
    /// [`correct_positions`](Self::correct_positions). Only of use if nothing acts on the bodies beyond what the step was begun with.
    pub fn integrate(&self) -> impl Iterator<Item = BodyMotion> {
        self.bodies.iter().map(|body| body.after(self.step))
    }

    /// How far the joints turn in the step by the velocities that were found (rad); 0 for others than revolute ones.
    pub fn turns(&self) -> impl Iterator<Item = f64> {
        self.joints.iter().map(|joint| match joint.properties.kind {
            JointKind::Revolute => joint.turning_velocity(&self.bodies) * self.step,
            _ => 0.0,
        })
    }
}

impl LinkedBody {
    fn after(&self, step: f64) -> BodyMotion {
        let mut moved = BodyMotion {
            pose: self.pose,
            velocity: self.velocity,
        };
        if self.is_dynamic() {
            moved.pose = self.displaced(&(self.velocity * step));
        }
        moved
    }
}
