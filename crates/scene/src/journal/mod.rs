//! The journal: every change of the scene, for as many readers as there are.
//!
//! Every mutation of [`Scene`](super::Scene) goes through `Scene::modify` or one of the structural operations, and each of those
//! notes its change here, whoever makes it. There are two ways to learn of changes:
//!
//! - A [`Cursor`] reads the changes themselves, in their order. They are stored only while there is a cursor that wants them, and no
//!   more than a fixed number: a cursor that is too far behind, or new, reports that everything may have changed.
//! - A [`Mark`] asks whether anything changed about some topics. Nothing is stored for it, and the answer takes constant time.
//!
//! Which data of objects changed is a digest beside the log ([`ChangedNames`]): each name once, however often it was written.

mod change;
mod data;
mod log;
#[cfg(test)]
mod tests;

use std::rc::Rc;

pub use change::{Change, Field, Topic, Topics};
pub use data::ChangedNames;
pub use log::{Changes, Cursor, Unread};

use super::values::custom_data::Edited;
use super::{Handle, Holder, Namespace};
use data::{ChangedData, DataOfObjects};
use log::Log;

/// Record of changes in a scene.
#[derive(Debug, Default)]
pub struct Journal {
    /// All changes ever noted, and those about each topic.
    total: u64,
    totals: [u64; Topic::COUNT],
    log: Log,
    changed_data: ChangedData,
}

/// How often the tree changed, ever.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counters {
    /// Objects added.
    pub creations: i64,
    /// Objects removed.
    pub destructions: i64,
    /// Objects that came, went, or got another parent or place.
    pub hierarchy: i64,
}

/// State of a reader that only needs to know whether anything changed about some topics.
#[derive(Debug, Clone)]
pub struct Mark {
    topics: Topics,
    /// The journal the numbers are of.
    journal: Option<Rc<()>>,
    total: u64,
    of_topics: u64,
}

impl Mark {
    /// Knows nothing yet.
    pub const fn new(topics: Topics) -> Self {
        Self {
            topics,
            journal: None,
            total: 0,
            of_topics: 0,
        }
    }
}

impl Journal {
    /// Notes a change that was just made.
    pub(crate) fn note(&mut self, change: Change) {
        let topic = change.topic();
        self.count(topic);
        self.log.push(topic, change);
    }

    fn count(&mut self, topic: Topic) {
        self.total += 1;
        self.totals[topic.index()] += 1;
    }

    /// Notes what an edit of named values did. It is also remembered for scripts attached to objects, see
    /// [`take_changed_data`](Self::take_changed_data).
    pub fn note_stored(&mut self, holder: Holder, namespace: Namespace, edited: &Edited<'_>) {
        match edited {
            Edited::Nothing => {}
            Edited::Written(name) => self.note_name(holder, namespace, name, true),
            Edited::Removed(name) => self.note_name(holder, namespace, name, false),
            Edited::Cleared(names) => names
                .iter()
                .for_each(|name| self.note_name(holder, namespace, name, false)),
        }
    }

    fn note_name(&mut self, holder: Holder, namespace: Namespace, name: &str, written: bool) {
        self.count(Topic::Stored);
        if let Holder::Object(handle) = holder {
            self.changed_data.note(handle, namespace, name, written);
        }
        if self.is_followed(Topic::Stored) {
            self.log.push(
                Topic::Stored,
                Change::Stored {
                    holder,
                    namespace,
                    name: name.to_owned(),
                },
            );
        }
    }

    /// Which data of which objects was changed since the last call.
    pub fn take_changed_data(&mut self) -> DataOfObjects {
        self.changed_data.take()
    }

    /// Registers a reader for changes about `topics`. Its first read reports that everything may have changed.
    pub fn follow(&self, topics: Topics) -> Cursor {
        self.log.follow(topics)
    }

    /// Forgets readers whose cursors are gone, before a snapshot of the memory that the journal lies in.
    pub fn drop_readers(&self) {
        self.log.drop_readers();
    }

    /// Changes since the last call with this cursor, oldest first.
    pub fn read(&self, cursor: &mut Cursor) -> Unread<'_> {
        self.log.read(cursor)
    }

    /// Skips all changes so far.
    pub fn skip(&self, cursor: &mut Cursor) {
        // The caller has just read the scene itself, so that it needs no changes from before.
        let _ = self.log.read(cursor);
    }

    /// Whether any reader wants changes about `topic`.
    pub fn is_followed(&self, topic: Topic) -> bool {
        self.log.stores(topic)
    }

    /// Whether anything changed about the topics of `mark` since the last call with it; the first time, and for a mark of another
    /// journal, it did.
    pub fn changed_since(&self, mark: &mut Mark) -> bool {
        let identity = self.log.identity();
        let known = mark
            .journal
            .as_ref()
            .is_some_and(|journal| Rc::ptr_eq(journal, identity));
        if known && mark.total == self.total {
            return false;
        }
        let of_topics = self.total_of(mark.topics);
        let changed = !known || mark.of_topics != of_topics;
        (mark.total, mark.of_topics) = (self.total, of_topics);
        if !known {
            mark.journal = Some(Rc::clone(identity));
        }
        changed
    }

    /// How many changes there were about some topics.
    pub fn total_of(&self, topics: Topics) -> u64 {
        topics.indices().map(|index| self.totals[index]).sum()
    }

    /// The numbers of changes of the tree so far.
    pub fn counters(&self) -> Counters {
        let total = |topics| self.total_of(topics) as i64;
        Counters {
            creations: total(Topics::NONE.with(Topic::Added)),
            destructions: total(Topics::NONE.with(Topic::Removed)),
            hierarchy: total(Topics::TREE),
        }
    }

    /// A journal that stores no more than so many changes.
    #[cfg(test)]
    fn with_limit(limit: usize) -> Self {
        Self {
            log: Log::with_limit(limit),
            ..Self::default()
        }
    }

    /// How many changes are stored.
    #[cfg(test)]
    fn stored(&self) -> usize {
        self.log.len()
    }
}
