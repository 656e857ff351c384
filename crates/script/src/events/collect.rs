//! From the scene's journal to events.

use std::collections::{BTreeMap, HashSet};
use std::rc::Rc;

use super::watch::{Watch, Watched, stored_entry, stored_key};
use crate::event_stream::encode;
use crate::event_stream::protocol::{Protocol, renamed};
use crate::event_stream::queue::{Entry, Event, Source};
use crate::host::Sim;
use crate::property::PropertyTarget;
use scene::journal::Changes;
use scene::{Change, Data, Field, Handle, Holder, Namespace, Uid, Unread, ValueType};

/// Lists of the scene, sent when objects are added, removed, selected or get another parent.
pub(super) const LISTS: [&str; 3] = ["objectHandles", "orphanHandles", "selectionHandles"];

/// Properties changed by an advance of the clock, in the order of events.
const CLOCK: [&str; 3] = ["stepCount", "simulationTime", "simulationState"];

impl Sim {
    /// Turns the changes since the last call into events.
    pub(crate) fn collect_events(self: &Rc<Self>) {
        if self.events.listening.get() {
            self.collect_changes();
            self.change_protocol();
        }
    }

    fn collect_changes(self: &Rc<Self>) {
        self.with_collector(|mut collector| collector.collect_clock());
        match self.new_changes() {
            None => self.restart_events(),
            Some(NewChanges::One(change)) => {
                self.with_collector(|mut collector| collector.collect(change));
            }
            Some(NewChanges::Several(changes)) if changes.is_empty() => {}
            Some(NewChanges::Several(changes)) => {
                self.with_collector(|mut collector| {
                    changes
                        .into_iter()
                        .for_each(|change| collector.collect(change));
                });
            }
        }
    }

    /// The changes of the scene since the last call; None if some were lost.
    fn new_changes(&self) -> Option<NewChanges> {
        let mut guard = self.events.cursor.borrow_mut();
        let Some(cursor) = guard.as_mut() else {
            return Some(NewChanges::Several(Vec::new()));
        };
        match self.scene.borrow().journal().read(cursor) {
            Unread::Everything => None,
            Unread::Changes(mut changes) if changes.size_hint().1 == Some(1) => {
                Some(changes.next().map_or_else(
                    || NewChanges::Several(Vec::new()),
                    |one| NewChanges::One(one.clone()),
                ))
            }
            Unread::Changes(changes) => Some(NewChanges::Several(latest_of_each(changes))),
        }
    }

    /// Collects what no journal records: changes of the application, of scripts that are no objects, of the states of scripts.
    pub(crate) fn collect_unrecorded_changes(self: &Rc<Self>) {
        self.with_collector(|mut collector| collector.collect_unrecorded());
    }

    fn with_collector(self: &Rc<Self>, work: impl FnOnce(Collector<'_>)) {
        let mut watch = self.events.watch.borrow_mut();
        if let Some(watch) = watch.as_mut().and_then(|watch| watch.downcast_mut()) {
            work(Collector { sim: self, watch });
        }
    }

    pub(super) fn clock_values(&self) -> (f64, u64, i64) {
        (
            self.clock.time(),
            self.clock.steps(),
            self.clock.state() as i64,
        )
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

    /// Fills in the lists of the scene as they are now, and names them as the protocol does.
    pub(crate) fn fill_in_lists(self: &Rc<Self>, events: &mut [Event]) {
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
        let list = self
            .read_property(&PropertyTarget::Scene, name, ValueType::IntArray)
            .unwrap_or(Data::Array(Vec::new()));
        let mut value = Vec::new();
        if self.events.protocol.get() == Protocol::V3 {
            encode::value(Protocol::V3, ValueType::IntArray, &list, &mut value);
            return Entry {
                key: name.into(),
                value,
            };
        }
        let (key, meaning) = renamed("app.scene", name);
        encode::with_meaning(meaning, ValueType::IntArray, &list, &mut value);
        Entry {
            key: key.into(),
            value,
        }
    }

    pub(super) fn named_param_entry(&self, name: &str, value: Option<&Vec<u8>>) -> Entry {
        let mut bytes = Vec::new();
        let data = value.map_or(Data::Nil, |text| Data::Text(text.clone()));
        encode::value(
            self.events.protocol.get(),
            ValueType::String,
            &data,
            &mut bytes,
        );
        Entry {
            key: format!("namedParam.{name}").into(),
            value: bytes,
        }
    }
}

/// Changes since the last look; after most calls there is one.
enum NewChanges {
    One(Change),
    Several(Vec<Change>),
}

/// Turns changes into events, with what listeners know of each target.
struct Collector<'a> {
    sim: &'a Rc<Sim>,
    watch: &'a mut Watch,
}

impl Collector<'_> {
    fn collect(&mut self, change: Change) {
        match change {
            Change::Added(handle) => self.collect_added(handle),
            Change::Removed(handle, uid) => self.collect_removed(handle, uid),
            Change::Modified(handle, field) => self.collect_modified(handle, field),
            Change::Selection => self.collect_selection(),
            Change::Settings => self.collect_settings(),
            Change::Stored {
                holder,
                namespace,
                name,
            } => self.collect_stored(holder, namespace, &name),
        }
    }

    /// Time and state are no part of the scene, so that the journal does not record their changes.
    fn collect_clock(&mut self) {
        let now = self.sim.clock_values();
        if self.sim.events.clock.replace(now) == now {
            return;
        }
        for name in CLOCK {
            self.watch.scene.push_difference(self.sim, name);
        }
    }

    fn collect_settings(&mut self) {
        self.watch.scene.push_differences(self.sim, None);
        let engine = self.sim.scene.borrow().settings().dynamics.engine;
        if std::mem::replace(&mut self.watch.engine, engine) == engine {
            return;
        }
        let handles = self.sim.scene.borrow().all_breadth_first();
        for handle in handles {
            if let Some(watched) = self.watch.objects.get_mut(&handle) {
                watched.push_difference(self.sim, "engineProperties");
            }
        }
    }

    fn collect_added(&mut self, handle: Handle) {
        let Ok(mut watched) = self
            .sim
            .scene
            .borrow()
            .object(handle)
            .map(|o| Watched::object(o, &self.watch.listeners))
        else {
            return;
        };
        self.sim
            .added(&mut watched)
            .into_iter()
            .for_each(|event| self.push(event));
        self.watch.objects.insert(handle, watched);
        self.collect_orders(None);
        self.push_lists();
    }

    fn collect_removed(&mut self, handle: Handle, uid: Uid) {
        // An object that was created and removed between two events.
        let Some(watched) = self.watch.objects.remove(&handle) else {
            return;
        };
        debug_assert_eq!(watched.source.uid, uid);
        for gone in watched.meshes.iter().chain([&watched]) {
            self.push(Event::new("objectRemoved", gone.source, Vec::new()));
        }
        self.collect_orders(watched.parent);
        self.push_lists();
    }

    fn collect_modified(&mut self, handle: Handle, field: Field) {
        let Ok(parent) = self
            .sim
            .scene
            .borrow()
            .object(handle)
            .map(scene::Object::parent)
        else {
            return;
        };
        if field == Field::Parent {
            self.collect_new_parent(handle, parent);
        }
        if let Some(watched) = self.watch.objects.get_mut(&handle) {
            watched.push_differences(self.sim, Some(field));
            watched
                .meshes
                .iter_mut()
                .for_each(|mesh| mesh.push_differences(self.sim, Some(field)));
        }
        match field {
            Field::Geometry => self.collect_meshes(handle),
            Field::Texture => self.collect_textures(handle),
            _ => {}
        }
        if field == Field::Alias {
            self.collect_orders(parent);
        }
    }

    /// A shape has another image on it.
    fn collect_textures(&self, handle: Handle) {
        let meshes = self
            .watch
            .objects
            .get(&handle)
            .map_or(&[][..], |watched| &watched.meshes);
        let events = meshes
            .iter()
            .flat_map(|mesh| mesh.large(self.sim, Field::Texture));
        events.for_each(|event| self.push(event));
    }

    /// A shape has another geometry: meshes went, came, or look different.
    fn collect_meshes(&mut self, handle: Handle) {
        let (sim, events) = (self.sim, &self.sim.events);
        let Some(watched) = self.watch.objects.get_mut(&handle) else {
            return;
        };
        let Ok(now) = sim
            .scene
            .borrow()
            .object(handle)
            .map(|o| Watched::meshes(o, &self.watch.listeners))
        else {
            return;
        };
        let before = std::mem::take(&mut watched.meshes);
        let in_list = |list: &[Watched], uid| list.iter().any(|mesh| mesh.source.uid == uid);
        for gone in before.iter().filter(|mesh| !in_list(&now, mesh.source.uid)) {
            events.push(Event::new("objectRemoved", gone.source, Vec::new()));
        }
        watched.meshes = now;
        for mesh in &mut watched.meshes {
            if in_list(&before, mesh.source.uid) {
                mesh.large(sim, Field::Geometry)
                    .into_iter()
                    .for_each(|event| events.push(event));
                mesh.refresh(sim);
            } else {
                let entries = mesh.describe(sim);
                events.push(Event::new("objectAdded", mesh.source, entries));
            }
        }
    }

    /// Collects the effects of a new parent on the siblings and the lists of the scene; the object itself comes after them.
    fn collect_new_parent(&mut self, handle: Handle, parent: Option<Handle>) {
        let Some(watched) = self.watch.objects.get_mut(&handle) else {
            return;
        };
        let old = std::mem::replace(&mut watched.parent, parent);
        // A new parent is not sent as a new pose, whether the object stays in place or not.
        if let Some(pose) = watched.keys().index_of("pose") {
            watched.take_difference(self.sim, pose);
        }
        self.collect_orders(parent);
        if old != parent {
            self.collect_orders(old);
        }
        self.push(Event::list("orphanHandles"));
    }

    /// The order among namesakes may have changed for all children of `parent`.
    fn collect_orders(&mut self, parent: Option<Handle>) {
        let orders = self.sim.scene.borrow().child_orders(parent);
        for (child, order) in orders {
            if let Some(watched) = self.watch.objects.get_mut(&child)
                && !watched.was_sent("childOrder", &Data::Int(order.map_or(-1, numbers::count)))
            {
                watched.push_difference(self.sim, "childOrder");
            }
        }
    }

    fn collect_selection(&mut self) {
        let now = self.sim.scene.borrow().selection().to_vec();
        let before = std::mem::replace(&mut self.watch.selection, now.clone());
        for handle in before.iter().chain(&now) {
            if before.contains(handle) != now.contains(handle)
                && let Some(watched) = self.watch.objects.get_mut(handle)
            {
                watched.push_difference(self.sim, "selected");
            }
        }
        self.push(Event::list("selectionHandles"));
    }

    /// Each write of custom data or a signal becomes an event, none merged.
    fn collect_stored(&mut self, holder: Holder, namespace: Namespace, name: &str) {
        let (target, source) = match holder {
            Holder::App => (PropertyTarget::App, Source::APP),
            Holder::Scene => (PropertyTarget::Scene, Source::SCENE),
            Holder::Object(handle) => {
                let Ok(uid) = self
                    .sim
                    .scene
                    .borrow()
                    .object(handle)
                    .map(scene::Object::uid)
                else {
                    return;
                };
                (PropertyTarget::Object(handle), Source::object(handle, uid))
            }
        };
        let protocol = self.sim.events.protocol.get();
        let present = self.sim.with_named_values(&target, namespace, |values| {
            values
                .typed(name)
                .map(|value| stored_entry(protocol, namespace, name, value))
        });
        let removed = || Entry {
            key: stored_key(namespace, name).into(),
            value: encode::null(),
        };
        let entry = present.ok().flatten().unwrap_or_else(removed);
        self.push(Event::new("objectChanged", source, vec![entry]));
    }

    /// Objects came or went.
    fn push_lists(&self) {
        self.push(Event::list("objectHandles"));
        self.push(Event::list("orphanHandles"));
    }

    /// Properties whose changes are not recorded: the application, scripts that are no objects, states of scripts.
    fn collect_unrecorded(&mut self) {
        self.watch.app.push_differences(self.sim, None);
        self.collect_named_params();
        self.collect_detached_scripts();
        let scripts: Vec<Handle> = self
            .sim
            .scripts
            .all()
            .iter()
            .filter_map(|script| script.object)
            .collect();
        for handle in scripts {
            if let Some(watched) = self.watch.objects.get_mut(&handle) {
                watched.push_difference(self.sim, "scriptState");
            }
        }
    }

    fn collect_named_params(&mut self) {
        let now = self.sim.app.borrow().named_params.clone();
        let before = std::mem::replace(&mut self.watch.named_params, now);
        let names = before.keys().chain(
            self.watch
                .named_params
                .keys()
                .filter(|name| !before.contains_key(*name)),
        );
        for name in names.filter(|name| before.get(*name) != self.watch.named_params.get(*name)) {
            let entry = self
                .sim
                .named_param_entry(name, self.watch.named_params.get(name));
            self.push(Event::changed(Source::APP, vec![entry]));
        }
    }

    fn collect_detached_scripts(&mut self) {
        let present: BTreeMap<i64, _> = self
            .sim
            .scripts
            .all_detached()
            .into_iter()
            .map(|s| (s.id, s))
            .collect();
        let gone: Vec<i64> = self
            .watch
            .scripts
            .keys()
            .copied()
            .filter(|id| !present.contains_key(id))
            .collect();
        for id in gone {
            if let Some(watched) = self.watch.scripts.remove(&id) {
                self.push(Event::new("objectRemoved", watched.source, Vec::new()));
            }
        }
        for (id, script) in present {
            match self.watch.scripts.get_mut(&id) {
                Some(watched) => watched.push_differences(self.sim, None),
                None => {
                    let mut watched = Watched::script(&script, &self.watch.listeners);
                    self.push(self.sim.detached_added(&mut watched));
                    self.watch.scripts.insert(id, watched);
                }
            }
        }
    }

    fn push(&self, event: Event) {
        self.sim.events.push(event);
    }
}

/// Leaves out changes of a field of an object that are followed by another one: the physics reports after every sub-step.
fn latest_of_each(changes: Changes<'_>) -> Vec<Change> {
    let mut seen = HashSet::new();
    let mut latest: Vec<Change> = changes
        .rev()
        .filter(|change| is_first(&mut seen, change))
        .cloned()
        .collect();
    latest.reverse();
    latest
}

fn is_first(seen: &mut HashSet<(Handle, Field)>, change: &Change) -> bool {
    match change {
        Change::Modified(handle, field) => seen.insert((*handle, *field)),
        _ => true,
    }
}
