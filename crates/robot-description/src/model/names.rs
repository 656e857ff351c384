//! Things by their names.

use std::collections::BTreeMap;

/// The index of the first thing of each name.
pub(crate) struct Names(BTreeMap<String, usize>);

impl Names {
    pub(crate) fn new<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let mut first = BTreeMap::new();
        for (index, name) in names.enumerate() {
            first.entry(name.to_owned()).or_insert(index);
        }
        Self(first)
    }

    pub(crate) fn get(&self, name: &str) -> Option<usize> {
        self.0.get(name).copied()
    }
}
