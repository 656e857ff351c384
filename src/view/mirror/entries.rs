//! Entries by handle with the revision of their last change, and those that are gone.

use std::collections::BTreeMap;

use super::Revision;

/// Handles of entries that are gone which are kept; a reader that has not heard of an older one begins anew.
const MOST_REMOVED: usize = 10_000;

/// Entries by handle.
pub(super) struct Entries<T> {
    present: BTreeMap<i64, (Revision, T)>,
    removed: BTreeMap<i64, Revision>,
    last_change: Revision,
    /// The last removal that is not known any more.
    forgotten: Revision,
}

impl<T> Default for Entries<T> {
    fn default() -> Self {
        Self { present: BTreeMap::new(), removed: BTreeMap::new(), last_change: 0, forgotten: 0 }
    }
}

/// What came of an entry.
pub(super) enum Inserted<T> {
    New,
    Replaced(T),
    /// There was the same.
    Same,
}

impl<T: PartialEq> Entries<T> {
    pub(super) fn handles(&self) -> impl Iterator<Item = i64> {
        self.present.keys().copied()
    }

    pub(super) fn insert(&mut self, handle: i64, entry: T, revision: Revision) -> Inserted<T> {
        let inserted = match self.present.get_mut(&handle) {
            Some((_, present)) if *present == entry => return Inserted::Same,
            Some(present) => Inserted::Replaced(std::mem::replace(present, (revision, entry)).1),
            None => {
                self.removed.remove(&handle);
                self.present.insert(handle, (revision, entry));
                Inserted::New
            }
        };
        self.last_change = revision;
        inserted
    }

    pub(super) fn remove(&mut self, handle: i64, revision: Revision) -> Option<T> {
        let (_, entry) = self.present.remove(&handle)?;
        self.removed.insert(handle, revision);
        self.last_change = revision;
        if self.removed.len() > MOST_REMOVED {
            self.forget_removals();
        }
        Some(entry)
    }

    /// Forgets the older half of what is gone.
    fn forget_removals(&mut self) {
        let mut revisions: Vec<Revision> = self.removed.values().copied().collect();
        revisions.sort_unstable();
        self.forgotten = revisions[revisions.len() / 2];
        self.removed.retain(|_, revision| *revision > self.forgotten);
    }

    /// Takes over new entries; with `all`, there are no others. Returns whether anything changed.
    pub(super) fn apply(&mut self, entries: Vec<(i64, T)>, removed: &[i64], all: bool, revision: Revision) -> bool {
        let mut gone = removed.to_vec();
        if all {
            let there = |handle: &i64| entries.binary_search_by_key(handle, |(handle, _)| *handle).is_ok();
            gone.extend(self.handles().filter(|handle| !there(handle)));
        }
        for handle in gone {
            self.remove(handle, revision);
        }
        for (handle, entry) in entries {
            self.insert(handle, entry, revision);
        }
        self.changed_at(revision)
    }

    pub(super) fn changed_at(&self, revision: Revision) -> bool {
        self.last_change >= revision
    }

    /// The last removal that is not known any more.
    pub(super) fn forgotten(&self) -> Revision {
        self.forgotten
    }

    /// Entries that changed after a revision, by handle.
    pub(super) fn since(&self, seen: Revision) -> impl Iterator<Item = &T> {
        let any = self.last_change > seen;
        let changed = self.present.values().filter(move |(revision, _)| *revision > seen);
        changed.take_while(move |_| any).map(|(_, entry)| entry)
    }

    /// Handles of the entries that went after a revision and did not come back.
    pub(super) fn removed_since(&self, seen: Revision) -> Vec<i64> {
        let newer = self.removed.iter().filter(|(_, revision)| **revision > seen);
        newer.map(|(handle, _)| *handle).collect()
    }
}

/// World poses by handle: position and quaternion (x, y, z, w).
#[derive(Default)]
pub(super) struct Poses {
    by_handle: BTreeMap<i64, (Revision, [f32; 7])>,
    last_change: Revision,
}

impl Poses {
    /// Takes over new poses; returns whether any is another one than before.
    pub(super) fn apply(&mut self, poses: &[(i64, [f32; 7])], revision: Revision) -> bool {
        for (handle, pose) in poses {
            let known = self.by_handle.entry(*handle).or_insert((0, [0.0; 7]));
            if known.0 == 0 || known.1.map(f32::to_bits) != pose.map(f32::to_bits) {
                *known = (revision, *pose);
                self.last_change = revision;
            }
        }
        self.last_change >= revision
    }

    pub(super) fn remove(&mut self, handle: i64) {
        self.by_handle.remove(&handle);
    }

    /// The message with the poses that changed after a revision; none if no pose did.
    pub(super) fn since(&self, seen: Revision, time: f64) -> Option<Vec<u8>> {
        if self.last_change <= seen {
            return None;
        }
        let changed = self.by_handle.iter().filter(|(_, (revision, _))| *revision > seen);
        let mut bytes = vec![1, 0, 0, 0, 0, 0, 0, 0];
        bytes.extend_from_slice(&time.to_le_bytes());
        let mut count = 0u32;
        for (handle, (_, pose)) in changed {
            count += 1;
            bytes.extend_from_slice(&(*handle as i32).to_le_bytes());
            pose.iter().for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
        }
        bytes[4..8].copy_from_slice(&count.to_le_bytes());
        Some(bytes)
    }
}
