//! Cached world poses: an object's is valid until the object, or one above it, moves.
//!
//! Changes of place are numbered. A change costs one number, written into the object that moved, however much hangs below it; a
//! pose is checked when it is asked for, by the largest number from the object up to its root. That walk ends at the first object
//! that was checked since the last change, so that reading all poses after a change visits each object once.

#[cfg(test)]
pub(crate) mod tests;

use std::cell::{Cell, RefCell};

use geometry::pose::pose_to_array;

use super::measure::Measurements;
use crate::{Handle, Object, Pose, Scene, SceneResult};

/// The changes of place of a scene.
#[derive(Debug, Default)]
pub(crate) struct Moves {
    /// Number of the last one.
    last: u64,
    /// Reused by each walk.
    walk: RefCell<Vec<Handle>>,
    pub(crate) measurements: Measurements,
}

impl Moves {
    /// Notes that `object` may have moved in its parent's frame, or its children in its own.
    pub(crate) fn note(&mut self, object: &mut Object) {
        self.measurements
            .note_move(object.handle, object.place.moved);
        self.last += 1;
        object.place.moved = self.last;
    }

    /// Ends a measurement of velocities, which found these objects in motion.
    pub(crate) fn end_measurement(&mut self, in_motion: Vec<Handle>) {
        self.measurements.end(self.last, in_motion);
    }
}

/// Cached world pose of an object.
#[derive(Clone)]
pub(crate) struct PlaceInWorld {
    /// The last change of its own place.
    moved: u64,
    /// The last change of its place or of one above, as it was found after change `checked`.
    latest: Cell<u64>,
    checked: Cell<u64>,
    /// The pose after change `posed`.
    pose: Cell<Pose>,
    posed: Cell<u64>,
    /// The frame of the children in that of the object, after its own change `intrinsic_of`.
    intrinsic: Cell<Option<Pose>>,
    intrinsic_of: Cell<u64>,
    /// The last measurement of velocities that concerned it.
    pub(in crate::pose) measurement: u64,
}

impl Default for PlaceInWorld {
    /// As of an object of which nothing is known: changes are numbered from 1.
    fn default() -> Self {
        Self {
            moved: 0,
            latest: Cell::new(0),
            checked: Cell::new(0),
            pose: Cell::new(Pose::identity()),
            posed: Cell::new(0),
            intrinsic: Cell::new(None),
            intrinsic_of: Cell::new(u64::MAX),
            measurement: 0,
        }
    }
}

impl std::fmt::Debug for PlaceInWorld {
    /// All of it follows from the scene, and none of it is a property of the object.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("PlaceInWorld")
    }
}

impl Scene {
    /// Pose in the world.
    pub fn world_pose(&self, handle: Handle) -> SceneResult<Pose> {
        let object = self.object(handle)?;
        if object.parent().is_none() {
            return Ok(object.pose());
        }
        let latest = self.latest_move(handle, object)?;
        let place = &object.place;
        if place.posed.get() != latest {
            place.pose.set(self.composed_pose(object)?);
            place.posed.set(latest);
        }
        Ok(place.pose.get())
    }

    /// The last change that moved an object in the world.
    fn latest_move(&self, handle: Handle, object: &Object) -> SceneResult<u64> {
        let now = self.objects.moves().last;
        if object.place.checked.get() == now {
            return Ok(object.place.latest.get());
        }
        let mut walk = self.objects.moves().walk.borrow_mut();
        walk.clear();
        let (mut latest, mut next) = (0, Some(handle));
        while let Some(handle) = next {
            let object = self.object(handle)?;
            if object.place.checked.get() == now {
                latest = object.place.latest.get();
                break;
            }
            walk.push(handle);
            next = object.parent();
        }
        for &handle in walk.iter().rev() {
            let place = &self.object(handle)?.place;
            latest = latest.max(place.moved);
            place.latest.set(latest);
            place.checked.set(now);
        }
        Ok(latest)
    }

    /// The pose from the poses of the object and all above it, from the object upwards: rounding depends on the order. What
    /// [`Scene::world_pose`] keeps equals it bit for bit.
    ///
    /// # Errors
    /// If one of them does not exist.
    pub fn composed_pose(&self, object: &Object) -> SceneResult<Pose> {
        let mut pose = object.pose();
        let mut above = object.parent();
        while let Some(parent) = above {
            let parent = self.object(parent)?;
            if let Some(intrinsic) = parent.cached_intrinsic_pose() {
                pose = intrinsic * pose;
            }
            pose = parent.pose() * pose;
            above = parent.parent();
        }
        Ok(pose)
    }
}

impl Object {
    /// From the object's frame to the frame its children live in, computed once after each change.
    fn cached_intrinsic_pose(&self) -> Option<Pose> {
        let place = &self.place;
        if place.intrinsic_of.replace(place.moved) != place.moved {
            place.intrinsic.set(self.intrinsic_pose());
        }
        place.intrinsic.get()
    }

    /// Local frames that determine the world poses of the object and its descendants, as bits.
    pub(crate) fn frames(&self) -> impl PartialEq + use<> {
        (
            self.parent,
            bits(&self.pose),
            self.intrinsic_pose().as_ref().map(bits),
        )
    }
}

fn bits(pose: &Pose) -> [u64; 7] {
    pose_to_array(pose).map(f64::to_bits)
}
