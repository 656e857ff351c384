//! Kinematic chains of the scene as environments of `kinematics`, and joints moved back.
//!
//! Objects are copied once, from the tips and targets down to the world; later only positions of joints and poses of targets pass, as
//! seen from the bases. The groups of old scenes are copied anew each time: `groups.rs`.

pub mod groups;

use std::collections::BTreeMap;

use kinematics::{
    Constraints, ElementId, Environment, Frame, GroupId, JointMode, JointType, Law, ObjectId,
};

use scene::joint::{self, Joint};
use scene::{self, Handle, Kind, Scene, SceneError};

/// Which objects of an environment stand for objects of the scene.
#[derive(Debug, Clone, Default)]
pub struct SceneLinks {
    copies: BTreeMap<Handle, ObjectId>,
    /// In the order in which they were copied.
    joints: Vec<(Handle, ObjectId)>,
    groups: BTreeMap<i64, Vec<Task>>,
    /// Whether copies have the names of their objects.
    named: bool,
}

/// The objects of an element, in the scene.
#[derive(Debug, Clone)]
struct Task {
    tip: Handle,
    target: Handle,
    base: Option<Handle>,
}

/// An element of the scene that is to be copied.
pub struct SceneElement {
    /// None: the world.
    pub base: Option<Handle>,
    /// The dummy that has to reach the target.
    pub tip: Handle,
    /// The dummy to be reached.
    pub target: Handle,
    /// The axes in which it has to be reached.
    pub constraints: Constraints,
}

/// Why chains of the scene cannot be copied, solved or moved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// An object of the scene does not exist, or is none of the right type.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The solver refuses what it is given.
    #[error(transparent)]
    Kinematics(#[from] kinematics::KinematicsError),
}

/// A result, or why there is none.
pub type Result<T> = std::result::Result<T, Error>;

impl SceneLinks {
    /// Adds an element to a group, with copies of its chains.
    ///
    /// # Errors
    /// When an object does not exist, or tip or target is a joint.
    pub fn add_element(
        &mut self,
        scene: &Scene,
        env: &mut Environment,
        group: GroupId,
        element: &SceneElement,
    ) -> Result<ElementId> {
        env.group(group)?;
        for end in [element.tip, element.target] {
            if matches!(scene.object(end)?.kind, Kind::Joint(_)) {
                return Err(SceneError::WrongType("dummy").into());
            }
        }
        let base = element
            .base
            .map(|base| self.copy(scene, env, base))
            .transpose()?;
        let tip = self.copy(scene, env, element.tip)?;
        let target = self.copy(scene, env, element.target)?;
        self.copy_dependencies(scene, env)?;
        env.set_partner(tip, Some(target))?;
        let id = env.add_element(group, tip)?;
        let added = env.element_mut(group, id)?;
        (added.base, added.constraints) = (base, element.constraints);
        let task = Task {
            tip: element.tip,
            target: element.target,
            base: element.base,
        };
        self.groups.entry(group.raw()).or_default().push(task);
        Ok(id)
    }

    /// The copies of objects of the scene.
    pub fn copies(&self) -> impl Iterator<Item = (Handle, ObjectId)> {
        self.copies.iter().map(|(handle, id)| (*handle, *id))
    }

    /// The copy of an object, which is made with all its ancestors if there is none.
    fn copy(&mut self, scene: &Scene, env: &mut Environment, handle: Handle) -> Result<ObjectId> {
        let mut path = Vec::new();
        let mut next = Some(handle);
        while let Some(object) = next.filter(|object| !self.copies.contains_key(object)) {
            path.push(object);
            next = scene.object(object)?.parent();
        }
        let mut parent = next.and_then(|known| self.copies.get(&known).copied());
        for object in path.into_iter().rev() {
            let id = self.copy_one(scene, env, object)?;
            env.set_parent(id, parent, false)?;
            env.set_pose(id, scene.object(object)?.pose(), Frame::Parent)?;
            self.copies.insert(object, id);
            parent = Some(id);
        }
        self.copies
            .get(&handle)
            .copied()
            .ok_or(SceneError::NoSuchObject.into())
    }

    fn copy_one(
        &mut self,
        scene: &Scene,
        env: &mut Environment,
        handle: Handle,
    ) -> Result<ObjectId> {
        let object = scene.object(handle)?;
        let name = if self.named { object.old_name() } else { "" };
        let Kind::Joint(joint) = &object.kind else {
            return Ok(env.create_dummy(name));
        };
        let id = env.create_joint(name, joint_type(joint.joint_type));
        let copy = env.joint_mut(id)?;
        (copy.cyclic, copy.min, copy.range) = (joint.cyclic, joint.min, joint.range);
        copy.screw_lead = joint.screw_lead;
        copy_position(env, id, joint)?;
        self.joints.push((handle, id));
        Ok(id)
    }

    /// Makes copies of dependent joints depend on the copies of their masters; without one they are passive.
    fn copy_dependencies(&self, scene: &Scene, env: &mut Environment) -> Result<()> {
        for &(handle, id) in &self.joints {
            let joint = scene.object(handle)?.joint()?;
            let Some(law) = joint
                .dependency
                .filter(|_| joint.mode == joint::JointMode::Dependent)
            else {
                continue;
            };
            match self.copies.get(&law.master) {
                Some(&master) => {
                    let linear = Law::Linear {
                        offset: law.offset,
                        factor: law.coefficient,
                    };
                    env.set_dependency(id, Some((master, linear)))?;
                }
                None => env.joint_mut(id)?.mode = JointMode::Passive,
            }
        }
        Ok(())
    }

    /// Brings joints to where they are in the scene, and targets to where they are as seen from their bases. Objects that are gone
    /// are left out.
    ///
    /// # Errors
    /// When the environment lost an object.
    pub fn sync_from(
        &self,
        scene: &Scene,
        env: &mut Environment,
        groups: &[GroupId],
    ) -> Result<()> {
        if groups
            .iter()
            .all(|group| !self.groups.contains_key(&group.raw()))
        {
            return Ok(());
        }
        for &(handle, id) in &self.joints {
            if let (Ok(joint), Ok(_)) = (
                scene.object(handle).and_then(|object| object.joint()),
                env.joint(id),
            ) {
                copy_position(env, id, joint)?;
            }
        }
        for task in groups
            .iter()
            .filter_map(|group| self.groups.get(&group.raw()))
            .flatten()
        {
            let frame = task.base.map_or(scene::Frame::World, scene::Frame::Object);
            let Ok(pose) = scene.pose_in(task.target, frame, false) else {
                continue;
            };
            let base = task
                .base
                .and_then(|base| self.copies.get(&base))
                .map_or(Frame::World, |base| Frame::Object(*base));
            if let Some(&target) = self.copies.get(&task.target) {
                env.set_pose(target, pose, base)?;
            }
        }
        Ok(())
    }

    /// Moves the joints of the scene that groups move: those of the physics get a target. Objects that are gone are left out.
    ///
    /// # Errors
    /// When a group does not exist, or a joint has no place to go to.
    pub fn sync_to(
        &self,
        scene: &mut Scene,
        env: &Environment,
        groups: &[GroupId],
        is_dynamic: impl Fn(Handle) -> bool,
    ) -> Result<()> {
        for handle in self.joints_of(scene, groups) {
            let Some(joint) = self.copies.get(&handle).and_then(|id| env.joint(*id).ok()) else {
                continue;
            };
            if joint.mode != JointMode::Ik || joint.dependency.is_some() {
                continue;
            }
            let position = joint.position;
            if joint.joint_type == JointType::Spherical {
                let rotation = joint.rotation;
                scene.try_modify(handle, scene::Field::JointPosition, |object| {
                    object.joint_mut()?.spherical = rotation;
                    Ok(())
                })?;
            } else if is_dynamic(handle) {
                scene.set_joint_target_position(handle, position, &[])?;
            } else {
                scene.set_joint_position(handle, position)?;
            }
        }
        Ok(())
    }

    /// The joints between base and tip of the groups' elements.
    pub fn joints_of(&self, scene: &Scene, groups: &[GroupId]) -> Vec<Handle> {
        let mut joints = Vec::new();
        for task in groups
            .iter()
            .filter_map(|group| self.groups.get(&group.raw()))
            .flatten()
        {
            let mut next = Some(task.tip);
            while let Some(handle) = next.filter(|handle| Some(*handle) != task.base) {
                let Ok(object) = scene.object(handle) else {
                    break;
                };
                if object.joint().is_ok() && !joints.contains(&handle) {
                    joints.push(handle);
                }
                next = object.parent();
            }
        }
        joints
    }
}

/// The type of joint of the chains that a type of the scene is.
pub fn joint_type(of_scene: joint::JointType) -> JointType {
    match of_scene {
        joint::JointType::Revolute => JointType::Revolute,
        joint::JointType::Prismatic => JointType::Prismatic,
        joint::JointType::Spherical => JointType::Spherical,
    }
}

/// Moves a copy to where its joint is, by the joint's own position: dependent ones follow their masters.
fn copy_position(env: &mut Environment, id: ObjectId, joint: &Joint) -> Result<()> {
    match joint.joint_type {
        joint::JointType::Spherical => env.set_rotation(id, joint.spherical)?,
        _ => env.set_joint_position(id, joint.position)?,
    }
    Ok(())
}
