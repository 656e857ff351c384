//! Entries by handle or name with the revision of their last change, and those that are gone.

use std::collections::BTreeMap;

use super::Revision;

/// Keys of entries that are gone which are kept; a reader that has not heard of an older one begins anew.
const MAX_REMOVED: usize = 10_000;

/// Entries by handle or name.
pub(super) struct Entries<K, T> {
    present: BTreeMap<K, (Revision, T)>,
    removed: BTreeMap<K, Revision>,
    last_change: Revision,
    /// The last removal that is not known any more.
    forgotten: Revision,
}

impl<K, T> Default for Entries<K, T> {
    fn default() -> Self {
        Self {
            present: BTreeMap::new(),
            removed: BTreeMap::new(),
            last_change: 0,
            forgotten: 0,
        }
    }
}

/// What came of an entry.
pub(super) enum Inserted<T> {
    New,
    Replaced(T),
    /// There was the same.
    Same,
}

impl<K: Ord + Clone, T: PartialEq> Entries<K, T> {
    pub(super) fn keys(&self) -> impl Iterator<Item = K> {
        self.present.keys().cloned()
    }

    pub(super) fn insert(&mut self, key: K, entry: T, revision: Revision) -> Inserted<T> {
        let inserted = match self.present.get_mut(&key) {
            Some((_, present)) if *present == entry => return Inserted::Same,
            Some(present) => Inserted::Replaced(std::mem::replace(present, (revision, entry)).1),
            None => {
                self.removed.remove(&key);
                self.present.insert(key, (revision, entry));
                Inserted::New
            }
        };
        self.last_change = revision;
        inserted
    }

    pub(super) fn remove(&mut self, key: K, revision: Revision) -> Option<T> {
        let (_, entry) = self.present.remove(&key)?;
        self.removed.insert(key, revision);
        self.last_change = revision;
        if self.removed.len() > MAX_REMOVED {
            self.forget_removals();
        }
        Some(entry)
    }

    /// Forgets the older half of what is gone.
    fn forget_removals(&mut self) {
        let mut revisions: Vec<Revision> = self.removed.values().copied().collect();
        revisions.sort_unstable();
        self.forgotten = revisions[revisions.len() / 2];
        self.removed
            .retain(|_, revision| *revision > self.forgotten);
    }

    /// Takes over new entries, in the order of their keys; with `all`, there are no others. Returns whether anything changed.
    pub(super) fn apply(
        &mut self,
        entries: Vec<(K, T)>,
        removed: &[K],
        all: bool,
        revision: Revision,
    ) -> bool {
        let mut gone = removed.to_vec();
        if all {
            let there = |key: &K| {
                entries
                    .binary_search_by(|(known, _)| known.cmp(key))
                    .is_ok()
            };
            gone.extend(self.keys().filter(|key| !there(key)));
        }
        for key in gone {
            self.remove(key, revision);
        }
        for (key, entry) in entries {
            self.insert(key, entry, revision);
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

    /// Entries that changed after a revision, in the order of their keys.
    pub(super) fn since(&self, seen: Revision) -> impl Iterator<Item = &T> {
        let any = self.last_change > seen;
        let changed = self
            .present
            .values()
            .filter(move |(revision, _)| *revision > seen);
        changed.take_while(move |_| any).map(|(_, entry)| entry)
    }

    /// Keys of the entries that went after a revision and did not come back.
    pub(super) fn removed_since(&self, seen: Revision) -> Vec<K> {
        let newer = self
            .removed
            .iter()
            .filter(|(_, revision)| **revision > seen);
        newer.map(|(key, _)| key.clone()).collect()
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
        let changed = self
            .by_handle
            .iter()
            .filter(|(_, (revision, _))| *revision > seen);
        let mut bytes = vec![1, 0, 0, 0, 0, 0, 0, 0];
        bytes.extend_from_slice(&time.to_le_bytes());
        let mut count = 0u32;
        for (handle, (_, pose)) in changed {
            count += 1;
            bytes.extend_from_slice(&(*handle as i32).to_le_bytes());
            pose.iter()
                .for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
        }
        bytes[4..8].copy_from_slice(&count.to_le_bytes());
        Some(bytes)
    }
}
