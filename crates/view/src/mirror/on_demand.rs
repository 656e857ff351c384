//! What only some pages ask for: images of sensors, contacts, values of an object's properties.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::{Mirror, Revision};

/// The present state of what was asked for. Each with the revision of its last change.
#[derive(Default)]
pub(super) struct OnDemand {
    /// Messages, by sensor.
    images: BTreeMap<i64, (Revision, Arc<[u8]>)>,
    /// A message.
    contacts: Option<(Revision, Arc<[u8]>)>,
    /// Rows as JSON, by handle and name.
    rows: BTreeMap<i64, BTreeMap<String, (Revision, Arc<str>)>>,
}

/// What was found of that.
#[derive(Debug, Default)]
pub(crate) struct Demanded {
    /// Messages, by sensor.
    pub images: Vec<(i64, Vec<u8>)>,
    /// A message.
    pub contacts: Option<Vec<u8>>,
    /// Names and JSON of the rows of objects.
    pub rows: Vec<(i64, Vec<(String, String)>)>,
}

impl Mirror {
    /// Takes over what was found; what is as it was before counts as no change. Returns whether anything changed.
    pub(crate) fn apply_demanded(&mut self, found: Demanded) -> bool {
        let next = self.revision + 1;
        let mut changed = false;
        for (sensor, image) in found.images {
            changed |= put(self.on_demand.images.entry(sensor), image, next);
        }
        if let Some(contacts) = found
            .contacts
            .filter(|new| !self.on_demand.has_contacts(new))
        {
            self.on_demand.contacts = Some((next, contacts.into()));
            changed = true;
        }
        for (handle, rows) in found.rows {
            changed |= self.on_demand.apply_rows(handle, rows, next);
        }
        if changed {
            self.revision = next;
        }
        changed
    }

    /// Forgets values of objects that nobody inspects, and images that nobody watches.
    pub(crate) fn forget_unwanted(&mut self, inspected: &BTreeSet<i64>, watched: &BTreeSet<i64>) {
        self.on_demand
            .rows
            .retain(|handle, _| inspected.contains(handle));
        self.on_demand
            .images
            .retain(|sensor, _| watched.contains(sensor));
    }

    /// The last image of a sensor as a message, with its revision, unless a reader has seen it.
    pub(crate) fn image_since(&self, sensor: i64, seen: Revision) -> Option<(Revision, Arc<[u8]>)> {
        self.on_demand
            .images
            .get(&sensor)
            .filter(|(revision, _)| *revision > seen)
            .cloned()
    }

    /// The last contacts as a message, in the same way.
    pub(crate) fn contacts_since(&self, seen: Revision) -> Option<(Revision, Arc<[u8]>)> {
        self.on_demand
            .contacts
            .as_ref()
            .filter(|(revision, _)| *revision > seen)
            .cloned()
    }

    /// Rows of properties that changed since a revision, and the present one; None if none did.
    pub(crate) fn rows_since(
        &self,
        handle: i64,
        seen: Revision,
    ) -> Option<(Revision, Vec<Arc<str>>)> {
        let rows = self.on_demand.rows.get(&handle)?.values();
        let newer: Vec<_> = rows
            .filter(|(revision, _)| *revision > seen)
            .map(|(_, row)| Arc::clone(row))
            .collect();
        (!newer.is_empty()).then_some((self.revision, newer))
    }
}

impl OnDemand {
    fn has_contacts(&self, contacts: &[u8]) -> bool {
        self.contacts
            .as_ref()
            .is_some_and(|(_, known)| **known == *contacts)
    }

    fn apply_rows(&mut self, handle: i64, rows: Vec<(String, String)>, next: Revision) -> bool {
        let known = self.rows.entry(handle).or_default();
        let mut changed = false;
        for (name, row) in rows {
            if known.get(&name).is_none_or(|(_, old)| **old != *row) {
                known.insert(name, (next, row.into()));
                changed = true;
            }
        }
        changed
    }
}

fn put(
    entry: std::collections::btree_map::Entry<'_, i64, (Revision, Arc<[u8]>)>,
    message: Vec<u8>,
    next: Revision,
) -> bool {
    let mut is_new = false;
    let known = entry.or_insert_with(|| {
        is_new = true;
        (next, message.as_slice().into())
    });
    if !is_new && *known.1 != *message {
        *known = (next, message.into());
        is_new = true;
    }
    is_new
}
