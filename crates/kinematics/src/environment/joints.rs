//! Joints: positions and dependencies.

use geometry::Finite;
use nalgebra::UnitQuaternion;

use super::Environment;
use crate::error::{KinematicsError, Result};
use crate::joint::{Dependency, Joint, JointType, Law};
use crate::object::{Object, ObjectId};

impl Environment {
    /// A joint of the environment.
    ///
    /// # Errors
    /// When there is no such joint.
    pub fn joint(&self, id: ObjectId) -> Result<&Joint> {
        self.object(id)?.joint().ok_or(KinematicsError::NotAJoint)
    }

    /// For everything but position and dependency.
    ///
    /// # Errors
    /// When there is no such joint.
    pub fn joint_mut(&mut self, id: ObjectId) -> Result<&mut Joint> {
        self.structure += 1;
        self.object_mut(id)?
            .joint_mut()
            .ok_or(KinematicsError::NotAJoint)
    }

    /// Moves a joint within its limits, and those that depend on it.
    ///
    /// # Errors
    /// When there is no such joint, it is spherical, or the position is not finite.
    pub fn set_joint_position(&mut self, id: ObjectId, position: f64) -> Result<()> {
        let joint = self
            .object_mut(id)?
            .joint_mut()
            .ok_or(KinematicsError::NotAJoint)?;
        if joint.joint_type == JointType::Spherical {
            return Err(KinematicsError::Spherical);
        }
        joint.position = joint.within_limits(position.finite().ok_or(KinematicsError::NotFinite)?);
        self.move_dependent(id);
        Ok(())
    }

    /// Position of a spherical joint.
    ///
    /// # Errors
    /// When there is no such joint, or it is not spherical.
    pub fn set_rotation(&mut self, id: ObjectId, rotation: UnitQuaternion<f64>) -> Result<()> {
        let joint = self
            .object_mut(id)?
            .joint_mut()
            .ok_or(KinematicsError::NotAJoint)?;
        if joint.joint_type != JointType::Spherical {
            return Err(KinematicsError::NotSpherical);
        }
        joint.rotation = rotation;
        Ok(())
    }

    /// Makes a joint depend on another one. A joint that would close a circle of dependencies becomes independent.
    ///
    /// # Errors
    /// When one of them does not exist, is no joint or spherical.
    pub fn set_dependency(
        &mut self,
        id: ObjectId,
        dependency: Option<(ObjectId, Law)>,
    ) -> Result<()> {
        for joint in [Some(id), dependency.as_ref().map(|(master, _)| *master)]
            .into_iter()
            .flatten()
        {
            if self.joint(joint)?.joint_type == JointType::Spherical {
                return Err(KinematicsError::Spherical);
            }
        }
        let Some((master, law)) = dependency.filter(|(master, _)| *master != id) else {
            self.joint_mut(id)?.dependency = None;
            return Ok(());
        };
        if self.root_master(master)? == id {
            self.break_circle(id, master)?;
        }
        self.dependencies = true;
        self.joint_mut(id)?.dependency = Some(Dependency { master, law });
        self.move_dependent(master);
        Ok(())
    }

    /// The joint that decides where a joint is: itself, where it is independent.
    pub(crate) fn root_master(&self, id: ObjectId) -> Result<ObjectId> {
        let mut root = id;
        while let Some(dependency) = &self.joint(root)?.dependency {
            root = dependency.master;
        }
        Ok(root)
    }

    /// Makes the joint independent through which `master` depends on `id`.
    fn break_circle(&mut self, id: ObjectId, master: ObjectId) -> Result<()> {
        let mut joint = master;
        while let Some(dependency) = &self.joint(joint)?.dependency {
            if dependency.master == id {
                self.joint_mut(joint)?.dependency = None;
                return Ok(());
            }
            joint = dependency.master;
        }
        Ok(())
    }

    /// Moves the joints that depend on `master`, and those that depend on them. There are no circles.
    pub(crate) fn move_dependent(&mut self, master: ObjectId) {
        if !self.dependencies {
            return;
        }
        let mut pending = vec![master];
        while let Some(master) = pending.pop() {
            let Ok(position) = self.joint(master).map(|joint| joint.position) else {
                return;
            };
            for (i, object) in self.objects.iter_mut().enumerate() {
                let Some(joint) = object.as_mut().and_then(Object::joint_mut) else {
                    continue;
                };
                if let Some(dependency) = joint.dependency.as_ref().filter(|d| d.master == master) {
                    let dependent = dependency.law.position(position);
                    joint.position = if dependent.is_finite() {
                        dependent
                    } else {
                        joint.position
                    };
                    pending.push(ObjectId(i));
                }
            }
        }
    }
}
