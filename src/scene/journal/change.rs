//! The record of what changed in the scene since it was last read.
//!
//! Every mutation of [`Scene`](super::Scene) goes through `Scene::modify` or one of the structural operations, and each of those
//! notes its change here. Nothing is stored while nobody listens.

use std::collections::BTreeMap;

use super::values::custom_data::Edited;
use super::{Handle, Holder, Namespace, Uid};

/// What changed about an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Field {
    Alias,
    Parent,
    Pose,
    /// What was measured or what the physics reports: velocities, readings, flags.
    Measured,
    Layer,
    ObjectProperty,
    SpecialProperty,
    ModelProperty,
    Dynamics,
    Geometry,
    Appearance,
    /// The image on a mesh.
    Texture,
    /// What kind of joint it is: mode, limits, master.
    Joint,
    /// What a joint is to do: targets, gains, limits of its motor. The physics reads these in every pass.
    JointControl,
    JointPosition,
    Sensor,
    Script,
    Priority,
    /// A value that is only kept for scripts.
    Kept,
    Other,
}

/// One change, in the order it happened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Change {
    Added(Handle),
    Removed(Handle, Uid),
    Modified(Handle, Field),
    Selection,
    Settings,
    /// Custom data or a signal was written or removed: which of the two, the holder tells. Its name is without the mark of its type.
    Stored {
        holder: Holder,
        namespace: Namespace,
        name: String,
    },
}

/// Names of the data of one object that were written (true) or removed.
pub type ChangedNames = BTreeMap<String, bool>;

/// Collects changes for whoever listens, and counts changes of the tree for caches.
#[derive(Debug, Default)]
pub struct Changes {
    listening: bool,
    pending: Vec<Change>,
    tree_revision: u64,
    dynamics_revision: u64,
    changed_data: BTreeMap<(Handle, Namespace), ChangedNames>,
    counters: Counters,
}

/// How often the tree changed, ever.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    pub creations: i64,
    pub destructions: i64,
    /// Objects that came, went, or got another parent or place.
    pub hierarchy: i64,
}

impl Counters {
    fn count(&mut self, change: &Change) {
        self.creations += i64::from(matches!(change, Change::Added(_)));
        self.destructions += i64::from(matches!(change, Change::Removed(..)));
        let of_tree = matches!(change, Change::Added(_) | Change::Removed(..) | Change::Modified(_, Field::Parent));
        self.hierarchy += i64::from(of_tree);
    }
}

impl Changes {
    pub(super) fn note(&mut self, change: Change) {
        self.counters.count(&change);
        match change {
            Change::Modified(_, Field::Pose | Field::Measured | Field::JointPosition | Field::JointControl) => {}
            Change::Modified(_, Field::Alias | Field::Appearance | Field::Texture | Field::Kept) => {}
            Change::Selection | Change::Settings | Change::Stored { .. } => {}
            Change::Modified(_, Field::Script | Field::Priority) => self.tree_revision += 1,
            Change::Added(_) | Change::Removed(..) | Change::Modified(_, Field::Parent | Field::ModelProperty) => {
                self.tree_revision += 1;
                self.dynamics_revision += 1;
            }
            Change::Modified(..) => self.dynamics_revision += 1,
        }
        if self.listening {
            self.pending.push(change);
        }
    }

    /// Notes what an edit of named values did. Scripts attached to objects are told in any case, see `take_changed_data`.
    pub fn note_stored(&mut self, holder: Holder, namespace: Namespace, edited: &Edited<'_>) {
        match edited {
            Edited::Nothing => {}
            Edited::Written(name) => self.note_name(holder, namespace, name, true),
            Edited::Removed(name) => self.note_name(holder, namespace, name, false),
            Edited::Cleared(names) => names.iter().for_each(|name| self.note_name(holder, namespace, name, false)),
        }
    }

    fn note_name(&mut self, holder: Holder, namespace: Namespace, name: &str, written: bool) {
        if let Holder::Object(handle) = holder {
            let names = self.changed_data.entry((handle, namespace)).or_default();
            match names.get_mut(name) {
                Some(last) => *last = written,
                None => drop(names.insert(name.to_owned(), written)),
            }
        }
        if self.listening {
            self.pending.push(Change::Stored { holder, namespace, name: name.to_owned() });
        }
    }

    /// Which data of which objects was changed since the last call.
    pub fn take_changed_data(&mut self) -> BTreeMap<(Handle, Namespace), ChangedNames> {
        std::mem::take(&mut self.changed_data)
    }

    /// Starts or stops collecting.
    pub fn listen(&mut self, listening: bool) {
        self.listening = listening;
        if !listening {
            self.pending.clear();
        }
    }

    /// Whether changes are being collected.
    pub fn is_listening(&self) -> bool {
        self.listening
    }

    /// The changes since the last call.
    pub fn take(&mut self) -> Vec<Change> {
        std::mem::take(&mut self.pending)
    }

    pub fn counters(&self) -> Counters {
        self.counters
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
