//! What the journal says since the last time.

use std::collections::BTreeSet;

use super::slots::Slots;
use super::stored::Stored;
use scene::journal::Changes;
use scene::{Change, Cursor, Field, Handle, Object, Scene, Topic, Topics, Uid, Unread};

/// The hashes of one object.
pub(super) struct Tracked {
    pub uid: Uid,
    pub slots: &'static Slots,
    /// One for each slot.
    pub values: Box<[u64]>,
    /// What changed since the last time.
    pub changes: Topics,
}

impl Tracked {
    pub(super) fn new(object: &Object) -> Self {
        let slots = Slots::of_kind(&object.kind);
        Self {
            uid: object.uid(),
            slots,
            values: vec![0; slots.slots.len()].into(),
            changes: Topics::NONE,
        }
    }
}

/// The objects that are followed, by handle.
#[derive(Default)]
pub(super) struct Followed(Vec<Option<Box<Tracked>>>);

impl Followed {
    pub(super) fn get(&mut self, handle: Handle) -> Option<&mut Tracked> {
        self.0.get_mut(place(handle))?.as_deref_mut()
    }

    /// Follows another object, which is looked at as a whole.
    pub(super) fn add(&mut self, object: &Object) {
        let place = place(object.handle());
        if self.0.len() <= place {
            self.0.resize_with(place + 1, || None);
        }
        let tracked = self.0[place].get_or_insert_with(|| Box::new(Tracked::new(object)));
        tracked.changes = Topics::ALL;
    }

    pub(super) fn remove(&mut self, handle: Handle) -> Option<Box<Tracked>> {
        self.0.get_mut(place(handle)).and_then(Option::take)
    }

    pub(super) fn handles(&self) -> impl Iterator<Item = Handle> {
        let places = (0..).zip(&self.0);
        places.filter_map(|(place, tracked)| tracked.as_ref().map(|_| Handle(place)))
    }
}

fn place(handle: Handle) -> usize {
    handle.0 as usize
}

/// What is to be looked at again.
#[derive(Default)]
pub(super) struct News {
    /// Everything: the reader is new, or too far behind.
    pub everything: bool,
    /// Parents and orders of children.
    pub tree: bool,
    /// Objects that refer to others: one is gone.
    pub removals: bool,
    pub settings: bool,
    pub selection: bool,
    /// Objects that came or went.
    pub new: BTreeSet<Handle>,
    /// Followed objects with other changes.
    pub modified: Vec<Handle>,
    pub stored: BTreeSet<Stored>,
}

impl News {
    pub(super) fn read(scene: &Scene, cursor: &mut Cursor, followed: &mut Followed) -> Self {
        let mut news = Self::default();
        match scene.journal().read(cursor) {
            Unread::Everything => news.everything = true,
            Unread::Changes(changes) => news.take(changes, followed),
        }
        news
    }

    fn take(&mut self, changes: Changes<'_>, followed: &mut Followed) {
        for change in changes {
            match change {
                Change::Modified(handle, field) => self.take_modified(*handle, *field, followed),
                Change::Added(handle) => {
                    self.tree = true;
                    self.new.insert(*handle);
                }
                Change::Removed(handle, _) => {
                    (self.tree, self.removals) = (true, true);
                    self.new.insert(*handle);
                }
                Change::Selection => self.selection = true,
                Change::Settings => self.settings = true,
                Change::Stored {
                    holder,
                    namespace,
                    name,
                } => {
                    self.stored.insert((*holder, *namespace, name.clone()));
                }
            }
        }
    }

    fn take_modified(&mut self, handle: Handle, field: Field, followed: &mut Followed) {
        self.tree |= field == Field::Parent;
        // Others have just come, and are looked at as a whole.
        let Some(tracked) = followed.get(handle) else {
            return;
        };
        if tracked.changes.is_empty() {
            self.modified.push(handle);
        }
        tracked.changes = tracked.changes.with(Topic::Field(field));
    }
}
