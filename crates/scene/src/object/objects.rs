//! The objects of a scene by handle and by identifier.
//!
//! An object can only be changed by way of [`get_mut`](Objects::get_mut), after which all that hangs on it is taken to have moved, or
//! [`get_in_place`](Objects::get_in_place), for changes that move nothing. So no cached world pose is out of date.

use super::{Kind, Object};
use crate::joint::Joint;
use crate::pose::world::{Moves, PlaceInWorld};
use crate::values::numbered::Numbered;
use crate::{Handle, SceneError, SceneResult, Uid};

#[derive(Debug, Default)]
pub(crate) struct Objects {
    slots: Vec<Option<Box<Object>>>,
    live: usize,
    next_handle: u32,
    by_uid: Numbered<Handle>,
    /// The same for each type, at its number.
    by_type: [Numbered<Handle>; TYPES],
    moves: Moves,
}

/// All `sim.sceneobject_*` are below.
const TYPES: usize = 18;
const JOINT: usize = 1;
const PROXIMITY_SENSOR: usize = 5;
const PATH: usize = 8;
const VISION_SENSOR: usize = 9;

impl Objects {
    /// Handles rise and start over at the end of the range, so that a freed one is not met again soon.
    ///
    /// # Errors
    /// When all are in use.
    pub(crate) fn free_handle(&mut self) -> SceneResult<Handle> {
        if self.live >= Handle::END as usize {
            return Err(SceneError::TooManyObjects);
        }
        loop {
            let handle = Handle(self.next_handle);
            self.next_handle = (self.next_handle + 1) % Handle::END;
            if self.get(handle).is_err() {
                return Ok(handle);
            }
        }
    }

    /// Puts an object where its handle says, which was free.
    pub(crate) fn insert(&mut self, mut object: Object) {
        let (handle, index) = (object.handle, object.handle.index());
        if index >= self.slots.len() {
            self.slots.resize_with(index + 1, || None);
        }
        object.place = PlaceInWorld::default();
        self.moves.note(&mut object);
        self.live += 1;
        self.by_uid.push(object.uid, handle);
        self.of_type_mut(&object.kind).push(object.uid, handle);
        self.slots[index] = Some(Box::new(object));
    }

    pub(crate) fn remove(&mut self, handle: Handle) -> Option<Box<Object>> {
        let object = self.slots.get_mut(handle.index()).and_then(Option::take)?;
        self.live -= 1;
        self.by_uid.remove(object.uid);
        self.of_type_mut(&object.kind).remove(object.uid);
        Some(object)
    }

    pub(crate) fn get(&self, handle: Handle) -> SceneResult<&Object> {
        self.slots
            .get(handle.index())
            .and_then(Option::as_deref)
            .ok_or(SceneError::NoSuchObject)
    }

    /// An object to be changed in any way.
    pub(crate) fn get_mut(&mut self, handle: Handle) -> SceneResult<&mut Object> {
        let object = slot_mut(&mut self.slots, handle)?;
        self.moves.note(object);
        Ok(object)
    }

    /// An object to be changed in a way that moves neither it nor what hangs on it.
    pub(crate) fn get_in_place(&mut self, handle: Handle) -> SceneResult<&mut Object> {
        slot_mut(&mut self.slots, handle)
    }

    /// All objects in the order of their creation.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Object> {
        self.by_uid
            .values()
            .filter_map(|&handle| self.get(handle).ok())
    }

    /// All joints in the order of their creation.
    pub(crate) fn joints(&self) -> impl Iterator<Item = (Handle, &Joint)> {
        self.by_type[JOINT]
            .values()
            .filter_map(|&handle| Some((handle, self.get(handle).ok()?.joint().ok()?)))
    }

    /// All paths in the order of their creation.
    pub(crate) fn paths(&self) -> impl Iterator<Item = Handle> {
        self.by_type[PATH].values().copied()
    }

    pub(crate) fn by_uid(&self, uid: Uid) -> Option<Handle> {
        self.by_uid.get(uid).copied()
    }

    pub(crate) fn len(&self) -> usize {
        self.live
    }

    pub(crate) fn has_sensors(&self) -> bool {
        let sensors = [PROXIMITY_SENSOR, VISION_SENSOR];
        sensors
            .iter()
            .any(|&sensor| !self.by_type[sensor].is_empty())
    }

    /// The object at a position in the order of creation, of those of a type or of all (None).
    pub(crate) fn nth(&self, object_type: Option<usize>, position: usize) -> Option<Handle> {
        let objects = match object_type {
            None => &self.by_uid,
            Some(object_type) => self.by_type.get(object_type)?,
        };
        objects.nth(position).copied()
    }

    fn of_type_mut(&mut self, kind: &Kind) -> &mut Numbered<Handle> {
        &mut self.by_type[kind.type_number() as usize]
    }

    /// The object, unless the measurement of velocities in progress has met it before.
    pub(crate) fn not_yet_measured(&mut self, handle: Handle) -> Option<&Object> {
        let object = slot_mut(&mut self.slots, handle).ok()?;
        self.moves.measurements.is_first(object).then_some(object)
    }

    pub(crate) fn moves_mut(&mut self) -> &mut Moves {
        &mut self.moves
    }

    /// The changes of place so far.
    pub(crate) fn moves(&self) -> &Moves {
        &self.moves
    }

    /// The next new object gets this handle, if it is free.
    #[cfg(test)]
    pub(crate) fn start_handles_at(&mut self, handle: Handle) {
        self.next_handle = handle.0;
    }
}

fn slot_mut(slots: &mut [Option<Box<Object>>], handle: Handle) -> SceneResult<&mut Object> {
    slots
        .get_mut(handle.index())
        .and_then(Option::as_deref_mut)
        .ok_or(SceneError::NoSuchObject)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::object::dummy::Dummy;

    fn add(store: &mut Objects) -> SceneResult<Handle> {
        let handle = store.free_handle()?;
        store.insert(Object::new(
            handle,
            0,
            "dummy",
            Kind::Dummy(Dummy::new(0.01)),
        ));
        Ok(handle)
    }

    #[test]
    fn handles_start_over_at_the_end_and_skip_those_in_use() {
        let mut store = Objects::default();
        assert_eq!(add(&mut store), Ok(Handle(0)));
        store.next_handle = Handle::END - 1;
        assert_eq!(add(&mut store), Ok(Handle(Handle::END - 1)));
        assert_eq!(add(&mut store), Ok(Handle(1)));
    }

    #[test]
    fn a_full_store_says_so() {
        let mut store = Objects {
            live: Handle::END as usize,
            ..Objects::default()
        };
        assert_eq!(add(&mut store), Err(SceneError::TooManyObjects));
    }
}
