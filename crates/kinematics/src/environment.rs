//! The tree of objects: names, parents, poses; joints, dependencies and groups in the rooms below.

mod groups;
mod joints;

use geometry::{Finite, Pose};

use crate::error::{KinematicsError, Result};
use crate::group::Group;
use crate::joint::{Joint, JointType};
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

    fn changed(&mut self) {
        self.structure += 1;
    }
}
