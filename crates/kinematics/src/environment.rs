//! The tree of objects: names, parents, poses, joints and their dependencies, groups.

use geometry::{Finite, Pose};
use nalgebra::UnitQuaternion;

use crate::error::{KinematicsError, Result};
use crate::group::{Element, ElementId, Group, GroupId};
use crate::joint::{Dependency, Joint, JointType, Law};
use crate::object::{Kind, Object, ObjectId};
use crate::random::Random;

/// The frame of a pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// The frame of the world.
    World,
    /// The moving side of the parent.
    Parent,
    /// An object; of a joint, its moving side.
    Object(ObjectId),
}

/// Dummies and joints in a tree, and groups that move them.
#[derive(Debug, Clone)]
pub struct Environment {
    pub(crate) objects: Vec<Option<Object>>,
    pub(crate) groups: Vec<Group>,
    pub(crate) random: Random,
    /// Counts changes that chains depend on: everything but positions of joints and poses of dummies at the ends of the tree.
    pub(crate) structure: u64,
    /// Whether any joint depends on another one.
    pub(crate) dependencies: bool,
}

impl Environment {
    /// Without objects. `seed` is for the random starts of [`Environment::find_posture`].
    pub fn new(seed: u64) -> Self {
        Self {
            objects: Vec::new(),
            groups: Vec::new(),
            random: Random::new(seed),
            structure: 0,
            dependencies: false,
        }
    }

    // ---------------------------------------------------------------- objects

    /// Adds a dummy at the origin of the world, without parent and partner.
    pub fn create_dummy(&mut self, name: &str) -> ObjectId {
        self.add(Object::new(name, Kind::Dummy { partner: None }))
    }

    /// Adds a joint at the origin of the world, without parent, in IK mode; a revolute one is cyclic.
    pub fn create_joint(&mut self, name: &str, joint_type: JointType) -> ObjectId {
        self.add(Object::new(name, Kind::Joint(Joint::new(joint_type))))
    }

    fn add(&mut self, object: Object) -> ObjectId {
        self.objects.push(Some(object));
        ObjectId(self.objects.len() - 1)
    }

    /// All objects, in the order in which they were created.
    pub fn objects(&self) -> impl Iterator<Item = (ObjectId, &Object)> {
        let numbered = self.objects.iter().enumerate();
        numbered.filter_map(|(i, object)| Some((ObjectId(i), object.as_ref()?)))
    }

    /// An object of the environment.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn object(&self, id: ObjectId) -> Result<&Object> {
        self.objects
            .get(id.0)
            .and_then(Option::as_ref)
            .ok_or(KinematicsError::NoSuchObject)
    }

    fn object_mut(&mut self, id: ObjectId) -> Result<&mut Object> {
        self.objects
            .get_mut(id.0)
            .and_then(Option::as_mut)
            .ok_or(KinematicsError::NoSuchObject)
    }

    /// The first object with that name.
    pub fn named(&self, name: &str) -> Option<ObjectId> {
        self.objects()
            .find(|(_, object)| object.name == name)
            .map(|(id, _)| id)
    }

    /// Removes an object. Its children stay where they are, below its parent; elements that need it are removed.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn erase(&mut self, id: ObjectId) -> Result<()> {
        let parent = self.object(id)?.parent;
        let children: Vec<ObjectId> = self
            .objects()
            .filter(|(_, o)| o.parent == Some(id))
            .map(|(id, _)| id)
            .collect();
        children
            .into_iter()
            .try_for_each(|child| self.set_parent(child, parent, true))?;
        self.set_parent(id, None, true)?;
        self.unlink(id);
        self.objects[id.0] = None;
        for joint in self
            .objects
            .iter_mut()
            .flatten()
            .filter_map(Object::joint_mut)
        {
            joint.dependency = joint
                .dependency
                .take()
                .filter(|dependency| dependency.master != id);
        }
        for element in self.groups.iter_mut().flat_map(|group| &mut group.elements) {
            *element = element
                .take()
                .filter(|e| e.tip != id && e.base != Some(id) && e.constraint_base != Some(id));
        }
        self.changed();
        Ok(())
    }

    /// Attaches an object to another one; with `in_place` its pose in the world stays.
    ///
    /// # Errors
    /// When one of them does not exist, or the parent is below the object.
    pub fn set_parent(
        &mut self,
        id: ObjectId,
        parent: Option<ObjectId>,
        in_place: bool,
    ) -> Result<()> {
        let before = self.object(id)?.parent;
        let mut ancestor = parent;
        while let Some(above) = ancestor {
            if above == id {
                return Err(KinematicsError::Circle);
            }
            ancestor = self.object(above)?.parent;
        }
        let world = self.pose(id, Frame::World)?;
        self.object_mut(id)?.parent = parent;
        if let Some(before) = before {
            self.object_mut(before)?.children -= 1;
        }
        if let Some(parent) = parent {
            self.object_mut(parent)?.children += 1;
        }
        self.changed();
        if in_place {
            self.set_pose(id, world, Frame::World)
        } else {
            Ok(())
        }
    }

    // ---------------------------------------------------------------- poses

    /// The pose of an object.
    ///
    /// # Errors
    /// When one of the objects does not exist.
    pub fn pose(&self, id: ObjectId, frame: Frame) -> Result<Pose> {
        let object = self.object(id)?;
        Ok(match frame {
            Frame::Parent => object.pose,
            Frame::World => self.parent_side(object)? * object.pose,
            Frame::Object(other) => {
                self.moving_side(other)?.inverse() * (self.parent_side(object)? * object.pose)
            }
        })
    }

    /// An object in the world; of a joint, its moving side.
    pub(crate) fn moving_side(&self, id: ObjectId) -> Result<Pose> {
        let pose = self.pose(id, Frame::World)?;
        Ok(self
            .object(id)?
            .joint()
            .map_or(pose, |joint| pose * joint.motion()))
    }

    /// The moving side of the parent, in the world.
    fn parent_side(&self, object: &Object) -> Result<Pose> {
        let mut side = Pose::identity();
        let mut next = object.parent;
        while let Some(id) = next {
            let parent = self.object(id)?;
            if let Some(joint) = parent.joint() {
                side = joint.motion() * side;
            }
            side = parent.pose * side;
            next = parent.parent;
        }
        Ok(side)
    }

    /// Moves an object; what is attached to it moves with it.
    ///
    /// # Errors
    /// When one of the objects does not exist, or the pose is not finite.
    pub fn set_pose(&mut self, id: ObjectId, pose: Pose, frame: Frame) -> Result<()> {
        let object = self.object(id)?;
        let local = match frame {
            Frame::Parent => pose,
            Frame::World => self.parent_side(object)?.inverse() * pose,
            Frame::Object(other) => {
                self.parent_side(object)?.inverse() * (self.moving_side(other)? * pose)
            }
        };
        geometry::pose::pose_to_array(&local)
            .finite()
            .ok_or(KinematicsError::NotFinite)?;
        let within_chains = object.children > 0 || object.joint().is_some() || self.is_tip(id);
        self.object_mut(id)?.pose = local;
        if within_chains {
            self.changed();
        }
        Ok(())
    }

    fn is_tip(&self, id: ObjectId) -> bool {
        self.groups
            .iter()
            .flat_map(Group::elements)
            .any(|(_, element)| element.tip == id)
    }

    // ---------------------------------------------------------------- dummies

    /// The target of a tip, or the tip of a target.
    ///
    /// # Errors
    /// When there is no such dummy.
    pub fn partner(&self, dummy: ObjectId) -> Result<Option<ObjectId>> {
        match &self.object(dummy)?.kind {
            Kind::Dummy { partner } => Ok(*partner),
            Kind::Joint(_) => Err(KinematicsError::NotADummy),
        }
    }

    /// Makes two dummies tip and target of each other; both lose other partners.
    ///
    /// # Errors
    /// When one of them does not exist or is no dummy.
    pub fn set_partner(&mut self, dummy: ObjectId, partner: Option<ObjectId>) -> Result<()> {
        self.partner(dummy)?;
        partner.map_or(Ok(None), |partner| self.partner(partner))?;
        self.unlink(dummy);
        if let Some(partner) = partner.filter(|partner| *partner != dummy) {
            self.unlink(partner);
            self.link(dummy, Some(partner));
            self.link(partner, Some(dummy));
        }
        self.changed();
        Ok(())
    }

    fn unlink(&mut self, dummy: ObjectId) {
        if let Ok(Some(partner)) = self.partner(dummy) {
            self.link(partner, None);
            self.link(dummy, None);
        }
    }

    fn link(&mut self, dummy: ObjectId, to: Option<ObjectId>) {
        if let Ok(Object {
            kind: Kind::Dummy { partner },
            ..
        }) = self.object_mut(dummy)
        {
            *partner = to;
        }
    }

    // ---------------------------------------------------------------- joints

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

    // ---------------------------------------------------------------- groups

    /// Adds a group without elements: enabled, pseudo-inverse, three iterations.
    pub fn create_group(&mut self, name: &str) -> GroupId {
        self.groups.push(Group::new(name));
        GroupId(self.groups.len() - 1)
    }

    /// All groups with their numbers, in the order in which they were created.
    pub fn groups(&self) -> impl Iterator<Item = (GroupId, &Group)> {
        self.groups
            .iter()
            .enumerate()
            .map(|(i, group)| (GroupId(i), group))
    }

    /// The first group with that name.
    pub fn group_named(&self, name: &str) -> Option<GroupId> {
        self.groups()
            .find(|(_, group)| group.name == name)
            .map(|(id, _)| id)
    }

    /// A group of the environment.
    ///
    /// # Errors
    /// When there is no such group.
    pub fn group(&self, id: GroupId) -> Result<&Group> {
        self.groups.get(id.0).ok_or(KinematicsError::NoSuchGroup)
    }

    /// A group of the environment, to be changed.
    ///
    /// # Errors
    /// When there is no such group.
    pub fn group_mut(&mut self, id: GroupId) -> Result<&mut Group> {
        self.groups
            .get_mut(id.0)
            .ok_or(KinematicsError::NoSuchGroup)
    }

    /// A tip of a group, with the partner it has when the group is handled as its target.
    ///
    /// # Errors
    /// When there is no such group or dummy.
    pub fn add_element(&mut self, group: GroupId, tip: ObjectId) -> Result<ElementId> {
        self.partner(tip)?;
        let elements = &mut self.group_mut(group)?.elements;
        elements.push(Some(Element::new(tip)));
        let id = ElementId(elements.len() - 1);
        self.changed();
        Ok(id)
    }

    /// An element of a group.
    ///
    /// # Errors
    /// When there is no such element.
    pub fn element(&self, group: GroupId, element: ElementId) -> Result<&Element> {
        let element = self
            .group(group)?
            .elements
            .get(element.0)
            .and_then(Option::as_ref);
        element.ok_or(KinematicsError::NoSuchElement)
    }

    /// An element of a group, to be changed.
    ///
    /// # Errors
    /// When there is no such element.
    pub fn element_mut(&mut self, group: GroupId, element: ElementId) -> Result<&mut Element> {
        self.changed();
        let element = self
            .group_mut(group)?
            .elements
            .get_mut(element.0)
            .and_then(Option::as_mut);
        element.ok_or(KinematicsError::NoSuchElement)
    }

    /// The element with that tip.
    ///
    /// # Errors
    /// When there is none.
    pub fn element_of_tip(&self, group: GroupId, tip: ObjectId) -> Result<ElementId> {
        let mut elements = self.group(group)?.elements();
        elements
            .find(|(_, element)| element.tip == tip)
            .map(|(id, _)| id)
            .ok_or(KinematicsError::NoSuchElement)
    }

    fn changed(&mut self) {
        self.structure += 1;
    }
}
