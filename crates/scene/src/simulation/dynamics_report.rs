//! Results that the physics writes into the scene. They do not count as changes for the physics.

use nalgebra::UnitQuaternion;

use crate::pose::placement::normalized;
use crate::shape::Velocity;
use crate::{Change, Field, Handle, Pose, Scene, SceneResult};

/// The state of a dynamic joint after a sub-step.
#[derive(Debug, Clone, PartialEq)]
pub struct JointReport {
    /// Of a revolute or prismatic joint, rad or m.
    pub position: f64,
    /// Of a spherical joint.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of a revolute or prismatic joint, rad/s or m/s.
    pub velocity: f64,
    /// The moving side as the engine has it, in the frame of the joint.
    pub moving_side: Pose,
    /// Effort of the motor on the parent, N m or N.
    pub effort: f64,
}

impl Scene {
    /// Puts a simulated shape where the engine has it, in the world; returns its pose in the parent's frame.
    pub fn report_body(
        &mut self,
        shape: Handle,
        world: Option<Pose>,
        velocity: Velocity,
    ) -> SceneResult<Pose> {
        let local = match world {
            Some(world) => normalized(self.parent_frame(shape)?.inverse() * world),
            None => self.object(shape)?.pose(),
        };
        self.try_modify(shape, Field::Pose, |object| {
            object.pose = local;
            object.shape_mut()?.velocity = velocity;
            Ok(())
        })?;
        self.note(Change::Modified(shape, Field::Measured));
        Ok(local)
    }

    /// Takes over where the engine has a joint. What the ideal joint cannot express is kept as its error.
    pub fn report_joint(&mut self, joint: Handle, report: &JointReport) -> SceneResult<()> {
        self.try_modify(joint, Field::JointPosition, |object| {
            let joint = object.joint_mut()?;
            joint.position = report.position;
            joint.spherical = report.rotation;
            joint.velocity = report.velocity;
            joint.raw_force = Some(report.effort);
            joint.error = Some(normalized(
                joint.ideal_pose().inverse() * report.moving_side,
            ));
            Ok(())
        })?;
        self.move_followers(joint, report.position)
    }

    /// Takes over the deviation of a force sensor's two sides.
    pub fn report_sensor(&mut self, sensor: Handle, moving_side: Pose) -> SceneResult<()> {
        self.try_modify(sensor, Field::JointPosition, |object| {
            object.force_sensor_mut()?.error = Some(moving_side);
            Ok(())
        })
    }
}
