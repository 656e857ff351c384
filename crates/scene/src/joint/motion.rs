//! Kinematic motion of joints: which joints move, and the effect of a step computed by a script (spec: joints 6).
//!
//! The steps themselves come from scripts (`sysCall_joint`).

use super::{Joint, JointMode, JointMotion};
use crate::{Field, Handle, Scene, SceneResult};

/// One step of a joint, as a script asks for it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointStep {
    /// None leaves the joint where it is.
    pub position: Option<f64>,
    /// Velocity after the step, rad/s or m/s.
    pub velocity: f64,
    /// Acceleration after the step, rad/s^2 or m/s^2.
    pub accel: f64,
    /// The motion is over, whatever the velocity.
    pub immobile: bool,
}

impl Scene {
    /// Joints on their way to a target, in the order of their creation. Those that came to rest in the last step stop here.
    pub fn joints_in_motion(&mut self) -> Vec<Handle> {
        let mut moving = Vec::new();
        let mut resting = Vec::new();
        for (handle, joint) in self.objects.joints() {
            if joint.motion.is_some() {
                moving.push(handle);
            } else if joint.mode == JointMode::Kinematic && joint.velocity != 0.0 {
                resting.push(handle);
            }
        }
        for handle in resting {
            // The handle was just read.
            let _ = self.try_modify(handle, Field::JointPosition, |object| {
                object.joint_mut().map(|j| j.velocity = 0.0)
            });
        }
        moving
    }

    /// Applies a step to a joint in motion; one that ends at rest ends the motion.
    pub fn step_joint(&mut self, handle: Handle, step: JointStep) -> SceneResult<()> {
        let known = |value: f64| if value.is_finite() { value } else { 0.0 };
        let joint = self.object(handle)?.joint()?;
        let position = step
            .position
            .filter(|p| p.is_finite())
            .map_or(joint.position, |p| joint.limited(p));
        self.move_joint(handle, position)?;
        self.try_modify(handle, Field::JointPosition, |object| {
            let joint = object.joint_mut()?;
            (joint.velocity, joint.accel) = (known(step.velocity), known(step.accel));
            let ends = step.immobile || (joint.velocity == 0.0 && joint.accel == 0.0);
            joint.motion = match joint.motion {
                Some(JointMotion::AtVelocity { .. }) if !ends => {
                    Some(JointMotion::AtVelocity { initial: None })
                }
                motion => motion.filter(|_| !ends),
            };
            Ok(())
        })
    }

    /// Ends all kinematic motions.
    pub fn stop_joint_motions(&mut self) {
        let in_motion = |joint: &Joint| joint.motion.is_some() || joint.velocity != 0.0;
        let joints: Vec<Handle> = self
            .objects
            .joints()
            .filter_map(|(handle, joint)| in_motion(joint).then_some(handle))
            .collect();
        for handle in joints {
            // The handle was just read.
            let _ = self.modify_joint(handle, |joint| {
                joint.motion = None;
                (joint.velocity, joint.accel) = (0.0, 0.0);
            });
        }
    }
}
