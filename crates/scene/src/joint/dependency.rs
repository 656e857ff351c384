//! Dependent joints: q = offset + coefficient * q of the master (spec: joints 5).

use std::collections::BTreeMap;

use super::{Joint, JointDependency, JointMode, JointType};
use crate::{Field, Handle, Mark, Scene, SceneResult, Topic, Topics};

/// Largest magnitude of offset and coefficient.
const MAX_PARAMETER: f64 = 1e4;
/// Changes after which joints may depend on other joints, or in another way.
const DEPENDENCY_TOPICS: Topics = Topics::NONE
    .with(Topic::Added)
    .with(Topic::Removed)
    .with_fields(&[Field::Joint, Field::Geometry, Field::Other]);

/// Who follows whom, kept until a joint changes.
#[derive(Debug, Default)]
pub(crate) struct DependentJoints {
    known: Option<Mark>,
    by_master: BTreeMap<Handle, Vec<(Handle, JointDependency)>>,
}

impl DependentJoints {
    /// Joints in dependent mode whose master is `master`.
    fn of(&self, master: Handle) -> &[(Handle, JointDependency)] {
        self.by_master.get(&master).map_or(&[], Vec::as_slice)
    }
}

impl Scene {
    /// Makes `handle` follow `master` (None: independent). Ignored for spherical joints. A joint that would close
    /// a cycle loses its own master.
    pub fn set_joint_dependency(
        &mut self,
        handle: Handle,
        master: Option<Handle>,
        offset: f64,
        coefficient: f64,
    ) -> SceneResult<()> {
        let spherical = |h: Handle| {
            self.object(h)?
                .joint()
                .map(|j| j.joint_type == JointType::Spherical)
        };
        if spherical(handle)? || master.map_or(Ok(false), spherical)? || master == Some(handle) {
            return Ok(());
        }
        if let Some(master) = master {
            self.break_dependency_cycle(handle, master)?;
        }
        let limited = |value: f64| {
            if value.is_nan() {
                0.0
            } else {
                value.clamp(-MAX_PARAMETER, MAX_PARAMETER)
            }
        };
        let (offset, coefficient) = (limited(offset), limited(coefficient));
        let dependency = master.map(|master| JointDependency {
            master,
            offset,
            coefficient,
        });
        self.modify_joint(handle, |joint| {
            joint.dependency = dependency;
            joint.idle_law = [offset, coefficient];
        })?;
        self.follow_master(handle)
    }

    /// Frees the joint through which `master` follows `handle`: before `handle` begins to follow `master`.
    ///
    /// # Errors
    /// When one of them is no joint.
    pub fn break_dependency_cycle(&mut self, handle: Handle, master: Handle) -> SceneResult<()> {
        let mut follower = master;
        while let Some(dependency) = self.object(follower)?.joint()?.dependency {
            if dependency.master == handle {
                return self.modify_joint(follower, Joint::leave_master);
            }
            follower = dependency.master;
        }
        Ok(())
    }

    /// Puts a joint at `position` as it is (rad, m), and the joints that follow it where they belong.
    pub fn move_joint(&mut self, handle: Handle, position: f64) -> SceneResult<()> {
        for (handle, position) in self.positions_with_followers(handle, position) {
            self.try_modify(handle, Field::JointPosition, |object| {
                object.joint_mut()?.position = position;
                Ok(())
            })?;
        }
        Ok(())
    }

    /// The position of a joint, and those that the joints take which follow it.
    pub(crate) fn positions_with_followers(
        &mut self,
        handle: Handle,
        position: f64,
    ) -> Vec<(Handle, f64)> {
        self.refresh_dependent_joints();
        let mut positions = vec![(handle, position)];
        let mut next = 0;
        while let Some(&(handle, position)) = positions.get(next) {
            let followers = self.dependent_joints.of(handle).iter();
            positions.extend(followers.map(|(follower, law)| (*follower, law.position(position))));
            next += 1;
        }
        positions
    }

    /// Moves the joints that follow `handle` and that the physics does not move itself.
    pub(crate) fn move_followers(&mut self, handle: Handle, position: f64) -> SceneResult<()> {
        self.refresh_dependent_joints();
        for (follower, law) in self.dependent_joints.of(handle).to_vec() {
            if self.object(follower)?.dynamic_flag.is_empty() {
                self.move_joint(follower, law.position(position))?;
            }
        }
        Ok(())
    }

    /// Rebuilds the dependency graph when a joint may have changed it.
    fn refresh_dependent_joints(&mut self) {
        if !self.journal.changed_since(
            self.dependent_joints
                .known
                .get_or_insert(Mark::new(DEPENDENCY_TOPICS)),
        ) {
            return;
        }
        let mut by_master: BTreeMap<Handle, Vec<(Handle, JointDependency)>> = BTreeMap::new();
        for object in self.objects() {
            let Ok(joint) = object.joint() else { continue };
            if let Some(law) = joint
                .dependency
                .filter(|_| joint.mode == JointMode::Dependent)
            {
                by_master
                    .entry(law.master)
                    .or_default()
                    .push((object.handle(), law));
            }
        }
        self.dependent_joints.by_master = by_master;
    }

    /// Moves a dependent joint to where its master wants it.
    pub(super) fn follow_master(&mut self, handle: Handle) -> SceneResult<()> {
        let joint = self.object(handle)?.joint()?;
        match joint
            .dependency
            .filter(|_| joint.mode == JointMode::Dependent)
        {
            Some(law) => {
                let position = law.position(self.object(law.master)?.joint()?.position);
                self.move_joint(handle, position)
            }
            None => Ok(()),
        }
    }

    /// Velocity of a joint (rad/s, m/s): that of its master, scaled, where it has one.
    pub fn joint_velocity(&self, handle: Handle) -> SceneResult<f64> {
        let (mut handle, mut scale) = (handle, 1.0);
        loop {
            let joint = self.object(handle)?.joint()?;
            match joint
                .dependency
                .filter(|_| joint.mode == JointMode::Dependent)
            {
                Some(law) => (handle, scale) = (law.master, scale * law.coefficient),
                None => return Ok(scale * joint.velocity),
            }
        }
    }
}

impl JointDependency {
    fn position(&self, master: f64) -> f64 {
        self.offset + self.coefficient * master
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;
    use crate::joint::Joint;

    fn scene_with_joints(count: usize) -> (Scene, Vec<Handle>) {
        let mut scene = Scene::new();
        let joint = || {
            Kind::Joint(Box::new(Joint::new(
                JointType::Revolute,
                JointMode::Dependent,
            )))
        };
        let handles = (0..count)
            .map(|_| scene.add("j", joint()).unwrap())
            .collect();
        (scene, handles)
    }

    fn position(scene: &Scene, handle: Handle) -> f64 {
        scene.object(handle).unwrap().joint().unwrap().position
    }

    #[test]
    fn a_chain_follows() {
        let (mut scene, j) = scene_with_joints(3);
        scene
            .set_joint_dependency(j[1], Some(j[0]), 0.1, 2.0)
            .unwrap();
        scene
            .set_joint_dependency(j[2], Some(j[1]), 0.0, -1.0)
            .unwrap();
        scene.set_joint_position(j[0], 0.3).unwrap();
        assert!((position(&scene, j[2]) + 0.7).abs() < 1e-12);
    }

    #[test]
    fn a_circle_is_opened_elsewhere() {
        let (mut scene, j) = scene_with_joints(3);
        scene
            .set_joint_dependency(j[1], Some(j[0]), 0.0, 1.0)
            .unwrap();
        scene
            .set_joint_dependency(j[2], Some(j[1]), 0.0, 1.0)
            .unwrap();
        scene
            .set_joint_dependency(j[0], Some(j[2]), 0.0, 1.0)
            .unwrap();
        let master = |h: Handle| {
            scene
                .object(h)
                .unwrap()
                .joint()
                .unwrap()
                .dependency
                .map(|d| d.master)
        };
        assert_eq!(
            (master(j[0]), master(j[1]), master(j[2])),
            (Some(j[2]), None, Some(j[1]))
        );
    }
}
