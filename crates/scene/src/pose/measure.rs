//! Measured velocities: how fast objects moved in the world, from one measurement to the next (spec: poses 4).
//!
//! Only objects that moved since the last measurement, or were in motion at it, are measured: in most steps most objects rest.

use crate::{Change, Field, Handle, MeasuredVelocity, Object, Pose, Scene, Topic, Uid};

/// So many objects are listed at most; for more it is as fast to measure all of them.
const MAX_LISTED: usize = 1 << 16;

/// Which objects the next measurement concerns: those listed here, or all of them.
#[derive(Debug, Default)]
pub(crate) struct Measurements {
    /// Whether every object was measured, and what moved since is listed.
    complete: bool,
    /// How many measurements there were.
    count: u64,
    /// Number of the last change of place before the last measurement.
    last_move: u64,
    /// Objects whose own place changed since, each once.
    moved: Vec<Handle>,
    /// Objects that moved between the last two measurements.
    in_motion: Vec<Handle>,
}

impl Measurements {
    /// Notes a change of the place of an object, whose last one before had the number `previous`.
    pub(crate) fn note_move(&mut self, handle: Handle, previous: u64) {
        if self.complete && previous <= self.last_move {
            self.moved.push(handle);
            self.complete = self.moved.len() < MAX_LISTED;
        }
    }

    /// The next measurement concerns all objects.
    pub(crate) fn forget(&mut self) {
        self.complete = false;
    }

    /// The lists of the objects that the next measurement concerns: those that moved with all below them, and those that stand for
    /// themselves. None for all objects.
    pub(crate) fn begin(&mut self) -> Option<(Vec<Handle>, Vec<Handle>)> {
        self.count += 1;
        let (moved, in_motion) = (
            std::mem::take(&mut self.moved),
            std::mem::take(&mut self.in_motion),
        );
        self.complete.then_some((moved, in_motion))
    }

    /// Whether the object is met for the first time in this measurement.
    pub(crate) fn is_first(&self, object: &mut Object) -> bool {
        std::mem::replace(&mut object.place.measurement, self.count) != self.count
    }

    /// Ends a measurement, after the change of place number `last_move`.
    pub(crate) fn end(&mut self, last_move: u64, in_motion: Vec<Handle>) {
        (self.complete, self.last_move, self.in_motion) = (true, last_move, in_motion);
    }
}

impl Scene {
    /// Measures how fast every object moved since the last call, `dt` seconds ago. Without `dt` measuring begins.
    pub fn measure_velocities(&mut self, dt: Option<f64>) {
        if dt.is_none() {
            self.objects.moves_mut().measurements.forget();
        }
        let is_followed = self.journal().is_followed(Topic::Field(Field::Measured));
        let mut in_motion = Vec::new();
        for handle in self.objects_to_measure() {
            let Ok(now) = self.world_pose(handle) else {
                continue;
            };
            let Ok(object) = self.object_in_place(handle) else {
                continue;
            };
            let now = measured(object.measured.previous, now, dt);
            let before = std::mem::replace(&mut object.measured, now);
            if before.previous != object.measured.previous {
                in_motion.push(handle);
            }
            if is_followed && !object.measured.same_velocity(&before) {
                self.note(Change::Modified(handle, Field::Measured));
            }
        }
        self.objects.moves_mut().end_measurement(in_motion);
    }

    /// Objects that may have moved since the last measurement or were in motion at it, in the order of their creation.
    fn objects_to_measure(&mut self) -> Vec<Handle> {
        let Some((mut pending, in_motion)) = self.objects.moves_mut().measurements.begin() else {
            return self.objects().map(Object::handle).collect();
        };
        let mut found: Vec<(Uid, Handle)> = Vec::new();
        while let Some(handle) = pending.pop() {
            if let Some(object) = self.objects.not_yet_measured(handle) {
                found.push((object.uid, handle));
                pending.extend_from_slice(&object.children);
            }
        }
        for handle in in_motion {
            found.extend(
                self.objects
                    .not_yet_measured(handle)
                    .map(|object| (object.uid, handle)),
            );
        }
        found.sort_unstable();
        found.into_iter().map(|(_, handle)| handle).collect()
    }
}

/// The motion over one step (spec: poses 4).
pub(super) fn measured(previous: Option<Pose>, now: Pose, dt: Option<f64>) -> MeasuredVelocity {
    let from = previous.zip(dt).filter(|(before, _)| *before != now);
    MeasuredVelocity {
        previous: Some(now),
        from,
    }
}
