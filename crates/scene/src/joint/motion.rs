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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;
    use crate::joint::{JointMode, JointType};

    /// A slider without limits that matter, and the scene it is in.
    fn slider() -> (Scene, Handle) {
        let mut scene = Scene::new();
        let joint = Joint::new(JointType::Prismatic, JointMode::Kinematic);
        let handle = scene.add("j", Kind::Joint(Box::new(joint))).unwrap();
        (scene, handle)
    }

    fn joint(scene: &Scene, handle: Handle) -> &Joint {
        scene.object(handle).unwrap().joint().unwrap()
    }

    fn step(position: f64, velocity: f64, accel: f64) -> JointStep {
        JointStep {
            position: Some(position),
            velocity,
            accel,
            immobile: false,
        }
    }

    #[test]
    fn a_motion_begins_with_the_velocity_that_is_asked_for_and_goes_on_with_its_own() {
        let (mut scene, handle) = slider();
        scene
            .set_joint_target_velocity(handle, 0.2, &[0.5, 0.25], Some(0.05))
            .unwrap();
        let found = joint(&scene, handle);
        assert_eq!(
            found.motion,
            Some(JointMotion::AtVelocity {
                initial: Some(0.05)
            })
        );
        assert_eq!(
            (found.target_velocity, found.max_accel, found.max_jerk),
            (0.2, 0.5, 0.25)
        );
        scene.step_joint(handle, step(0.01, 0.1, 0.5)).unwrap();
        let found = joint(&scene, handle);
        assert_eq!(
            found.motion,
            Some(JointMotion::AtVelocity { initial: None })
        );
        assert_eq!(
            (found.position, found.velocity, found.accel),
            (0.01, 0.1, 0.5)
        );
    }

    #[test]
    fn a_motion_without_an_initial_velocity_keeps_that_of_the_one_before() {
        let (mut scene, handle) = slider();
        scene.set_joint_target_position(handle, 0.3, &[]).unwrap();
        scene.step_joint(handle, step(0.1, 0.2, 0.3)).unwrap();
        scene
            .set_joint_target_velocity(handle, 0.4, &[], None)
            .unwrap();
        let found = joint(&scene, handle);
        assert_eq!((found.velocity, found.accel), (0.2, 0.3));
        assert_eq!(
            found.motion,
            Some(JointMotion::AtVelocity { initial: None })
        );
        assert!(
            scene
                .set_joint_target_velocity(handle, 0.4, &[], Some(f64::NAN))
                .is_err()
        );
    }

    /// A joint has arrived when it neither moves nor accelerates, however slowly, or when its script says so.
    #[test]
    fn a_motion_ends_at_rest_and_not_before() {
        let (mut scene, handle) = slider();
        let tiny = 1e-9;
        for (velocity, accel, immobile, goes_on) in [
            (tiny, 0.0, false, true),
            (0.0, tiny, false, true),
            (-tiny, -tiny, false, true),
            (0.0, 0.0, false, false),
            (0.5, 0.5, true, false),
            (f64::NAN, f64::INFINITY, false, false),
        ] {
            scene.set_joint_target_position(handle, 0.3, &[]).unwrap();
            let step = JointStep {
                immobile,
                ..step(0.1, velocity, accel)
            };
            scene.step_joint(handle, step).unwrap();
            let motion = joint(&scene, handle).motion;
            assert_eq!(
                motion,
                goes_on.then_some(JointMotion::ToPosition),
                "{velocity} {accel} {immobile}"
            );
        }
    }

    #[test]
    fn a_motion_at_a_velocity_ends_at_rest_too() {
        let (mut scene, handle) = slider();
        scene
            .set_joint_target_velocity(handle, 0.0, &[], Some(0.1))
            .unwrap();
        scene.step_joint(handle, step(0.01, 0.0, 0.0)).unwrap();
        assert_eq!(joint(&scene, handle).motion, None);
    }

    #[test]
    fn a_step_stays_within_the_limits_and_nowhere_is_no_position() {
        let (mut scene, handle) = slider();
        scene.set_joint_target_position(handle, 3.0, &[]).unwrap();
        scene.step_joint(handle, step(2.0, 1.0, 0.0)).unwrap();
        assert_eq!(joint(&scene, handle).position, 0.5);
        scene.step_joint(handle, step(f64::NAN, 1.0, 0.0)).unwrap();
        assert_eq!(joint(&scene, handle).position, 0.5);
        let nowhere = JointStep {
            position: None,
            ..step(0.0, 1.0, 0.0)
        };
        scene.step_joint(handle, nowhere).unwrap();
        assert_eq!(joint(&scene, handle).position, 0.5);
    }

    #[test]
    fn a_joint_that_has_arrived_shows_its_last_velocity_for_one_step() {
        let (mut scene, handle) = slider();
        scene.set_joint_target_position(handle, 0.1, &[]).unwrap();
        assert_eq!(scene.joints_in_motion(), [handle]);
        let last = JointStep {
            immobile: true,
            ..step(0.1, 0.2, 0.0)
        };
        scene.step_joint(handle, last).unwrap();
        assert_eq!(joint(&scene, handle).velocity, 0.2);
        assert_eq!(scene.joints_in_motion(), []);
        assert_eq!(joint(&scene, handle).velocity, 0.0);
    }

    #[test]
    fn the_velocity_of_a_dynamic_joint_is_the_physics_affair() {
        let (mut scene, handle) = slider();
        scene.set_joint_mode(handle, JointMode::Dynamic).unwrap();
        scene
            .modify_joint(handle, |joint| joint.velocity = 0.3)
            .unwrap();
        assert_eq!(scene.joints_in_motion(), []);
        assert_eq!(joint(&scene, handle).velocity, 0.3);
    }

    #[test]
    fn all_motions_can_be_ended_at_once() {
        let (mut scene, handle) = slider();
        scene.set_joint_target_position(handle, 0.3, &[]).unwrap();
        scene.step_joint(handle, step(0.1, 0.2, 0.3)).unwrap();
        scene.stop_joint_motions();
        let found = joint(&scene, handle);
        assert_eq!(
            (found.motion, found.velocity, found.accel, found.position),
            (None, 0.0, 0.0, 0.1)
        );
        // Of one that is at rest only the velocity is left.
        scene
            .modify_joint(handle, |joint| joint.velocity = 0.3)
            .unwrap();
        scene.stop_joint_motions();
        assert_eq!(joint(&scene, handle).velocity, 0.0);
    }
}
