//! Values last sent to listeners for each target, so that only differences become events.

use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

use super::keys::{Keys, keys};
use crate::event_stream::protocol::Protocol;
use crate::event_stream::queue::{Class, Entry, Event, Source};
use crate::event_stream::{EventFilters, encode};
use crate::host::{Script, Sim};
use crate::property::{
    Class as PropertyClass, PropertyTarget, app_class, mesh_class, object_class, scene_class,
    script_class,
};
use scene::object::script_object::ScriptType;
use scene::parameters::engine::SelectedEngine;
use scene::{Data, Field, Handle, Namespace, Object, ValueType};

/// Bytes that most values do not exceed: a pose has 37.
const USUAL_SIZE: usize = 40;

/// The listeners, and their protocol versions.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Listeners {
    pub protocol: Protocol,
    /// The filter of each listener; None for all events.
    pub filters: Vec<Option<EventFilters>>,
}

impl Listeners {
    fn wants(&self, source: Source, key: &str) -> bool {
        self.filters.iter().any(|filters| match filters {
            None => true,
            Some(filters) => filters
                .keys_of(source)
                .is_some_and(|keys| keys.contains(key)),
        })
    }
}

/// A target and the values last sent.
pub(super) struct Watched {
    pub target: PropertyTarget,
    pub source: Source,
    /// The parent of an object when it was last looked at: it matters when the object is gone.
    pub parent: Option<Handle>,
    pub meshes: Vec<Watched>,
    protocol: Protocol,
    keys: &'static Keys,
    /// Nil without a listener.
    sent: Vec<Data>,
    wanted: Vec<bool>,
}

impl Watched {
    pub(super) fn app(listeners: &Listeners) -> Self {
        Self::new(PropertyTarget::App, Source::APP, app_class(), listeners)
    }

    pub(super) fn scene(listeners: &Listeners) -> Self {
        Self::new(
            PropertyTarget::Scene,
            Source::SCENE,
            scene_class(),
            listeners,
        )
    }

    pub(super) fn script(script: &Rc<Script>, listeners: &Listeners) -> Self {
        let class = match script.script_type {
            ScriptType::Main => Class::Main,
            ScriptType::Sandbox => Class::Sandbox,
            _ => Class::AddOn,
        };
        let source = Source {
            class,
            handle: script.id,
            uid: script.id,
        };
        Self::new(
            PropertyTarget::Script(Rc::clone(script)),
            source,
            script_class(),
            listeners,
        )
    }

    pub(super) fn object(object: &Object, listeners: &Listeners) -> Self {
        let handle = object.handle();
        let source = Source::object(handle, object.uid());
        let watched = Self::new(
            PropertyTarget::Object(handle),
            source,
            object_class(&object.kind),
            listeners,
        );
        Self {
            parent: object.parent(),
            meshes: Self::meshes(object, listeners),
            ..watched
        }
    }

    /// The meshes of a shape.
    pub(super) fn meshes(object: &Object, listeners: &Listeners) -> Vec<Self> {
        let Ok(shape) = object.shape() else {
            return Vec::new();
        };
        let uids = shape.parts.iter().map(|part| part.uid);
        uids.map(|uid| {
            let source = Source {
                class: Class::Mesh,
                handle: uid,
                uid,
            };
            Self::new(PropertyTarget::Mesh(uid), source, mesh_class(), listeners)
        })
        .collect()
    }

    fn new(
        target: PropertyTarget,
        source: Source,
        class: &'static PropertyClass,
        listeners: &Listeners,
    ) -> Self {
        let keys = keys(class);
        let wanted = keys
            .properties
            .iter()
            .map(|property| listeners.wants(source, property.key(listeners.protocol)))
            .collect();
        let sent = vec![Data::Nil; keys.properties.len()];
        Self {
            target,
            source,
            parent: None,
            meshes: Vec::new(),
            protocol: listeners.protocol,
            keys,
            sent,
            wanted,
        }
    }

    /// Stores the present values as sent.
    pub(super) fn refresh(&mut self, sim: &Rc<Sim>) {
        for index in 0..self.sent.len() {
            if self.remembers(index) {
                self.sent[index] = self.read(sim, index).unwrap_or(Data::Nil);
            }
        }
        self.meshes.iter_mut().for_each(|mesh| mesh.refresh(sim));
    }

    fn remembers(&self, index: usize) -> bool {
        self.wanted[index] && self.keys.properties[index].large.is_none()
    }

    /// All properties of the target, which count as sent from now on.
    pub(super) fn describe(&mut self, sim: &Rc<Sim>) -> Vec<Entry> {
        let mut entries = Vec::with_capacity(self.sent.len());
        for index in 0..self.sent.len() {
            let Some(value) = self.read(sim, index) else {
                continue;
            };
            entries.push(self.entry(index, &value));
            if self.remembers(index) {
                self.sent[index] = value;
            }
        }
        entries
    }

    /// Events for properties that are not stored and depend on `field`, with their current values.
    pub(super) fn large(&self, sim: &Rc<Sim>, field: Field) -> Vec<Event> {
        let concerned =
            |of: Option<Field>| of.is_some_and(|of| of == field || field == Field::Geometry);
        let large = (0..self.sent.len())
            .filter(|&index| self.wanted[index] && concerned(self.keys.properties[index].large));
        let values = large.filter_map(|index| Some((index, self.read(sim, index)?)));
        let entries = values
            .filter(|(_, value)| !is_empty(value))
            .map(|(index, value)| self.entry(index, &value));
        entries
            .map(|entry| Event::changed(self.source, vec![entry]))
            .collect()
    }

    /// Adds an event for each of these properties that is not as it was sent; pairs share one.
    fn push_those_of(&mut self, sim: &Rc<Sim>, indices: &[usize]) {
        for &index in indices {
            if !self.take_difference(sim, index) {
                continue;
            }
            let mut sent = [index; 2];
            let partner = self.keys.properties[index].partner;
            if let Some(partner) = partner {
                self.take_difference(sim, partner);
                sent = [index.min(partner), index.max(partner)];
            }
            let sent = if partner.is_some() {
                &sent[..]
            } else {
                &sent[..1]
            };
            let entries = sent.iter().map(|&i| self.entry(i, &self.sent[i])).collect();
            sim.events.push(Event::changed(self.source, entries));
        }
    }

    /// Adds events for the properties that a change of `field` can concern (None: all), as far as they are different.
    pub(super) fn push_differences(&mut self, sim: &Rc<Sim>, field: Option<Field>) {
        let indices = field.map_or(self.keys.all(), |field| self.keys.concerned(field));
        self.push_those_of(sim, indices);
    }

    /// Adds an event for one property, if it is different.
    pub(super) fn push_difference(&mut self, sim: &Rc<Sim>, name: &str) {
        let index = self.keys.index_of(name);
        self.push_those_of(sim, index.as_slice());
    }

    /// Reads a property again; returns whether it differs from what was sent.
    pub(super) fn take_difference(&mut self, sim: &Rc<Sim>, index: usize) -> bool {
        if !self.remembers(index) {
            return false;
        }
        let Some(value) = self.read(sim, index) else {
            return false;
        };
        let differs = self.sent[index] != value;
        self.sent[index] = value;
        differs
    }

    /// Whether the property is not wanted, or was sent with this value.
    pub(super) fn was_sent(&self, name: &str, value: &Data) -> bool {
        self.keys
            .index_of(name)
            .is_none_or(|index| !self.remembers(index) || self.sent[index] == *value)
    }

    pub(super) fn keys(&self) -> &'static Keys {
        self.keys
    }

    /// The value of a property; None if there is none.
    fn read(&self, sim: &Rc<Sim>, index: usize) -> Option<Data> {
        sim.read_row(&self.target, self.keys.properties[index].row)
            .ok()
    }

    fn entry(&self, index: usize, value: &Data) -> Entry {
        let property = &self.keys.properties[index];
        let mut bytes = Vec::with_capacity(USUAL_SIZE);
        match self.protocol {
            Protocol::V3 => encode::value(Protocol::V3, property.row.ty, value, &mut bytes),
            Protocol::V4 => {
                encode::with_meaning(property.renamed.1, property.row.ty, value, &mut bytes);
            }
        }
        Entry {
            key: property.key(self.protocol).into(),
            value: bytes,
        }
    }

    /// Custom data or signals of the target.
    pub(super) fn stored(&self, sim: &Sim, namespace: Namespace) -> Vec<Entry> {
        let entries = sim.with_named_values(&self.target, namespace, |values| {
            let entry = |name| {
                Some(stored_entry(
                    self.protocol,
                    namespace,
                    name,
                    values.typed(name)?,
                ))
            };
            values.names().filter_map(entry).collect()
        });
        entries.unwrap_or_default()
    }
}

fn is_empty(value: &Data) -> bool {
    matches!(value, Data::Array(items) if items.is_empty())
        || matches!(value, Data::Buffer(bytes) if bytes.is_empty())
}

pub(super) fn stored_entry(
    protocol: Protocol,
    namespace: Namespace,
    name: &str,
    (ty, value): (ValueType, &Data),
) -> Entry {
    let mut bytes = Vec::new();
    encode::value(protocol, ty, value, &mut bytes);
    Entry {
        key: stored_key(namespace, name).into(),
        value: bytes,
    }
}

pub(super) fn stored_key(namespace: Namespace, name: &str) -> String {
    match namespace {
        Namespace::CustomData => format!("customData.{name}"),
        Namespace::Signal => format!("signal.{name}"),
    }
}

/// All targets with the values last sent.
pub(super) struct Watch {
    pub listeners: Listeners,
    pub app: Watched,
    pub scene: Watched,
    pub objects: HashMap<Handle, Watched>,
    /// Scripts that are no objects.
    pub scripts: BTreeMap<i64, Watched>,
    pub named_params: BTreeMap<String, Vec<u8>>,
    pub selection: Vec<Handle>,
    /// Physics engine: `engineProperties` of objects are those of the one selected.
    pub engine: SelectedEngine,
}

impl Watch {
    /// The world as it is, as if all of it had been sent.
    pub(super) fn new(sim: &Rc<Sim>, listeners: Listeners) -> Self {
        let objects: Vec<Watched> = sim
            .scene
            .borrow()
            .objects()
            .map(|o| Watched::object(o, &listeners))
            .collect();
        let scripts: Vec<Watched> = sim
            .scripts
            .all_detached()
            .iter()
            .map(|s| Watched::script(s, &listeners))
            .collect();
        let mut watch = Self {
            app: Watched::app(&listeners),
            scene: Watched::scene(&listeners),
            objects: objects
                .into_iter()
                .filter_map(|w| Some((Handle::from_raw(w.source.handle)?, w)))
                .collect(),
            scripts: scripts.into_iter().map(|w| (w.source.handle, w)).collect(),
            named_params: sim.app.borrow().named_params.clone(),
            selection: sim.scene.borrow().selection().to_vec(),
            engine: sim.scene.borrow().settings().dynamics.engine,
            listeners,
        };
        let Watch {
            app,
            scene,
            objects,
            scripts,
            ..
        } = &mut watch;
        [app, scene]
            .into_iter()
            .chain(objects.values_mut())
            .chain(scripts.values_mut())
            .for_each(|w| w.refresh(sim));
        watch
    }
}
