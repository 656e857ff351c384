//! Cached world poses: an object's is valid until the object, or one above it, moves.
//!
//! Changes of place are numbered. A change costs one number, written into the object that moved, however much hangs below it; a
//! pose is checked when it is asked for, by the largest number from the object up to its root. That walk ends at the first object
//! that was checked since something moved that others hang on, so that reading all poses after a change visits each object once.
//!
//! Poses are composed from the object upwards. In trees deeper than [`STRETCH`], every object at a multiple of that depth ends a
//! stretch: its own pose in the world, which is kept, stands for all above it.

#[cfg(test)]
pub(crate) mod tests;

use std::cell::{Cell, RefCell};

use geometry::pose::pose_to_array;

use super::measure::Measurements;
use crate::{Handle, Object, Pose, Scene, SceneResult};

/// How many poses are composed at most for one pose in the world. Scenes of real robots are not as deep.
const STRETCH: u32 = 64;

/// The changes of place of a scene.
#[derive(Debug, Default)]
pub(crate) struct Moves {
    /// Number of the last one.
    last: u64,
    /// Number of the last one of an object with children. Later ones moved nothing but the objects themselves.
    last_with_children: u64,
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
        if !object.children().is_empty() {
            self.last_with_children = self.last;
        }
    }

    /// Whether neither the object nor one above it moved since it was checked.
    fn is_checked(&self, place: &PlaceInWorld) -> bool {
        let checked = place.checked.get();
        checked >= self.last_with_children && checked >= place.moved
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
    /// How many objects were above it then.
    depth: Cell<u32>,
    /// The pose after change `posed`.
    pose: Cell<Pose>,
    posed: Cell<u64>,
    /// The frame of the children in that of the object, after its own change `intrinsic_of`.
    intrinsic: Cell<Option<Pose>>,
    intrinsic_of: Cell<u64>,
    /// The last measurement of velocities that concerned it.
    pub(in crate::pose) measurement: u64,
}

impl PlaceInWorld {
    /// Whether the pose of an object that was checked is up to date.
    fn is_posed(&self) -> bool {
        self.posed == self.latest
    }

    /// Keeps the pose of an object that was checked.
    fn keep(&self, pose: Pose) {
        self.pose.set(pose);
        self.posed.set(self.latest.get());
    }
}

impl Default for PlaceInWorld {
    /// As of an object of which nothing is known: changes are numbered from 1.
    fn default() -> Self {
        Self {
            moved: 0,
            latest: Cell::new(0),
            checked: Cell::new(0),
            depth: Cell::new(0),
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
        self.find_latest_move(handle, object)?;
        if !object.place.is_posed() {
            self.compose_stretches(object)?;
        }
        Ok(object.place.pose.get())
    }

    /// Finds the last change that moved an object in the world, and how many objects are above it.
    fn find_latest_move(&self, handle: Handle, object: &Object) -> SceneResult<()> {
        let moves = self.objects.moves();
        if moves.is_checked(&object.place) {
            return Ok(());
        }
        let mut walk = moves.walk.borrow_mut();
        walk.clear();
        let (mut latest, mut depth, mut next) = (0, 0, Some(handle));
        while let Some(handle) = next {
            let object = self.object(handle)?;
            if moves.is_checked(&object.place) {
                latest = object.place.latest.get();
                depth = object.place.depth.get() + 1;
                break;
            }
            walk.push(handle);
            next = object.parent();
        }
        for &handle in walk.iter().rev() {
            let place = &self.object(handle)?.place;
            latest = latest.max(place.moved);
            place.latest.set(latest);
            place.depth.set(depth);
            place.checked.set(moves.last);
            depth += 1;
        }
        Ok(())
    }

    /// Computes the pose of an object that was checked, after those at the ends of stretches above it that are out of date.
    fn compose_stretches(&self, object: &Object) -> SceneResult<()> {
        let mut waiting = Vec::new();
        let mut at = object;
        let (mut pose, mut end) = self.pose_in_stretch(at, at.place.depth.get())?;
        while let Some(above) = end
            && !above.place.is_posed()
        {
            waiting.push((at, pose, above));
            at = above;
            (pose, end) = self.pose_in_stretch(at, at.place.depth.get())?;
        }
        let in_world = |pose, end: &Object| end.full_pose(end.place.pose.get()) * pose;
        at.place.keep(end.map_or(pose, |end| in_world(pose, end)));
        for (object, pose, end) in waiting.into_iter().rev() {
            object.place.keep(in_world(pose, end));
        }
        Ok(())
    }

    /// The pose computed without any that is kept. [`Scene::world_pose`] equals it bit for bit.
    ///
    /// # Errors
    /// If one of the objects above does not exist.
    pub fn composed_pose(&self, object: &Object) -> SceneResult<Pose> {
        let above = self.ancestors(object.handle());
        let depth = above.fold(0, |depth, _| depth + 1);
        Ok(match self.pose_in_stretch(object, depth)? {
            (pose, Some(end)) => end.full_pose(self.composed_pose(end)?) * pose,
            (pose, None) => pose,
        })
    }

    /// The pose of an object at a depth, composed upwards, in the frame of the children of the object that ends its stretch, or in
    /// the world.
    fn pose_in_stretch(
        &self,
        object: &Object,
        mut depth: u32,
    ) -> SceneResult<(Pose, Option<&Object>)> {
        let mut pose = object.pose();
        let mut above = object.parent();
        while let Some(parent) = above {
            let parent = self.object(parent)?;
            depth -= 1;
            if depth > 0 && depth.is_multiple_of(STRETCH) {
                return Ok((pose, Some(parent)));
            }
            if let Some(intrinsic) = parent.cached_intrinsic_pose() {
                pose = intrinsic * pose;
            }
            pose = parent.pose() * pose;
            above = parent.parent();
        }
        Ok((pose, None))
    }
}

impl Object {
    /// The frame the children live in, of an object with this pose.
    fn full_pose(&self, pose: Pose) -> Pose {
        match self.cached_intrinsic_pose() {
            Some(intrinsic) => pose * intrinsic,
            None => pose,
        }
    }

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
