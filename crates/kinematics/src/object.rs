//! What a kinematic environment consists of.

use geometry::Pose;

use crate::joint::Joint;

/// Number of an object. It is never used twice in an environment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObjectId(pub(crate) usize);

impl ObjectId {
    /// The id of a script's number; None where it is negative. Whether it exists is checked when it is used.
    pub fn from_raw(raw: i64) -> Option<Self> {
        usize::try_from(raw).ok().map(Self)
    }

    /// The number that scripts know.
    pub fn raw(self) -> i64 {
        self.0 as i64
    }
}

/// A dummy or a joint of an environment.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Name, by which the object can be found.
    pub name: String,
    pub(crate) parent: Option<ObjectId>,
    /// Relative to the moving side of the parent.
    pub(crate) pose: Pose,
    pub(crate) kind: Kind,
    pub(crate) children: u32,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Kind {
    /// A tip has its target as its partner, and a target its tip.
    Dummy {
        partner: Option<ObjectId>,
    },
    Joint(Joint),
}

impl Object {
    pub(crate) fn new(name: &str, kind: Kind) -> Self {
        Self {
            name: name.into(),
            parent: None,
            pose: Pose::identity(),
            kind,
            children: 0,
        }
    }

    /// The object it is attached to; None at the root of a tree.
    pub fn parent(&self) -> Option<ObjectId> {
        self.parent
    }

    /// The joint, if it is one.
    pub fn joint(&self) -> Option<&Joint> {
        match &self.kind {
            Kind::Joint(joint) => Some(joint),
            Kind::Dummy { .. } => None,
        }
    }

    pub(crate) fn joint_mut(&mut self) -> Option<&mut Joint> {
        match &mut self.kind {
            Kind::Joint(joint) => Some(joint),
            Kind::Dummy { .. } => None,
        }
    }
}
