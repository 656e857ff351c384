//! The particle objects of a scene.

use std::collections::BTreeMap;

use super::{ParticleObject, ParticleStyle};
use crate::drawing::DrawingObject;
use crate::{SceneError, SceneResult};

/// Particle objects by handle. Handles count from 1 and are not used twice.
#[derive(Debug, Default)]
pub struct Particles {
    by_handle: BTreeMap<i64, ParticleObject>,
    created: i64,
    /// Whether one was removed since they were drawn.
    has_gone: bool,
}

impl Particles {
    /// Whether there is no particle object.
    pub fn is_empty(&self) -> bool {
        self.by_handle.is_empty()
    }

    /// The particle objects, in the order of their creation.
    pub fn iter(&self) -> impl Iterator<Item = &ParticleObject> {
        self.by_handle.values()
    }

    /// The same, to be moved.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut ParticleObject> {
        self.by_handle.values_mut()
    }

    /// Adds a particle object without particles, which ends with the script `owner`.
    pub fn add(&mut self, style: ParticleStyle, owner: i64) -> i64 {
        self.created += 1;
        self.by_handle
            .insert(self.created, ParticleObject::new(style, owner));
        self.created
    }

    /// The particle object with that handle.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn get(&self, handle: i64) -> SceneResult<&ParticleObject> {
        self.by_handle.get(&handle).ok_or(SceneError::NoSuchObject)
    }

    /// The same, to be changed.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn get_mut(&mut self, handle: i64) -> SceneResult<&mut ParticleObject> {
        let object = self.by_handle.get_mut(&handle);
        object.ok_or(SceneError::NoSuchObject)
    }

    /// Removes a particle object.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn remove(&mut self, handle: i64) -> SceneResult<()> {
        let removed = self.by_handle.remove(&handle);
        self.has_gone |= removed.is_some();
        removed.map(drop).ok_or(SceneError::NoSuchObject)
    }

    /// Removes all particle objects.
    pub fn remove_all(&mut self) {
        self.has_gone |= !self.by_handle.is_empty();
        self.by_handle.clear();
    }

    pub(in crate::drawing) fn forget_owner(&mut self, owner: i64) {
        let count = self.by_handle.len();
        self.by_handle.retain(|_, object| object.owner != owner);
        self.has_gone |= self.by_handle.len() != count;
    }

    /// What is seen of them, under handles that no script can name.
    pub(in crate::drawing) fn drawn(&self) -> impl Iterator<Item = (i64, &DrawingObject)> {
        let all = self.by_handle.iter();
        all.filter_map(|(handle, object)| Some((-handle, object.drawn()?)))
    }

    /// Draws them where they are; the number of the last change before that is counted on.
    pub(in crate::drawing) fn draw(&mut self, last_change: &mut u64) {
        *last_change += u64::from(std::mem::take(&mut self.has_gone));
        for object in self.by_handle.values_mut() {
            if object.is_stale && object.drawn().is_some() {
                *last_change += 1;
                object.draw(*last_change);
            }
        }
    }
}
