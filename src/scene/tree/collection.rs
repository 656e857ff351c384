//! Collections: sets of objects defined by items to add and subtract, evaluated on each access.

use std::collections::{BTreeMap, BTreeSet};

use crate::scene::{Handle, Scene, SceneError, SceneResult, special};

/// The first handle of a collection.
const FIRST_HANDLE: i64 = 2_000_000;

/// A set of objects that scripts build up (`sim.createCollection`).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Collection {
    /// Whether checks of the collection against itself count.
    pub overrides: bool,
    pub items: Vec<CollectionItem>,
}

/// One instruction of a collection: what to add or subtract.
#[derive(Debug, Clone, PartialEq)]
pub struct CollectionItem {
    /// `sim.handle_all`, `_single`, `_tree` or `_chain`.
    pub what: i64,
    pub base: Option<Handle>,
    pub subtract: bool,
    pub exclude_base: bool,
}

/// The collections of a scene.
#[derive(Debug, Default)]
pub struct Collections {
    by_handle: BTreeMap<i64, Collection>,
    /// Collections ever made: no handle is used twice.
    made: i64,
}

impl Collections {
    /// Makes an empty collection.
    pub fn add(&mut self, overrides: bool) -> i64 {
        let handle = FIRST_HANDLE + self.made;
        self.made += 1;
        self.by_handle.insert(handle, Collection { overrides, items: Vec::new() });
        handle
    }

    /// Removes a collection; its objects stay.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn remove(&mut self, handle: i64) -> SceneResult<()> {
        self.by_handle.remove(&handle).map(drop).ok_or(SceneError::NoSuchCollection)
    }

    /// # Errors
    /// When there is none with that handle.
    pub fn get(&self, handle: i64) -> SceneResult<&Collection> {
        self.by_handle.get(&handle).ok_or(SceneError::NoSuchCollection)
    }

    /// # Errors
    /// When there is none with that handle.
    pub fn get_mut(&mut self, handle: i64) -> SceneResult<&mut Collection> {
        self.by_handle.get_mut(&handle).ok_or(SceneError::NoSuchCollection)
    }

    pub(super) fn forget(&mut self, doomed: &BTreeSet<Handle>) {
        for collection in self.by_handle.values_mut() {
            collection.items.retain(|item| item.base.is_none_or(|base| !doomed.contains(&base)));
        }
    }
}

impl Scene {
    pub fn collections(&self) -> &Collections {
        &self.collections
    }

    pub fn collections_mut(&mut self) -> &mut Collections {
        &mut self.collections
    }

    /// The objects a collection holds now, in the order of their creation.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn collection_objects(&self, handle: i64) -> SceneResult<Vec<Handle>> {
        let mut members = BTreeSet::new();
        for item in &self.collections.get(handle)?.items {
            for object in self.item_objects(item) {
                if item.subtract {
                    members.remove(&object);
                } else {
                    members.insert(object);
                }
            }
        }
        let in_order = self.objects().map(crate::scene::Object::handle);
        Ok(in_order.filter(|handle| members.contains(handle)).collect())
    }

    fn item_objects(&self, item: &CollectionItem) -> Vec<Handle> {
        let Some(base) = item.base else { return self.objects().map(crate::scene::Object::handle).collect() };
        let mut objects = match item.what {
            special::TREE => self.subtree(base),
            special::CHAIN => std::iter::once(base).chain(self.ancestors(base)).collect(),
            _ => vec![base],
        };
        objects.retain(|&object| self.exists(object) && !(item.exclude_base && object == base));
        objects
    }
}
