//! Which cameras and vision sensors see an object. Files contain it; no function changes it.

use std::collections::BTreeSet;

use crate::{Handle, Scene};

/// Those that see an object.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Viewers {
    /// Every camera and vision sensor.
    #[default]
    All,
    /// No camera or vision sensor.
    None,
    /// This camera or vision sensor.
    One(Handle),
    /// The members of the collection with this handle.
    Collection(i64),
}

impl Viewers {
    /// The same without a viewer that is removed: then all see it.
    pub(crate) fn without(self, removed: &BTreeSet<Handle>) -> Self {
        match self {
            Self::One(viewer) if removed.contains(&viewer) => Self::All,
            _ => self,
        }
    }

    /// Whether a camera or vision sensor is among them; a view without an object (None) only where all are.
    pub fn include(self, scene: &Scene, viewer: Option<Handle>) -> bool {
        match (self, viewer) {
            (Self::All, _) => true,
            (Self::None, _) | (_, None) => false,
            (Self::One(one), Some(viewer)) => one == viewer,
            (Self::Collection(collection), Some(viewer)) => scene
                .collection_objects(collection)
                .is_ok_and(|members| members.contains(&viewer)),
        }
    }
}
