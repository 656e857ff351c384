//! The present state of all that pages show, and what of it changed since a revision. No Lua, no sockets, no scene: entries are texts of
//! JSON and rows of numbers, so that a reader copies references and the simulation waits for no encoding.

mod changes;
mod entries;
mod on_demand;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

pub(crate) use changes::{Changes, Message};
use entries::{Entries, Poses};
pub(crate) use on_demand::Demanded;
use on_demand::OnDemand;

use super::blobs::{Blob, Hash};
use super::observe::{Observation, ObservedObject, ObservedWindows};

/// Lines of the log that are kept.
pub(crate) const LOG_LINES: usize = 10_000;

/// Number of a state of the mirror; it grows with every change. Nothing has changed at 0.
pub(crate) type Revision = u64;

/// A blob and how many objects show it.
struct UsedBlob {
    blob: Arc<Blob>,
    users: usize,
    /// When it was first shown.
    revision: Revision,
}

/// The present state of all that pages show.
#[derive(Default)]
pub(crate) struct Mirror {
    revision: Revision,
    /// Readers that saw an older state begin anew.
    begun: Revision,
    scene: (Revision, Arc<str>),
    time: f64,
    objects: Entries<i64, ObservedObject>,
    drawings: Entries<i64, Arc<str>>,
    /// Interfaces of scripts, by their identifiers in JSON.
    windows: Entries<String, Arc<str>>,
    /// Lists as JSON, by their names in messages.
    lists: BTreeMap<&'static str, (Revision, Arc<str>)>,
    poses: Poses,
    selection: (Revision, Vec<i64>),
    log: VecDeque<(Revision, Arc<str>)>,
    /// Readers that saw an older state forget the lines they have.
    log_begun: Revision,
    blobs: BTreeMap<Hash, UsedBlob>,
    on_demand: OnDemand,
}

impl Mirror {
    /// The number of the present state.
    pub(crate) fn revision(&self) -> Revision {
        self.revision
    }

    /// Takes over what an observer found; what is as it was before counts as no change. Returns whether anything changed.
    pub(crate) fn apply(&mut self, seen: Observation) -> bool {
        let (before, next) = (self.revision, self.revision + 1);
        if seen.is_another_scene {
            self.begun = next;
            self.revision = next;
        }
        self.apply_objects(seen.objects, seen.removed, seen.is_complete, next);
        let mut changed = self.objects.changed_at(next);
        changed |= self.drawings.apply(
            seen.drawings,
            &seen.removed_drawings,
            seen.is_complete,
            next,
        );
        changed |= self.poses.apply(&seen.poses, next);
        changed |= self.apply_scene(seen.scene, seen.time, next);
        changed |= self.apply_selection(seen.selection, next);
        changed |= self.apply_log(seen.log, next);
        if changed {
            self.revision = next;
        }
        self.revision != before
    }

    fn apply_objects(
        &mut self,
        objects: Vec<(i64, ObservedObject)>,
        mut removed: Vec<i64>,
        all: bool,
        next: Revision,
    ) {
        if all {
            let there = |handle: &i64| {
                objects
                    .binary_search_by_key(handle, |(handle, _)| *handle)
                    .is_ok()
            };
            removed.extend(self.objects.keys().filter(|handle| !there(handle)));
        }
        for handle in removed {
            if let Some(gone) = self.objects.remove(handle, next) {
                self.release(&gone.blobs);
                self.poses.remove(handle);
            }
        }
        for (handle, object) in objects {
            let blobs = object.blobs.clone();
            blobs.iter().for_each(|blob| self.retain(blob, next));
            match self.objects.insert(handle, object, next) {
                entries::Inserted::New => {}
                entries::Inserted::Replaced(old) => self.release(&old.blobs),
                entries::Inserted::Same => self.release(&blobs),
            }
        }
        if self.objects.forgotten() > self.begun {
            self.begun = self.objects.forgotten();
        }
    }

    /// Takes over interfaces of scripts. Returns whether anything changed.
    pub(crate) fn apply_windows(&mut self, seen: ObservedWindows) -> bool {
        let next = self.revision + 1;
        let mut changed = self
            .windows
            .apply(seen.windows, &seen.removed, seen.is_complete, next);
        for (name, list) in seen.lists {
            changed |= self.apply_list(name, list, next);
        }
        self.begun = self.begun.max(self.windows.forgotten());
        if changed {
            self.revision = next;
        }
        changed
    }

    fn apply_list(&mut self, name: &'static str, list: Arc<str>, next: Revision) -> bool {
        let is_new = self.lists.get(name).is_none_or(|(_, known)| *known != list);
        if is_new {
            self.lists.insert(name, (next, list));
        }
        is_new
    }

    /// The dialog that waits for a person, as JSON; null for none.
    pub(crate) fn show_question(&mut self, question: &serde_json::Value) {
        self.show_list("question", &question.to_string());
    }

    fn retain(&mut self, blob: &Arc<Blob>, next: Revision) {
        let entry = || UsedBlob {
            blob: Arc::clone(blob),
            users: 0,
            revision: next,
        };
        self.blobs.entry(blob.hash).or_insert_with(entry).users += 1;
    }

    fn release(&mut self, blobs: &[Arc<Blob>]) {
        for blob in blobs {
            if let Some(used) = self.blobs.get_mut(&blob.hash) {
                used.users -= 1;
                if used.users == 0 {
                    self.blobs.remove(&blob.hash);
                }
            }
        }
    }

    fn apply_scene(&mut self, scene: Option<String>, time: f64, next: Revision) -> bool {
        self.time = time;
        let Some(scene) = scene.filter(|scene| **scene != *self.scene.1) else {
            return false;
        };
        self.scene = (next, scene.into());
        true
    }

    fn apply_selection(&mut self, selection: Option<Vec<i64>>, next: Revision) -> bool {
        let Some(selection) = selection.filter(|selection| *selection != self.selection.1) else {
            return false;
        };
        self.selection = (next, selection);
        true
    }

    fn apply_log(&mut self, lines: Vec<String>, next: Revision) -> bool {
        let changed = !lines.is_empty();
        self.log
            .extend(lines.into_iter().map(|line| (next, line.into())));
        let surplus = self.log.len().saturating_sub(LOG_LINES);
        self.log.drain(..surplus);
        changed
    }

    /// More lines of the log, or others in place of those before.
    pub(crate) fn show_lines(&mut self, lines: Vec<String>, are_more: bool) {
        let next = self.revision + 1;
        if !are_more {
            self.log.clear();
            self.log_begun = next;
        }
        if self.apply_log(lines, next) || !are_more {
            self.revision = next;
        }
    }

    /// Sets what pages get whole whenever it changes: JSON, and its name in messages. Returns whether it did.
    pub(crate) fn show_list(&mut self, name: &'static str, list: &str) -> bool {
        let next = self.revision + 1;
        let is_new = self.apply_list(name, list.into(), next);
        if is_new {
            self.revision = next;
        }
        is_new
    }

    /// The bytes of a blob that is shown.
    pub(crate) fn blob(&self, hash: Hash) -> Option<Arc<Blob>> {
        self.blobs.get(&hash).map(|used| Arc::clone(&used.blob))
    }

    /// Blobs that came after a revision, in the order of their names.
    pub(crate) fn blobs_since(&self, seen: Revision) -> impl Iterator<Item = &Arc<Blob>> {
        self.blobs
            .values()
            .filter(move |used| used.revision > seen)
            .map(|used| &used.blob)
    }

    /// What changed since a reader saw the state with that number (0: never); None if nothing did. Takes time in proportion to the number of
    /// objects at most; texts are shared, not copied.
    pub(crate) fn changes_since(&self, seen: Revision) -> Option<Changes> {
        if seen >= self.revision {
            return None;
        }
        let is_snapshot = seen < self.begun || seen == 0;
        let since = if is_snapshot { 0 } else { seen };
        let newer = |entry: &(Revision, Arc<str>)| (entry.0 > since).then(|| Arc::clone(&entry.1));
        let is_log_anew = !is_snapshot && since < self.log_begun;
        let known = if is_log_anew { 0 } else { since };
        let new_lines = self.log.partition_point(|(revision, _)| *revision <= known);
        Some(Changes {
            revision: self.revision,
            is_snapshot,
            is_log_anew,
            scene: newer(&self.scene),
            objects: self
                .objects
                .since(since)
                .map(|object| Arc::clone(&object.text))
                .collect(),
            removed: if is_snapshot {
                Vec::new()
            } else {
                self.objects.removed_since(since)
            },
            drawings: self.drawings.since(since).cloned().collect(),
            removed_drawings: if is_snapshot {
                Vec::new()
            } else {
                self.drawings.removed_since(since)
            },
            windows: self.windows.since(since).cloned().collect(),
            removed_windows: if is_snapshot {
                Vec::new()
            } else {
                self.windows.removed_since(since)
            },
            lists: self
                .lists
                .iter()
                .filter_map(|(name, list)| Some((*name, newer(list)?)))
                .collect(),
            selection: (self.selection.0 > since || is_snapshot).then(|| self.selection.1.clone()),
            log: self
                .log
                .range(new_lines..)
                .map(|(_, line)| Arc::clone(line))
                .collect(),
            poses: self.poses.since(since, self.time),
        })
    }

    /// Everything, but of the log only what came after a revision: for readers that keep the lines before.
    pub(crate) fn snapshot_with_lines_since(&self, seen: Revision) -> Option<Changes> {
        let log = self
            .changes_since(seen)
            .map(|changes| changes.log)
            .unwrap_or_default();
        self.changes_since(0).map(|changes| Changes {
            log,
            is_snapshot: true,
            ..changes
        })
    }

    /// The messages that bring a reader from a state up to the present one, and the number of that.
    #[cfg(test)]
    pub(crate) fn update_since(&self, seen: Revision) -> (Revision, Vec<Message>) {
        self.changes_since(seen)
            .map_or((self.revision, Vec::new()), |changes| {
                (changes.revision, changes.messages())
            })
    }
}
