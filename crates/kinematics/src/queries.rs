//! What can be asked of an environment without moving anything.

use crate::environment::{Environment, Frame};
use crate::equations::{Angles, Equations};
use crate::error::Result;
use crate::group::{Constraints, GroupId};
use crate::joint::Joint;
use crate::object::{Object, ObjectId};
use nalgebra::UnitQuaternion;

/// Where a joint was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Posture {
    joint: ObjectId,
    position: f64,
    rotation: UnitQuaternion<f64>,
}

impl Environment {
    /// Jacobian and errors of a group as it is; None where it has no valid element.
    ///
    /// # Errors
    /// When there is no such group.
    pub fn equations(&mut self, group: GroupId) -> Result<Option<Equations>> {
        let chains = self.take_chains(group)?;
        let mut equations = Equations::default();
        let valid = chains.valid;
        let evaluated = if valid {
            equations.evaluate(self, self.group(group)?, &chains, Angles::Euler)
        } else {
            Ok(())
        };
        self.group_mut(group)?.chains = Some(chains);
        evaluated.map(|()| valid.then_some(equations))
    }

    /// The joints that a group moves, from the bases to the tips.
    ///
    /// # Errors
    /// When there is no such group.
    pub fn joints_of(&mut self, group: GroupId) -> Result<Vec<ObjectId>> {
        let chains = self.take_chains(group)?;
        let joints = chains
            .columns
            .iter()
            .filter(|column| column.stage == 0)
            .map(|column| column.joint)
            .collect();
        self.group_mut(group)?.chains = Some(chains);
        Ok(joints)
    }

    /// Jacobian and errors of a chain that belongs to no group: from `base` (the world if None) to a tip that `last_joint` moves, all in
    /// world coordinates. None where no joint moves it. Without a target the errors are zero.
    ///
    /// # Errors
    /// When one of the objects does not exist.
    pub fn jacobian_of_chain(
        &self,
        base: Option<ObjectId>,
        last_joint: ObjectId,
        constraints: Constraints,
        [tip_pose, target_pose, axes]: [Option<crate::Pose>; 3],
    ) -> Result<Option<Equations>> {
        self.joint(last_joint)?;
        let mut copy = self.clone();
        let [tip, target, frame] = ["", "", ""].map(|name| copy.create_dummy(name));
        copy.set_parent(tip, Some(last_joint), false)?;
        let tip_pose = tip_pose.unwrap_or(copy.pose(last_joint, Frame::World)?);
        copy.set_pose(tip, tip_pose, Frame::World)?;
        copy.set_pose(target, target_pose.unwrap_or(tip_pose), Frame::World)?;
        copy.set_pose(frame, axes.unwrap_or_default(), Frame::World)?;
        copy.set_partner(tip, Some(target))?;
        let group = copy.create_group("");
        let element = copy.add_element(group, tip)?;
        let element = copy.element_mut(group, element)?;
        (element.base, element.constraint_base, element.constraints) =
            (base, axes.map(|_| frame), constraints);
        copy.equations(group)
    }

    /// Where all joints are.
    pub fn postures(&self) -> Vec<Posture> {
        let joints = self
            .objects()
            .filter_map(|(id, object)| object.joint().map(|joint| (id, joint)));
        joints
            .map(
                |(
                    joint,
                    Joint {
                        position, rotation, ..
                    },
                )| Posture {
                    joint,
                    position: *position,
                    rotation: *rotation,
                },
            )
            .collect()
    }

    /// Puts joints back to where they were.
    pub fn set_postures(&mut self, before: &[Posture]) {
        for posture in before {
            if let Some(joint) = self.objects[posture.joint.0]
                .as_mut()
                .and_then(Object::joint_mut)
            {
                (joint.position, joint.rotation) = (posture.position, posture.rotation);
            }
        }
    }
}
