//! Which shape each mesh belongs to: meshes have identifiers of their own.

use std::collections::BTreeMap;

use super::Shape;
use crate::{Handle, Uid};

/// The shapes of all meshes.
#[derive(Debug, Default)]
pub(crate) struct MeshOwners(BTreeMap<Uid, Handle>);

impl MeshOwners {
    pub(crate) fn note(&mut self, handle: Handle, shape: &Shape) {
        self.0
            .extend(shape.parts.iter().map(|part| (part.uid, handle)));
    }

    pub(crate) fn forget(&mut self, shape: &Shape) {
        for part in &shape.parts {
            self.0.remove(&part.uid);
        }
    }

    pub(crate) fn of(&self, mesh: Uid) -> Option<Handle> {
        self.0.get(&mesh).copied()
    }
}
