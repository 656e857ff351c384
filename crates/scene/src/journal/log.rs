//! The stored changes, and the position of each reader.

use std::cell::{Cell, RefCell};
use std::collections::{VecDeque, vec_deque};
use std::rc::{Rc, Weak};

use super::{Change, Topic, Topics};

/// So many changes are stored at most: some ten megabytes.
const MAX_STORED: usize = 1 << 18;
/// With fewer stored changes, dropping those that all readers have read is not worth the time.
const MIN_TRIM_LENGTH: usize = 64;
/// Position of a cursor that has not read yet.
const NEVER_READ: u64 = u64::MAX;

/// A reader's place in the journal of a scene.
#[derive(Debug)]
pub struct Cursor {
    journal: Rc<()>,
    topics: Topics,
    /// Number of the next change to read; the journal uses it to drop changes that all readers have read.
    next: Rc<Cell<u64>>,
}

/// Changes that a cursor has not read yet.
#[derive(Debug)]
pub enum Unread<'a> {
    /// The reader is new or too far behind, or the scene is another one: all it knows may be wrong.
    Everything,
    /// All changes since the last reading.
    Changes(Changes<'a>),
}

/// Changes in the order they were made.
#[derive(Debug, Clone)]
pub struct Changes<'a> {
    stored: vec_deque::Iter<'a, Change>,
    topics: Topics,
}

impl<'a> Iterator for Changes<'a> {
    type Item = &'a Change;

    fn next(&mut self) -> Option<&'a Change> {
        let topics = self.topics;
        self.stored.find(|change| topics.contains(change.topic()))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (0, self.stored.size_hint().1)
    }
}

impl<'a> DoubleEndedIterator for Changes<'a> {
    fn next_back(&mut self) -> Option<&'a Change> {
        let topics = self.topics;
        self.stored.rfind(|change| topics.contains(change.topic()))
    }
}

#[derive(Debug)]
struct Reader {
    /// Gone with its cursor.
    next: Weak<Cell<u64>>,
    topics: Topics,
}

/// Changes that some cursor wants and has not read, and some that all have read.
#[derive(Debug)]
pub(super) struct Log {
    /// Distinguishes cursors and marks of this journal from those of another.
    identity: Rc<()>,
    stored: VecDeque<Change>,
    /// Number of the first change stored.
    first: u64,
    wanted: Cell<Topics>,
    readers: RefCell<Vec<Reader>>,
    /// At this length, changes that all readers have read are dropped.
    trim_at: usize,
    limit: usize,
}

impl Default for Log {
    fn default() -> Self {
        Self {
            identity: Rc::default(),
            stored: VecDeque::new(),
            first: 0,
            wanted: Cell::default(),
            readers: RefCell::default(),
            trim_at: MIN_TRIM_LENGTH,
            limit: MAX_STORED,
        }
    }
}

impl Log {
    pub(super) fn identity(&self) -> &Rc<()> {
        &self.identity
    }

    pub(super) fn stores(&self, topic: Topic) -> bool {
        self.wanted.get().contains(topic)
    }

    /// Stores a change if any reader wants it.
    pub(super) fn push(&mut self, topic: Topic, change: Change) {
        if self.stores(topic) {
            self.stored.push_back(change);
            if self.stored.len() >= self.trim_at {
                self.trim();
            }
        }
    }

    pub(super) fn follow(&self, topics: Topics) -> Cursor {
        let cursor = Cursor {
            journal: Rc::clone(&self.identity),
            topics,
            next: Rc::new(Cell::new(NEVER_READ)),
        };
        self.readers.borrow_mut().push(Reader {
            next: Rc::downgrade(&cursor.next),
            topics,
        });
        self.wanted.set(self.wanted.get().and(topics));
        cursor
    }

    pub(super) fn read(&self, cursor: &mut Cursor) -> Unread<'_> {
        if !Rc::ptr_eq(&cursor.journal, &self.identity) {
            *cursor = self.follow(cursor.topics);
        }
        let next = cursor.next.replace(self.first + self.stored.len() as u64);
        if next == NEVER_READ || next < self.first {
            return Unread::Everything;
        }
        let stored = self.stored.range((next - self.first) as usize..);
        Unread::Changes(Changes {
            stored,
            topics: cursor.topics,
        })
    }

    /// Drops readers that are gone.
    pub(super) fn drop_readers(&self) {
        let mut readers = self.readers.borrow_mut();
        readers.retain(|reader| reader.next.strong_count() > 0);
        self.wanted.set(
            readers
                .iter()
                .fold(Topics::NONE, |wanted, reader| wanted.and(reader.topics)),
        );
    }

    /// Drops readers that are gone, changes that all have read, and the older half of a full log.
    fn trim(&mut self) {
        self.drop_readers();
        let readers = self.readers.get_mut();
        let end = self.first + self.stored.len() as u64;
        let places = readers
            .iter()
            .filter_map(|reader| reader.next.upgrade())
            .map(|next| next.get());
        // A cursor that is already too far behind reports that everything changed, and needs none of this.
        let slowest = places
            .filter(|next| (self.first..end).contains(next))
            .min()
            .unwrap_or(end);
        let read = (slowest - self.first) as usize;
        let unread = self.stored.len() - read;
        self.drop_oldest(if unread >= self.limit {
            read + unread.div_ceil(2)
        } else {
            read
        });
        self.trim_at = (2 * self.stored.len()).clamp(MIN_TRIM_LENGTH.min(self.limit), self.limit);
    }

    fn drop_oldest(&mut self, count: usize) {
        self.stored.drain(..count);
        self.first += count as u64;
    }

    #[cfg(test)]
    pub(super) fn with_limit(limit: usize) -> Self {
        Self {
            limit,
            trim_at: MIN_TRIM_LENGTH.min(limit),
            ..Self::default()
        }
    }

    #[cfg(test)]
    pub(super) fn len(&self) -> usize {
        self.stored.len()
    }
}
