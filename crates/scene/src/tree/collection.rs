//! Collections: sets of objects defined by items to add and subtract, evaluated on each access.

use std::collections::{BTreeMap, BTreeSet};

use bitflags::bitflags;

use crate::{Handle, Scene, SceneError, SceneResult};

/// The first handle of a collection.
const FIRST_HANDLE: i64 = 2_000_000;

bitflags! {
    /// Options of `sim.createCollection`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct CollectionOptions: i64 {
        /// Members count whatever their collidable, measurable and detectable flags say.
        const OVERRIDES = 0x1;
        const _ = !0;
    }
}

bitflags! {
    /// Options of `sim.addItemToCollection`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct ItemOptions: i64 {
        /// The objects are taken out of the collection instead of added.
        const SUBTRACT = 0x1;
        /// The base object itself is left out.
        const EXCLUDE_BASE = 0x2;
        const _ = !0;
    }
}

/// A set of objects that scripts build up (`sim.createCollection`).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Collection {
    /// [`CollectionOptions::OVERRIDES`].
    pub overrides: bool,
    /// The script whose end removes it.
    pub(super) owner: Option<i64>,
    /// The name it had in scenes from before 4.2; empty without one.
    pub name: String,
    /// What is added and subtracted, in this order.
    pub items: Vec<CollectionItem>,
}

/// The objects an item stands for: `sim.handle_all`, `_single`, `_tree` or `_chain`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Members {
    /// All objects.
    All,
    /// One object.
    Single(Handle),
    /// An object and everything below it.
    Tree(Handle),
    /// An object and everything above it.
    Chain(Handle),
}

impl CollectionItem {
    /// An item that adds `members`, or as `options` say.
    pub fn new(members: Members, options: ItemOptions) -> Self {
        let [subtract, exclude_base] =
            [ItemOptions::SUBTRACT, ItemOptions::EXCLUDE_BASE].map(|o| options.contains(o));
        Self {
            members,
            subtract,
            exclude_base,
        }
    }
}

impl Members {
    /// The object the others are found from; all objects need none.
    pub fn base(self) -> Option<Handle> {
        match self {
            Self::All => None,
            Self::Single(base) | Self::Tree(base) | Self::Chain(base) => Some(base),
        }
    }
}

/// One instruction of a collection: what to add or subtract.
#[derive(Debug, Clone, PartialEq)]
pub struct CollectionItem {
    /// The objects that are meant.
    pub members: Members,
    /// They are taken out instead of added.
    pub subtract: bool,
    /// The base itself is left out.
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
    /// Makes an empty collection, which ends with the script `owner`.
    pub fn add(&mut self, overrides: bool, owner: Option<i64>) -> i64 {
        let handle = FIRST_HANDLE + self.made;
        self.made += 1;
        self.by_handle.insert(
            handle,
            Collection {
                overrides,
                owner,
                ..Collection::default()
            },
        );
        handle
    }

    /// The handle of the one with that name.
    pub fn named(&self, name: &str) -> Option<i64> {
        let is_it = |collection: &Collection| !name.is_empty() && collection.name == name;
        self.by_handle
            .iter()
            .find(|(_, collection)| is_it(collection))
            .map(|(handle, _)| *handle)
    }

    /// Names a collection; where the name is taken it gets a number.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn set_name(&mut self, handle: i64, name: String) -> SceneResult<()> {
        self.get(handle)?;
        let name = super::old_names::free_name(name, |name| {
            self.named(name).is_some_and(|other| other != handle)
        });
        self.get_mut(handle)?.name = name;
        Ok(())
    }

    /// Removes all collections.
    pub fn clear(&mut self) {
        self.by_handle.clear();
    }

    /// All, in the order in which they were made.
    pub fn iter(&self) -> impl Iterator<Item = (i64, &Collection)> {
        self.by_handle
            .iter()
            .map(|(handle, collection)| (*handle, collection))
    }

    /// Removes a collection; its objects stay.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn remove(&mut self, handle: i64) -> SceneResult<()> {
        self.by_handle
            .remove(&handle)
            .map(drop)
            .ok_or(SceneError::NoSuchCollection)
    }

    /// The collection with that handle.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn get(&self, handle: i64) -> SceneResult<&Collection> {
        self.by_handle
            .get(&handle)
            .ok_or(SceneError::NoSuchCollection)
    }

    /// The collection with that handle, to be changed.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn get_mut(&mut self, handle: i64) -> SceneResult<&mut Collection> {
        self.by_handle
            .get_mut(&handle)
            .ok_or(SceneError::NoSuchCollection)
    }

    pub(crate) fn forget_owner(&mut self, owner: i64) {
        self.by_handle
            .retain(|_, collection| collection.owner != Some(owner));
    }

    /// Removes items of objects that are removed. Collections of old scenes end with their last one; others are the scripts' that made
    /// them. Returns the handles of those that end.
    pub(super) fn forget(&mut self, removed: &BTreeSet<Handle>) -> BTreeSet<i64> {
        let is_left = |item: &CollectionItem| {
            let base = item.members.base();
            base.is_none_or(|base| !removed.contains(&base))
        };
        let mut ended = BTreeSet::new();
        self.by_handle.retain(|handle, collection| {
            let before = collection.items.len();
            collection.items.retain(is_left);
            let ends = before > 0 && collection.items.is_empty() && !collection.name.is_empty();
            ends.then(|| ended.insert(*handle));
            !ends
        });
        ended
    }
}

impl Scene {
    /// The collections of the scene.
    pub fn collections(&self) -> &Collections {
        &self.collections
    }

    /// The collections of the scene, to be changed.
    pub fn collections_mut(&mut self) -> &mut Collections {
        &mut self.collections
    }

    /// The objects a collection holds now, in the order in which they came to it.
    ///
    /// # Errors
    /// When there is none with that handle.
    pub fn collection_objects(&self, handle: i64) -> SceneResult<Vec<Handle>> {
        let mut members = BTreeMap::new();
        let mut came = 0;
        for item in &self.collections.get(handle)?.items {
            for object in self.item_objects(item) {
                if item.subtract {
                    members.remove(&object);
                } else {
                    members.entry(object).or_insert(came);
                    came += 1;
                }
            }
        }
        let mut in_order: Vec<(usize, Handle)> = members
            .into_iter()
            .map(|(object, came)| (came, object))
            .collect();
        in_order.sort_unstable();
        Ok(in_order.into_iter().map(|(_, object)| object).collect())
    }

    fn item_objects(&self, item: &CollectionItem) -> Vec<Handle> {
        let mut objects: Vec<Handle> = match item.members {
            Members::All => return self.objects().map(crate::Object::handle).collect(),
            Members::Single(object) => vec![object],
            Members::Tree(base) => self.subtree(base),
            Members::Chain(tip) => std::iter::once(tip).chain(self.ancestors(tip)).collect(),
        };
        let base = item.members.base();
        objects
            .retain(|&object| self.exists(object) && !(item.exclude_base && Some(object) == base));
        objects
    }
}
