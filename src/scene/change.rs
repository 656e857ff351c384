//! The record of what changed in the scene since it was last read.
//!
//! Every mutation of [`Scene`](super::Scene) goes through `Scene::modify` or one of the structural operations, and each of those
//! notes its change here. Nothing is stored while nobody listens.

use super::Handle;

/// What changed about an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Field {
    Alias,
    Parent,
    Pose,
    Layer,
    ObjectProperty,
    SpecialProperty,
    ModelProperty,
    CustomData,
    Signal,
    Dynamics,
    Geometry,
    Appearance,
    /// What kind of joint it is: mode, limits, master.
    Joint,
    /// What a joint is to do: targets, gains, limits of its motor. The physics reads these in every pass.
    JointControl,
    JointPosition,
    Sensor,
    Script,
    Priority,
    Other,
}

/// One change, in the order it happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    Added(Handle),
    Removed(Handle),
    Modified(Handle, Field),
    Selection,
    Settings,
}

/// Collects changes for whoever listens, and counts changes of the tree for caches.
#[derive(Debug, Default)]
pub struct Changes {
    listening: bool,
    pending: Vec<Change>,
    tree_revision: u64,
    dynamics_revision: u64,
}

impl Changes {
    pub(super) fn note(&mut self, change: Change) {
        match change {
            Change::Modified(_, Field::Pose | Field::JointPosition | Field::JointControl) => {}
            Change::Modified(_, Field::Alias | Field::CustomData | Field::Signal | Field::Appearance) => {}
            Change::Selection | Change::Settings => {}
            Change::Modified(_, Field::Script | Field::Priority) => self.tree_revision += 1,
            Change::Added(_) | Change::Removed(_) | Change::Modified(_, Field::Parent | Field::ModelProperty) => {
                self.tree_revision += 1;
                self.dynamics_revision += 1;
            }
            Change::Modified(..) => self.dynamics_revision += 1,
        }
        if self.listening {
            self.pending.push(change);
        }
    }

    /// Starts or stops collecting.
    pub fn listen(&mut self, listening: bool) {
        self.listening = listening;
        if !listening {
            self.pending.clear();
        }
    }

    /// The changes since the last call.
    pub fn take(&mut self) -> Vec<Change> {
        std::mem::take(&mut self.pending)
    }

    /// Grows with every change that can alter the order of scripts.
    pub fn tree_revision(&self) -> u64 {
        self.tree_revision
    }

    /// Grows with every change that can alter what takes part in the dynamics.
    pub fn dynamics_revision(&self) -> u64 {
        self.dynamics_revision
    }
}
