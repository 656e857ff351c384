//! What belongs to objects without being one: collections, groups of inverse kinematics, and collision and distance objects of old
//! scenes. They have names from before aliases, and are copied with the objects that they are about.

use std::collections::BTreeMap;

use super::calculation_objects::CalculationObject;
use super::collection::{Collection, CollectionItem, Members};
use super::ik_groups::{IkElement, IkGroup};
use super::old_names::{suffix, with_suffix};
use crate::object::viewers::Viewers;
use crate::sensor::Entity;
use crate::{Handle, Object, Scene, SceneResult, special};

/// A kind of companion; each has names of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Companion {
    /// [`Collection`]
    Collection,
    /// [`IkGroup`]
    IkGroup,
    /// Two entities that may collide.
    Collision,
    /// Two entities with a distance.
    Distance,
}

/// From originals to their copies.
type Copies = BTreeMap<Handle, Handle>;

/// Copies of companions of copied objects, without their new names.
pub(super) struct CopiedCompanions {
    /// With the handles of the originals.
    collections: Vec<(i64, Collection)>,
    ik_groups: Vec<IkGroup>,
    collisions: Vec<CalculationObject<Option<[Handle; 2]>>>,
    distances: Vec<CalculationObject<Option<f64>>>,
}

impl Scene {
    /// Whether a companion of that kind has that name.
    pub(super) fn is_companion(&self, kind: Companion, name: &str) -> bool {
        match kind {
            Companion::Collection => self.collections.named(name),
            Companion::IkGroup => self.ik_groups.named(name),
            Companion::Collision => self.collision_objects.named(name),
            Companion::Distance => self.distance_objects.named(name),
        }
        .is_some()
    }

    /// What is copied with objects: companions all of whose objects are copied.
    pub(super) fn companions_of(&self, copies: &Copies) -> CopiedCompanions {
        let collections = self.collections.iter().filter_map(|(handle, collection)| {
            Some((handle, copied_collection(collection, copies)?))
        });
        let collections: Vec<_> = collections.collect();
        let is_copied = |entity: i64| collections.iter().any(|(handle, _)| *handle == entity);
        let entity = |entity: i64| match Handle::from_raw(entity) {
            // Numbers of collections are exchanged once the copies have some.
            _ if is_copied(entity) || entity == special::ALL => Some(entity),
            handle => Some(copies.get(&handle?)?.raw()),
        };
        CopiedCompanions {
            ik_groups: (self.ik_groups.iter())
                .filter_map(|(_, group)| copied_group(group, copies))
                .collect(),
            collisions: (self.collision_objects.iter())
                .filter_map(|(_, object)| copied_pair(object, entity))
                .collect(),
            distances: (self.distance_objects.iter())
                .filter_map(|(_, object)| copied_pair(object, entity))
                .collect(),
            collections,
        }
    }

    /// Adds copies of companions with the suffixes that objects with the same suffixes got. Sensors among the copied objects, and those
    /// who see them, keep to the copied collections.
    ///
    /// # Errors
    /// When an object does not exist.
    pub(super) fn add_companions(
        &mut self,
        companions: CopiedCompanions,
        numbers: &BTreeMap<i64, i64>,
        copies: &Copies,
    ) -> SceneResult<()> {
        let collections = self.add_collections(companions.collections, numbers)?;
        for mut group in companions.ik_groups {
            group.name = numbered(group.name, numbers);
            self.ik_groups.add(group);
        }
        for pair in companions.collisions {
            let pair = placed(pair, &collections, numbers);
            self.collision_objects.add(pair);
        }
        for pair in companions.distances {
            let pair = placed(pair, &collections, numbers);
            self.distance_objects.add(pair);
        }
        if collections.is_empty() {
            return Ok(());
        }
        copies.values().try_for_each(|copy| {
            self.modify(*copy, crate::Field::Other, |object| {
                follow(object, &collections);
            })
        })
    }

    /// Returns the handles of the copies by those of the originals.
    fn add_collections(
        &mut self,
        copies: Vec<(i64, Collection)>,
        numbers: &BTreeMap<i64, i64>,
    ) -> SceneResult<BTreeMap<i64, i64>> {
        let mut added = BTreeMap::new();
        for (original, mut copy) in copies {
            let name = numbered(std::mem::take(&mut copy.name), numbers);
            let handle = self.collections.add(copy.overrides, None);
            *self.collections.get_mut(handle)? = copy;
            self.collections.set_name(handle, name)?;
            added.insert(original, handle);
        }
        Ok(added)
    }
}

impl CopiedCompanions {
    /// The names of the originals.
    pub(super) fn names(&self) -> Vec<(Companion, String)> {
        let collections = self.collections.iter().map(|(_, copy)| &copy.name);
        let all = collections
            .map(|name| (Companion::Collection, name))
            .chain((self.ik_groups.iter()).map(|copy| (Companion::IkGroup, &copy.name)))
            .chain((self.collisions.iter()).map(|copy| (Companion::Collision, &copy.name)))
            .chain((self.distances.iter()).map(|copy| (Companion::Distance, &copy.name)));
        all.map(|(kind, name)| (kind, name.clone())).collect()
    }
}

/// A name with the suffix that those with its suffix get.
fn numbered(name: String, numbers: &BTreeMap<i64, i64>) -> String {
    let (own, stem) = suffix(&name);
    match numbers.get(&own) {
        Some(number) => with_suffix(stem, *number),
        None => name,
    }
}

/// None for one that scripts have made, which is theirs, and for one that is about other objects too.
fn copied_collection(collection: &Collection, copies: &Copies) -> Option<Collection> {
    if collection.name.is_empty() || collection.items.is_empty() {
        return None;
    }
    let copy_of = |base: Handle| copies.get(&base).copied();
    let item = |item: &CollectionItem| {
        let members = match item.members {
            Members::All => return None,
            Members::Single(base) => Members::Single(copy_of(base)?),
            Members::Tree(base) => Members::Tree(copy_of(base)?),
            Members::Chain(base) => Members::Chain(copy_of(base)?),
        };
        Some(CollectionItem {
            members,
            ..item.clone()
        })
    };
    Some(Collection {
        items: collection.items.iter().map(item).collect::<Option<_>>()?,
        ..collection.clone()
    })
}

/// None where a tip is not copied. A base that is not copied gives way to the world.
fn copied_group(group: &IkGroup, copies: &Copies) -> Option<IkGroup> {
    let copy_of = |object: Handle| copies.get(&object).copied();
    let element = |element: &IkElement| {
        Some(IkElement {
            tip: copy_of(element.tip)?,
            base: element.base.and_then(copy_of),
            constraint_base: element.constraint_base.and_then(copy_of),
            ..element.clone()
        })
    };
    if group.elements.is_empty() {
        return None;
    }
    Some(IkGroup {
        persistent_uid: String::new(),
        elements: group.elements.iter().map(element).collect::<Option<_>>()?,
        jacobian: None,
        ..group.clone()
    })
}

/// None where an entity is not copied.
fn copied_pair<R: Clone>(
    pair: &CalculationObject<R>,
    copy_of: impl Fn(i64) -> Option<i64>,
) -> Option<CalculationObject<R>> {
    let [first, second] = pair.entities;
    Some(CalculationObject {
        persistent_uid: String::new(),
        entities: [copy_of(first)?, copy_of(second)?],
        result: None,
        ..pair.clone()
    })
}

fn placed<R>(
    mut pair: CalculationObject<R>,
    collections: &BTreeMap<i64, i64>,
    numbers: &BTreeMap<i64, i64>,
) -> CalculationObject<R> {
    pair.name = numbered(pair.name, numbers);
    pair.entities = pair
        .entities
        .map(|entity| collections.get(&entity).copied().unwrap_or(entity));
    pair
}

/// What a copied object detects or is seen by becomes the copy of a collection.
fn follow(object: &mut Object, collections: &BTreeMap<i64, i64>) {
    let copy_of = |entity: Entity| {
        let copy = collections.get(&entity.raw());
        copy.map_or(entity, |copy| Entity::from_raw(*copy))
    };
    if let Ok(sensor) = object.proximity_sensor_mut() {
        sensor.entity = copy_of(sensor.entity);
    } else if let Ok(sensor) = object.vision_sensor_mut() {
        sensor.entity = copy_of(sensor.entity);
    }
    if let Viewers::Collection(collection) = &mut object.viewers {
        *collection = collections.get(collection).copied().unwrap_or(*collection);
    }
}

#[cfg(test)]
mod tests;
