//! Event filters of scripts (spec: events 6).

use std::collections::{BTreeMap, BTreeSet};

use super::queue::{Class, Source};
use scene::{Data, Key, special};

/// Names of fields; an empty list means all of them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Keys(BTreeSet<String>);

impl Keys {
    pub(crate) fn contains(&self, key: &str) -> bool {
        self.0.is_empty() || self.0.contains(key)
    }
}

/// Fields by target: handles of objects, scripts, application and scene, or a kind of them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EventFilters(BTreeMap<i64, Keys>);

impl EventFilters {
    /// The table a script gave to `sim.setEventFilters`; None when it filters nothing out. What is no handle or no name is ignored.
    pub fn from_table(table: &Data) -> Option<Self> {
        let targets: BTreeMap<i64, Keys> = match table {
            Data::Map(entries) => entries
                .iter()
                .filter_map(|(key, keys)| Some((handle(key)?, names(keys))))
                .collect(),
            Data::Array(items) => (1..).zip(items.iter().map(names)).collect(),
            _ => BTreeMap::new(),
        };
        (!targets.is_empty()).then_some(Self(targets))
    }

    /// The selected fields of `source`: its own entry, or else the entry of its kind.
    pub(crate) fn keys_of(&self, source: Source) -> Option<&Keys> {
        if source.class == Class::None {
            return None;
        }
        let kind = match source.class {
            Class::Object => Some(special::SCENE_OBJECT),
            Class::Mesh => Some(special::MESH),
            Class::Main => Some(special::MAIN_SCRIPT),
            Class::Sandbox => Some(special::SANDBOX),
            _ => None,
        };
        self.0.get(&source.handle).or_else(|| self.0.get(&kind?))
    }
}

fn handle(key: &Key) -> Option<i64> {
    match *key {
        Key::Int(handle) => Some(handle),
        Key::Float(handle) if handle.fract() == 0.0 => Some(numbers::truncated(handle)),
        _ => None,
    }
}

fn names(list: &Data) -> Keys {
    let Data::Array(items) = list else {
        return Keys::default();
    };
    let text = |item: &Data| match item {
        Data::Text(name) => Some(String::from_utf8_lossy(name).into_owned()),
        _ => None,
    };
    Keys(items.iter().filter_map(text).collect())
}
