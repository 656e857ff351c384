//! Which custom data and signals of objects changed: each name once, so that it takes no more room however often a script writes.

use std::collections::BTreeMap;

use super::{Handle, Namespace};

/// Names of the data of one object that were written (true) or removed.
pub type ChangedNames = BTreeMap<String, bool>;

/// The same of all objects.
pub(crate) type DataOfObjects = BTreeMap<(Handle, Namespace), ChangedNames>;

/// Changed custom data since the last call of `take`.
#[derive(Debug, Default)]
pub(super) struct ChangedData(DataOfObjects);

impl ChangedData {
    pub(super) fn note(&mut self, handle: Handle, namespace: Namespace, name: &str, written: bool) {
        let names = self.0.entry((handle, namespace)).or_default();
        match names.get_mut(name) {
            Some(last) => *last = written,
            None => drop(names.insert(name.to_owned(), written)),
        }
    }

    pub(super) fn take(&mut self) -> DataOfObjects {
        std::mem::take(&mut self.0)
    }
}
