//! From the scene's journal to events.

use std::collections::{BTreeMap, HashSet};
use std::rc::Rc;

use super::encode;
use super::protocol::{Protocol, renamed};
use super::queue::{Entry, Event, Source};
use super::watch::{Watch, Watched, stored_entry, stored_key};
use crate::scene::journal::Changes;
use crate::scene::{Change, Data, Field, Handle, Holder, Namespace, Uid, Unread, ValueType};
use crate::script::property::Target;
use crate::script::sim::Sim;

/// Lists of the scene, told when objects come, go, change parents or are selected.
pub(super) const LISTS: [&str; 3] = ["objectHandles", "orphanHandles", "selectionHandles"];

/// What an advance of the clock changes, in the order it is told.
const CLOCK: [&str; 3] = ["stepCount", "simulationTime", "simulationState"];

impl Sim {
    /// Turns the changes since the last call into events.
    pub(crate) fn collect_events(self: &Rc<Self>) {
        if !self.events.listening.get() {
            return;
        }
        self.collect_clock();
        let Some(changes) = self.new_changes() else { return self.begin_anew() };
        if changes.is_empty() {
            return;
        }
        let mut guard = self.events.watch.borrow_mut();
        let Some(watch) = guard.as_mut() else { return };
        for change in changes {
            self.collect(watch, change);
        }
    }

    /// What changed in the scene since the last call; None when that is more than is known.
    fn new_changes(&self) -> Option<Vec<Change>> {
        let mut guard = self.events.cursor.borrow_mut();
        let Some(cursor) = guard.as_mut() else { return Some(Vec::new()) };
        match self.scene.borrow().journal().read(cursor) {
            Unread::Everything => None,
            Unread::Changes(changes) => Some(latest_of_each(changes)),
        }
    }

    fn collect(self: &Rc<Self>, watch: &mut Watch, change: Change) {
        match change {
            Change::Added(handle) => self.collect_added(watch, handle),
            Change::Removed(handle, uid) => self.collect_removed(watch, handle, uid),
            Change::Modified(handle, field) => self.collect_modified(watch, handle, field),
            Change::Selection => self.collect_selection(watch),
            Change::Settings => self.collect_settings(watch),
            Change::Stored { holder, namespace, name } => self.collect_stored(holder, namespace, &name),
        }
    }

    fn push_event(&self, event: Event) {
        self.events.queue.borrow_mut().push(event);
    }

    /// Tells the properties that a change of `field` can concern (None: all), as far as they are different.
    fn collect_differences(self: &Rc<Self>, watched: &mut Watched, field: Option<Field>) {
        let keys = watched.keys();
        let indices = field.map_or(keys.all(), |field| keys.concerned(field));
        let events = watched.differences(self, indices);
        events.into_iter().for_each(|event| self.push_event(event));
    }

    /// Tells one property, if it is different.
    fn collect_one(self: &Rc<Self>, watched: &mut Watched, name: &str) {
        let index = watched.keys().index_of(name);
        let events = watched.differences(self, index.as_slice());
        events.into_iter().for_each(|event| self.push_event(event));
    }

    /// Time and state are no part of the scene, so that nobody notes their changes.
    fn collect_clock(self: &Rc<Self>) {
        let now = self.clock_values();
        if self.events.clock.replace(now) == now {
            return;
        }
        let mut guard = self.events.watch.borrow_mut();
        let Some(watch) = guard.as_mut() else { return };
        for name in CLOCK {
            self.collect_one(&mut watch.scene, name);
        }
    }

    pub(super) fn clock_values(&self) -> (f64, u64, i64) {
        (self.clock.time(), self.clock.steps(), self.clock.state() as i64)
    }

    fn collect_settings(self: &Rc<Self>, watch: &mut Watch) {
        self.collect_differences(&mut watch.scene, None);
        let engine = self.scene.borrow().settings().dynamics.engine;
        if std::mem::replace(&mut watch.engine, engine) == engine {
            return;
        }
        let handles = self.scene.borrow().all_breadth_first();
        for handle in handles {
            if let Some(watched) = watch.objects.get_mut(&handle) {
                self.collect_one(watched, "engineProperties");
            }
        }
    }

    fn collect_added(self: &Rc<Self>, watch: &mut Watch, handle: Handle) {
        let Ok(mut watched) = self.scene.borrow().object(handle).map(|o| Watched::object(o, &watch.audience)) else {
            return;
        };
        self.added(&mut watched).into_iter().for_each(|event| self.push_event(event));
        watch.objects.insert(handle, watched);
        self.collect_orders(watch, None);
        self.push_lists();
    }

    /// The events that introduce an object: its own, then those of its meshes.
    pub(super) fn added(self: &Rc<Self>, watched: &mut Watched) -> Vec<Event> {
        let mut entries = watched.describe(self);
        for namespace in [Namespace::CustomData, Namespace::Signal] {
            entries.extend(watched.stored(self, namespace));
        }
        let mut events = vec![Event::new("objectAdded", watched.source, entries)];
        for mesh in &mut watched.meshes {
            events.push(Event::new("objectAdded", mesh.source, mesh.describe(self)));
        }
        events
    }

    fn collect_removed(self: &Rc<Self>, watch: &mut Watch, handle: Handle, uid: Uid) {
        // One that came and went unseen.
        let Some(watched) = watch.objects.remove(&handle) else { return };
        debug_assert_eq!(watched.source.uid, uid);
        for gone in watched.meshes.iter().chain([&watched]) {
            self.push_event(Event::new("objectRemoved", gone.source, Vec::new()));
        }
        self.collect_orders(watch, watched.parent);
        self.push_lists();
    }

    fn collect_modified(self: &Rc<Self>, watch: &mut Watch, handle: Handle, field: Field) {
        let Ok(parent) = self.scene.borrow().object(handle).map(crate::scene::Object::parent) else { return };
        if field == Field::Parent {
            self.collect_new_parent(watch, handle, parent);
        }
        if let Some(watched) = watch.objects.get_mut(&handle) {
            self.collect_differences(watched, Some(field));
            watched.meshes.iter_mut().for_each(|mesh| self.collect_differences(mesh, Some(field)));
        }
        match field {
            Field::Geometry => self.collect_meshes(watch, handle),
            Field::Texture => self.collect_textures(watch, handle),
            _ => {}
        }
        if field == Field::Alias {
            self.collect_orders(watch, parent);
        }
    }

    /// A shape has another image on it.
    fn collect_textures(self: &Rc<Self>, watch: &Watch, handle: Handle) {
        let meshes = watch.objects.get(&handle).map_or(&[][..], |watched| &watched.meshes);
        let events = meshes.iter().flat_map(|mesh| mesh.large(self, Field::Texture));
        events.for_each(|event| self.push_event(event));
    }

    /// A shape has another geometry: meshes went, came, or look different.
    fn collect_meshes(self: &Rc<Self>, watch: &mut Watch, handle: Handle) {
        let Some(watched) = watch.objects.get_mut(&handle) else { return };
        let Ok(now) = self.scene.borrow().object(handle).map(|o| Watched::meshes(o, &watch.audience)) else { return };
        let before = std::mem::take(&mut watched.meshes);
        let in_list = |list: &[Watched], uid| list.iter().any(|mesh| mesh.source.uid == uid);
        for gone in before.iter().filter(|mesh| !in_list(&now, mesh.source.uid)) {
            self.push_event(Event::new("objectRemoved", gone.source, Vec::new()));
        }
        watched.meshes = now;
        for mesh in &mut watched.meshes {
            if in_list(&before, mesh.source.uid) {
                mesh.large(self, Field::Geometry).into_iter().for_each(|event| self.push_event(event));
                mesh.refresh(self);
            } else {
                let entries = mesh.describe(self);
                self.push_event(Event::new("objectAdded", mesh.source, entries));
            }
        }
    }

    /// What another parent means for the siblings and the lists of the scene; the object itself comes after them.
    fn collect_new_parent(self: &Rc<Self>, watch: &mut Watch, handle: Handle, parent: Option<Handle>) {
        let Some(watched) = watch.objects.get_mut(&handle) else { return };
        let old = std::mem::replace(&mut watched.parent, parent);
        // A new parent is not told as a new pose, whether the object stays in place or not.
        if let Some(pose) = watched.keys().index_of("pose") {
            watched.take_difference(self, pose);
        }
        self.collect_orders(watch, parent);
        if old != parent {
            self.collect_orders(watch, old);
        }
        self.push_event(Event::list("orphanHandles"));
    }

    /// The order among namesakes may have changed for all children of `parent`.
    fn collect_orders(self: &Rc<Self>, watch: &mut Watch, parent: Option<Handle>) {
        let orders = self.scene.borrow().child_orders(parent);
        for (child, order) in orders {
            if let Some(watched) = watch.objects.get_mut(&child)
                && !watched.was_told("childOrder", &Data::Int(order.map_or(-1, |order| order as i64)))
            {
                self.collect_one(watched, "childOrder");
            }
        }
    }

    fn collect_selection(self: &Rc<Self>, watch: &mut Watch) {
        let now = self.scene.borrow().selection().to_vec();
        let before = std::mem::replace(&mut watch.selection, now.clone());
        for handle in before.iter().chain(&now) {
            if before.contains(handle) != now.contains(handle)
                && let Some(watched) = watch.objects.get_mut(handle)
            {
                self.collect_one(watched, "selected");
            }
        }
        self.push_event(Event::list("selectionHandles"));
    }

    /// Each write of custom data or a signal is told, none merged.
    fn collect_stored(self: &Rc<Self>, holder: Holder, namespace: Namespace, name: &str) {
        let (target, source) = match holder {
            Holder::App => (Target::App, Source::APP),
            Holder::Scene => (Target::Scene, Source::SCENE),
            Holder::Object(handle) => {
                let Ok(uid) = self.scene.borrow().object(handle).map(crate::scene::Object::uid) else { return };
                (Target::Object(handle), Source::object(handle, uid))
            }
        };
        let protocol = self.events.protocol.get();
        let present = self.with_named_values(&target, namespace, |values| {
            values.typed(name).map(|value| stored_entry(protocol, namespace, name, value))
        });
        let removed = || Entry { key: stored_key(namespace, name).into(), value: encode::null() };
        let entry = present.ok().flatten().unwrap_or_else(removed);
        self.push_event(Event::new("objectChanged", source, vec![entry]));
    }

    /// Objects came or went.
    fn push_lists(&self) {
        self.push_event(Event::list("objectHandles"));
        self.push_event(Event::list("orphanHandles"));
    }

    /// Fills in the lists of the scene as they are now, and names them as the protocol does.
    pub(super) fn fill_in_lists(self: &Rc<Self>, events: &mut [Event]) {
        let entries: Vec<&mut Entry> = events
            .iter_mut()
            .filter(|event| event.source == Source::SCENE)
            .flat_map(Event::entries_mut)
            .filter(|entry| entry.value.is_empty())
            .collect();
        for entry in entries {
            if let Some(name) = LISTS.into_iter().find(|name| *name == entry.key) {
                *entry = self.list_entry(name);
            }
        }
    }

    fn list_entry(self: &Rc<Self>, name: &'static str) -> Entry {
        let list = self.read_property(&Target::Scene, name, ValueType::IntArray).unwrap_or(Data::Array(Vec::new()));
        let mut value = Vec::new();
        if self.events.protocol.get() == Protocol::V3 {
            encode::value(Protocol::V3, ValueType::IntArray, &list, &mut value);
            return Entry { key: name.into(), value };
        }
        let (key, meaning) = renamed("app.scene", name);
        encode::meant(meaning, ValueType::IntArray, &list, &mut value);
        Entry { key: key.into(), value }
    }

    /// What nobody notes when it changes: the application, scripts that are no objects, states of scripts.
    pub(super) fn collect_quiet_changes(self: &Rc<Self>) {
        let mut guard = self.events.watch.borrow_mut();
        let Some(watch) = guard.as_mut() else { return };
        self.collect_differences(&mut watch.app, None);
        self.collect_named_params(watch);
        self.collect_detached_scripts(watch);
        let scripts: Vec<Handle> = self.scripts.all().iter().filter_map(|script| script.object).collect();
        for handle in scripts {
            if let Some(watched) = watch.objects.get_mut(&handle) {
                self.collect_one(watched, "scriptState");
            }
        }
    }

    fn collect_named_params(&self, watch: &mut Watch) {
        let now = self.app.borrow().named_params.clone();
        let before = std::mem::replace(&mut watch.named_params, now);
        let names = before.keys().chain(watch.named_params.keys().filter(|name| !before.contains_key(*name)));
        for name in names.filter(|name| before.get(*name) != watch.named_params.get(*name)) {
            let entry = self.named_param_entry(name, watch.named_params.get(name));
            self.push_event(Event::changed(Source::APP, vec![entry]));
        }
    }

    pub(super) fn named_param_entry(&self, name: &str, value: Option<&Vec<u8>>) -> Entry {
        let mut bytes = Vec::new();
        let data = value.map_or(Data::Nil, |text| Data::Text(text.clone()));
        encode::value(self.events.protocol.get(), ValueType::String, &data, &mut bytes);
        Entry { key: format!("namedParam.{name}").into(), value: bytes }
    }

    fn collect_detached_scripts(self: &Rc<Self>, watch: &mut Watch) {
        let present: BTreeMap<i64, _> = self.scripts.all_detached().into_iter().map(|s| (s.id, s)).collect();
        let gone: Vec<i64> = watch.scripts.keys().copied().filter(|id| !present.contains_key(id)).collect();
        for id in gone {
            if let Some(watched) = watch.scripts.remove(&id) {
                self.push_event(Event::new("objectRemoved", watched.source, Vec::new()));
            }
        }
        for (id, script) in present {
            match watch.scripts.get_mut(&id) {
                Some(watched) => self.collect_differences(watched, None),
                None => {
                    let mut watched = Watched::script(&script, &watch.audience);
                    self.push_event(self.detached_added(&mut watched));
                    watch.scripts.insert(id, watched);
                }
            }
        }
    }
}

/// Leaves out changes of a field of an object that are followed by another one: the physics reports after every sub-step.
fn latest_of_each(changes: Changes<'_>) -> Vec<Change> {
    let mut seen = HashSet::new();
    let one = changes.size_hint().1 == Some(1);
    let mut latest: Vec<Change> = changes.rev().filter(|change| one || is_first(&mut seen, change)).cloned().collect();
    latest.reverse();
    latest
}

fn is_first(seen: &mut HashSet<(Handle, Field)>, change: &Change) -> bool {
    match change {
        Change::Modified(handle, field) => seen.insert((*handle, *field)),
        _ => true,
    }
}
