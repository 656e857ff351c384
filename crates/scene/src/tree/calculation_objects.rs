//! The collision and distance objects of scenes from before 4.2: named pairs of entities, and what was computed of them last. Files
//! contain them; no function makes new ones (spec: sensors 2.1).

use std::collections::{BTreeMap, BTreeSet};

use crate::{Handle, Scene};

/// What collides, if anything does.
pub type CollisionObjects = CalculationObjects<Option<[Handle; 2]>, 2_010_001>;
/// The smallest distance (m), if it is below the threshold.
pub type DistanceObjects = CalculationObjects<Option<f64>, 2_020_002>;

/// A pair of entities with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct CalculationObject<R> {
    /// Unique among the objects of its kind.
    pub name: String,
    /// Stays with it when the scene is saved.
    pub persistent_uid: String,
    /// Handles of objects or collections. The second is `sim.handle_all`'s -2 where everything else is meant.
    pub entities: [i64; 2],
    /// Larger distances do not count, metres; 0 for no limit.
    pub threshold: f64,
    /// Left out when all are handled.
    pub explicit: bool,
    /// Bits of the file whose meaning is not known.
    pub switches: u8,
    /// None before it is handled.
    pub result: Option<R>,
}

/// All objects of one kind, by handles from `FIRST` on.
#[derive(Debug, Clone, Default)]
pub struct CalculationObjects<R, const FIRST: i64> {
    by_handle: BTreeMap<i64, CalculationObject<R>>,
    /// Ever made: no handle is used twice.
    made: i64,
}

impl<R, const FIRST: i64> CalculationObjects<R, FIRST> {
    /// Adds one; where its name is taken it gets a number.
    pub fn add(&mut self, mut object: CalculationObject<R>) -> i64 {
        object.name = super::old_names::free_name(object.name, |name| self.named(name).is_some());
        let handle = FIRST + self.made;
        self.made += 1;
        self.by_handle.insert(handle, object);
        handle
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.by_handle.is_empty()
    }

    /// The handle of the one with that name.
    pub fn named(&self, name: &str) -> Option<i64> {
        self.by_handle
            .iter()
            .find(|(_, object)| object.name == name)
            .map(|(handle, _)| *handle)
    }

    /// The one with that handle.
    pub fn get(&self, handle: i64) -> Option<&CalculationObject<R>> {
        self.by_handle.get(&handle)
    }

    /// The one with that handle, to be changed.
    pub fn get_mut(&mut self, handle: i64) -> Option<&mut CalculationObject<R>> {
        self.by_handle.get_mut(&handle)
    }

    /// With their handles, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = (i64, &CalculationObject<R>)> {
        self.by_handle
            .iter()
            .map(|(handle, object)| (*handle, object))
    }

    /// The handles of all, or of those that are not handled explicitly.
    pub fn handles(&self, with_explicit: bool) -> Vec<i64> {
        self.iter()
            .filter(|(_, object)| with_explicit || !object.explicit)
            .map(|(handle, _)| handle)
            .collect()
    }

    /// Forgets the results of all, or of those that are not handled explicitly.
    pub fn reset(&mut self, with_explicit: bool) {
        let objects = self
            .by_handle
            .values_mut()
            .filter(|object| with_explicit || !object.explicit);
        objects.for_each(|object| object.result = None);
    }

    /// Removes those of an entity that is removed.
    fn forget(&mut self, removed: &BTreeSet<Handle>, collections: &BTreeSet<i64>) {
        let is_removed = |entity: &i64| {
            collections.contains(entity)
                || Handle::from_raw(*entity).is_some_and(|handle| removed.contains(&handle))
        };
        self.by_handle
            .retain(|_, object| !object.entities.iter().any(is_removed));
    }
}

impl Scene {
    /// The collision objects of the scene.
    pub fn collision_objects(&self) -> &CollisionObjects {
        &self.collision_objects
    }

    /// The collision objects of the scene, to be changed.
    pub fn collision_objects_mut(&mut self) -> &mut CollisionObjects {
        &mut self.collision_objects
    }

    /// The distance objects of the scene.
    pub fn distance_objects(&self) -> &DistanceObjects {
        &self.distance_objects
    }

    /// The distance objects of the scene, to be changed.
    pub fn distance_objects_mut(&mut self) -> &mut DistanceObjects {
        &mut self.distance_objects
    }

    /// Removes collision and distance objects of objects and collections that are removed, and results that name objects.
    pub(crate) fn forget_calculations(
        &mut self,
        removed: &BTreeSet<Handle>,
        collections: &BTreeSet<i64>,
    ) {
        self.collision_objects.forget(removed, collections);
        self.distance_objects.forget(removed, collections);
        for object in self.collision_objects.by_handle.values_mut() {
            if object
                .result
                .flatten()
                .is_some_and(|pair| pair.iter().any(|handle| removed.contains(handle)))
            {
                object.result = None;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(name: &str, entities: [i64; 2]) -> CalculationObject<Option<f64>> {
        CalculationObject {
            name: name.into(),
            persistent_uid: String::new(),
            entities,
            threshold: 0.0,
            explicit: false,
            switches: 0,
            result: None,
        }
    }

    #[test]
    fn names_are_unique_and_handles_are_not_used_again() {
        let mut objects = DistanceObjects::default();
        let handles =
            ["gap", "gap", "gap7", "gap7", "gap"].map(|name| objects.add(named(name, [3, -2])));
        assert_eq!(
            handles,
            [2_020_002, 2_020_003, 2_020_004, 2_020_005, 2_020_006]
        );
        let names: Vec<&str> = objects
            .iter()
            .map(|(_, object)| object.name.as_str())
            .collect();
        assert_eq!(names, ["gap", "gap0", "gap7", "gap8", "gap1"]);
        objects.add(named("other", [5, 4]));
        objects.forget(&BTreeSet::from([Handle(3)]), &BTreeSet::new());
        assert_eq!(objects.handles(true), [2_020_007]);
        assert_eq!(objects.add(named("gap", [5, 4])), 2_020_008);
    }
}
