//! The drawing objects of a scene.

use std::collections::{BTreeMap, BTreeSet};

use super::particles::Particles;
use super::{DrawingObject, DrawingStyle};
use crate::{Handle, Scene, SceneError, SceneResult};

/// Drawing objects by handle. Handles count from 1 and are not used twice.
#[derive(Debug, Default)]
pub struct Drawings {
    by_handle: BTreeMap<i64, DrawingObject>,
    created: i64,
    particles: Particles,
    /// Number of the last change: those who copy drawing objects compare it with what they saw.
    last_change: u64,
}

impl Drawings {
    /// The drawing objects with their handles, in the order of their creation; then what is drawn of particles, with negative handles.
    pub fn iter(&self) -> impl Iterator<Item = (i64, &DrawingObject)> {
        self.by_handle
            .iter()
            .map(|(handle, drawing)| (*handle, drawing))
            .chain(self.particles.drawn())
    }

    /// The particle objects.
    pub fn particles(&self) -> &Particles {
        &self.particles
    }

    /// The particle objects, to emit and to move particles; [`draw_particles`](Self::draw_particles) shows the change.
    pub fn particles_mut(&mut self) -> &mut Particles {
        &mut self.particles
    }

    /// Draws the particles where they are.
    pub fn draw_particles(&mut self) {
        self.particles.draw(&mut self.last_change);
    }

    /// Removes the particles, at the end of a simulation.
    pub(crate) fn clear_particles(&mut self) {
        self.particles.iter_mut().for_each(|object| object.clear());
        self.draw_particles();
    }

    /// The drawing object with that handle.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn get(&self, handle: i64) -> SceneResult<&DrawingObject> {
        self.by_handle.get(&handle).ok_or(SceneError::NoSuchObject)
    }

    /// Number of the last change of any of them; see [`DrawingObject::changed_at`].
    pub fn last_change(&self) -> u64 {
        self.last_change
    }

    /// One of them, which is about to change.
    fn get_mut(&mut self, handle: i64) -> SceneResult<&mut DrawingObject> {
        let drawing = self
            .by_handle
            .get_mut(&handle)
            .ok_or(SceneError::NoSuchObject)?;
        self.last_change += 1;
        drawing.changed_at = self.last_change;
        Ok(drawing)
    }

    /// Removes all items of a drawing object.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn clear(&mut self, handle: i64) -> SceneResult<()> {
        self.get_mut(handle).map(DrawingObject::clear)
    }

    /// Removes a drawing object.
    ///
    /// # Errors
    /// When there is no drawing object with that handle.
    pub fn remove(&mut self, handle: i64) -> SceneResult<()> {
        self.last_change += 1;
        self.by_handle
            .remove(&handle)
            .map(drop)
            .ok_or(SceneError::NoSuchObject)
    }

    /// Removes all drawing objects.
    pub fn remove_all(&mut self) {
        self.last_change += 1;
        self.by_handle.clear();
    }

    /// Removes those that move with objects which are being removed.
    pub(crate) fn forget(&mut self, doomed: &BTreeSet<Handle>) {
        self.last_change += 1;
        self.by_handle.retain(|_, drawing| {
            drawing
                .style
                .parent
                .is_none_or(|parent| !doomed.contains(&parent))
        });
    }

    pub(crate) fn forget_owner(&mut self, owner: i64) {
        self.last_change += 1;
        self.by_handle
            .retain(|_, drawing| drawing.owner != Some(owner));
        self.particles.forget_owner(owner);
    }
}

impl Scene {
    /// The drawing objects of the scene.
    pub fn drawings(&self) -> &Drawings {
        &self.drawings
    }

    /// The drawing objects, to clear or remove them.
    pub fn drawings_mut(&mut self) -> &mut Drawings {
        &mut self.drawings
    }

    /// Adds an empty drawing object; without the persistent flag it ends with the script `owner`.
    ///
    /// # Errors
    /// When its parent does not exist.
    pub fn add_drawing(&mut self, style: DrawingStyle, owner: Option<i64>) -> SceneResult<i64> {
        if let Some(parent) = style.parent {
            self.object(parent)?;
        }
        self.drawings.created += 1;
        self.drawings.last_change += 1;
        let handle = self.drawings.created;
        let drawing = DrawingObject {
            changed_at: self.drawings.last_change,
            ..DrawingObject::new(style, owner)
        };
        self.drawings.by_handle.insert(handle, drawing);
        Ok(handle)
    }

    /// Adds items, whose numbers are one after the other, until one of them is refused for want of room; returns how many were stored.
    ///
    /// # Errors
    /// When there is no drawing object with that handle.
    pub fn add_drawing_items(&mut self, handle: i64, numbers: &[f64]) -> SceneResult<usize> {
        let parent = self.drawings.get(handle)?.style.parent;
        let frame = parent.map_or(Ok(super::Pose::identity()), |parent| {
            self.world_pose(parent)
        })?;
        let drawing = self.drawings.get_mut(handle)?;
        Ok(numbers
            .chunks(drawing.item_len())
            .filter(|item| drawing.add(item, &frame))
            .count())
    }

    /// Removes what ends with the script `owner`: its collections, and its drawing objects that are not persistent.
    pub fn forget_owner(&mut self, owner: i64) {
        self.collections.forget_owner(owner);
        self.drawings.forget_owner(owner);
    }
}
