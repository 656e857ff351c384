//! The hashes of all values, their sum, and how they follow the scene.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::bytes::{Bytes, Key64};
use super::news::{Followed, News};
use super::slots::{GENERAL, Slots};
use super::stored::{Stored, all_names, names_of_object, shown, target_of, with_values};
use super::unrecorded::TrackedScript;
use crate::host::Sim;
use scene::{Cursor, Handle, Holder, Namespace, Object, Scene, Topics, special};

/// A value whose hash is another one now.
#[derive(Debug, Clone, Copy)]
pub struct ChangedValue<'a> {
    /// Who has it, as scripts know it: handle of an object or script, `sim.handle_scene` or `sim.handle_app`.
    pub target: i64,
    /// The property, or what the value is.
    pub name: &'a str,
    /// Hash of the value; 0 where there is none any more.
    pub hash: u64,
}

/// Takes changed values.
pub(super) type Sink<'a> = &'a mut dyn FnMut(ChangedValue<'_>);

/// The hashes of all values that scripts can observe.
#[derive(Default)]
pub(super) struct Hashes {
    cursor: Option<Cursor>,
    pub(super) sum: Sum,
    pub(super) bytes: Bytes,
    followed: Followed,
    scene: Vec<u64>,
    stored: BTreeMap<Stored, u64>,
    /// What is hashed as one.
    singles: BTreeMap<(i64, &'static str), u64>,
    /// Of each script.
    pub(super) scripts: Vec<TrackedScript>,
}

/// The sum of all hashes: it does not matter in which order they change.
#[derive(Default)]
pub(super) struct Sum(pub u64);

impl Sum {
    /// Puts another hash in the place of an old one, and returns whether it is another one.
    pub(super) fn replace(&mut self, place: &mut u64, value: ChangedValue<'_>, sink: Sink<'_>) {
        let old = std::mem::replace(place, value.hash);
        self.0 = self.0.wrapping_sub(old).wrapping_add(value.hash);
        if old != value.hash {
            sink(value);
        }
    }
}

impl Hashes {
    /// The sum of all hashes now; `sink` gets the values that changed since the last time.
    pub(super) fn update(&mut self, sim: &Rc<Sim>, sink: Sink<'_>) -> u64 {
        let scene = sim.scene.borrow();
        let cursor = self
            .cursor
            .get_or_insert_with(|| scene.journal().follow(Topics::ALL));
        let news = News::read(&scene, cursor, &mut self.followed);
        if news.everything {
            self.look_at_everything(sim, &scene, sink);
        } else {
            self.follow(sim, &scene, news, sink);
        }
        drop(scene);
        self.look_at_unrecorded(sim, sink);
        self.sum.0
    }

    fn look_at_everything(&mut self, sim: &Rc<Sim>, scene: &Scene, sink: Sink<'_>) {
        let mut handles: BTreeSet<Handle> = self.followed.handles().collect();
        handles.extend(scene.objects().map(Object::handle));
        for handle in handles {
            self.look_at_new(sim, scene, handle, sink);
        }
        let mut names: BTreeSet<Stored> = self.stored.keys().cloned().collect();
        names.extend(all_names(sim, scene));
        for name in &names {
            self.look_at_stored(sim, scene, name, sink);
        }
        self.look_at_scene(sim, sink);
        self.look_at_lists(scene, sink);
    }

    fn follow(&mut self, sim: &Rc<Sim>, scene: &Scene, news: News, sink: Sink<'_>) {
        for &handle in &news.new {
            self.look_at_new(sim, scene, handle, sink);
        }
        for handle in news.modified {
            self.look_at_object(sim, scene, handle, sink);
        }
        if news.removals {
            self.look_at_references(sim, scene, sink);
        }
        for name in &news.stored {
            self.look_at_stored(sim, scene, name, sink);
        }
        if news.settings {
            self.look_at_scene(sim, sink);
        }
        if news.tree {
            self.look_at_tree(sim, scene, sink);
        }
        if news.tree || news.selection {
            self.look_at_lists(scene, sink);
        }
    }

    /// An object that came, went, or took the handle of another one.
    fn look_at_new(&mut self, sim: &Rc<Sim>, scene: &Scene, handle: Handle, sink: Sink<'_>) {
        let object = scene.object(handle).ok();
        let known = self.followed.get(handle).map(|tracked| tracked.uid);
        if known.is_some() && known != object.map(Object::uid) {
            self.forget(handle, sink);
        }
        let Some(object) = object else { return };
        self.followed.add(object);
        for name in &names_of_object(sim, scene, handle) {
            self.look_at_stored(sim, scene, name, sink);
        }
        self.look_at_object(sim, scene, handle, sink);
    }

    fn forget(&mut self, handle: Handle, sink: Sink<'_>) {
        let Some(mut gone) = self.followed.remove(handle) else {
            return;
        };
        for (slot, value) in gone.slots.slots.iter().zip(&mut gone.values) {
            self.sum
                .replace(value, changed(handle.raw(), slot.name, 0), sink);
        }
        let holder = Holder::Object(handle);
        let first = (holder, Namespace::CustomData, String::new());
        let names = self.stored.range(first..).map(|(name, _)| name);
        let names: Vec<Stored> = names
            .take_while(|(of, ..)| *of == holder)
            .cloned()
            .collect();
        for name in &names {
            self.set_stored(name, 0, sink);
        }
    }

    fn look_at_object(&mut self, sim: &Rc<Sim>, scene: &Scene, handle: Handle, sink: Sink<'_>) {
        let (Some(tracked), Ok(object)) = (self.followed.get(handle), scene.object(handle)) else {
            return;
        };
        let changes = std::mem::take(&mut tracked.changes);
        for at in tracked.slots.concerned(changes) {
            let slot = &tracked.slots.slots[at];
            let hash = slot.hash_of(sim, object, &mut self.bytes);
            let value = changed(handle.raw(), slot.name, hash);
            self.sum.replace(&mut tracked.values[at], value, sink);
        }
    }

    /// An object that is gone changes those that refer to it.
    fn look_at_references(&mut self, sim: &Rc<Sim>, scene: &Scene, sink: Sink<'_>) {
        for handle in scene.referring_objects() {
            if let Some(tracked) = self.followed.get(handle) {
                tracked.changes = GENERAL;
            }
            self.look_at_object(sim, scene, handle, sink);
        }
    }

    /// Parents and orders of children: they rarely change, and then those of objects that the journal does not name as well.
    fn look_at_tree(&mut self, sim: &Rc<Sim>, scene: &Scene, sink: Sink<'_>) {
        for object in scene.objects() {
            let Some(tracked) = self.followed.get(object.handle()) else {
                continue;
            };
            for at in tracked.slots.about_tree() {
                let slot = &tracked.slots.slots[at];
                let hash = slot.hash_of(sim, object, &mut self.bytes);
                let value = changed(object.handle().raw(), slot.name, hash);
                self.sum.replace(&mut tracked.values[at], value, sink);
            }
        }
    }

    fn look_at_scene(&mut self, sim: &Rc<Sim>, sink: Sink<'_>) {
        let slots = &Slots::of_scene().slots;
        self.scene.resize(slots.len(), 0);
        for (slot, value) in slots.iter().zip(&mut self.scene) {
            let hash = slot.hash_of_scene(sim, &mut self.bytes);
            let new = changed(special::SCENE, slot.name, hash);
            self.sum.replace(value, new, sink);
        }
    }

    fn look_at_lists(&mut self, scene: &Scene, sink: Sink<'_>) {
        let lists = [
            ("orphanHandles", scene.roots()),
            ("selectionHandles", scene.selection()),
        ];
        for (name, handles) in lists {
            for handle in handles {
                self.bytes.int(handle.raw());
            }
            self.set_single(special::SCENE, name, sink);
        }
    }

    fn look_at_stored(&mut self, sim: &Rc<Sim>, scene: &Scene, name: &Stored, sink: Sink<'_>) {
        let (holder, namespace, text) = name;
        let (bytes, mut hash) = (&mut self.bytes, 0);
        with_values(sim, scene, (*holder, *namespace), |values| {
            for (ty, value) in values.all_typed(text) {
                bytes.int(ty as i64);
                bytes.data(value);
            }
            if values.typed(text).is_some() {
                let key = Key64::of_name(&shown(*namespace, text));
                hash = bytes.take_hash(key.on(target_of(*holder)));
            }
        });
        self.set_stored(name, hash, sink);
    }

    fn set_stored(&mut self, name: &Stored, hash: u64, sink: Sink<'_>) {
        let (holder, namespace, text) = name;
        let mut value = self.stored.get(name).copied().unwrap_or_default();
        let shown = shown(*namespace, text);
        let new = changed(target_of(*holder), &shown, hash);
        self.sum.replace(&mut value, new, sink);
        match self.stored.get_mut(name) {
            _ if hash == 0 => drop(self.stored.remove(name)),
            Some(place) => *place = hash,
            None => drop(self.stored.insert(name.clone(), hash)),
        }
    }

    /// What was written into the buffer is a value on its own.
    pub(super) fn set_single(&mut self, target: i64, name: &'static str, sink: Sink<'_>) {
        let hash = self.bytes.take_hash(Key64::of_name(name).on(target));
        let place = self.singles.entry((target, name)).or_insert(0);
        self.sum.replace(place, changed(target, name, hash), sink);
    }
}

pub(super) fn changed(target: i64, name: &str, hash: u64) -> ChangedValue<'_> {
    ChangedValue { target, name, hash }
}
