//! Pending events: merged, numbered and encoded as one batch (spec: events 1, events 3, events 4).

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::hash::{BuildHasherDefault, Hasher};

use super::{EventFilters, encode};
use scene::{Handle, Uid, special};
use wire::cbor_head::push_int;

/// A name that is nearly always known at compile time.
pub(crate) type Name = Cow<'static, str>;

/// The kind of the subject of an event; filters name kinds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Nothing in particular: a log line, the ends of a snapshot.
    None,
    App,
    Scene,
    Object,
    Mesh,
    Main,
    Sandbox,
    AddOn,
}

/// The subject of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Source {
    pub class: Class,
    /// -1 is left out.
    pub handle: i64,
    /// -1 is left out.
    pub uid: i64,
}

impl Source {
    pub const NONE: Self = Self {
        class: Class::None,
        handle: -1,
        uid: -1,
    };
    pub const APP: Self = Self {
        class: Class::App,
        handle: special::APP,
        uid: special::APP,
    };
    pub const SCENE: Self = Self {
        class: Class::Scene,
        handle: special::SCENE,
        uid: special::SCENE,
    };

    pub(crate) fn object(handle: Handle, uid: Uid) -> Self {
        Self {
            class: Class::Object,
            handle: handle.raw(),
            uid,
        }
    }
}

/// One member of an event's data, its value already encoded. An empty value is filled in at dispatch.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub key: Name,
    pub value: Vec<u8>,
}

/// One event before it has its number.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Event {
    pub name: Name,
    pub source: Source,
    pub data: Content,
    /// A later one of the same name, source and topic replaces it.
    pub topic: Option<Name>,
}

/// The data of an event.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Content {
    Entries(Vec<Entry>),
    /// Data from a script, already encoded as a map.
    User(Vec<u8>),
}

type MergeId = (Name, Name, i64);

impl Event {
    pub(crate) fn new(name: &'static str, source: Source, entries: Vec<Entry>) -> Self {
        Self {
            name: name.into(),
            source,
            data: Content::Entries(entries),
            topic: None,
        }
    }

    /// The new value of properties that change together; only the latest is sent.
    pub(crate) fn changed(source: Source, entries: Vec<Entry>) -> Self {
        let topic = entries.first().map(|entry| entry.key.clone());
        Self {
            topic,
            ..Self::new("objectChanged", source, entries)
        }
    }

    /// A list of the scene; its value is filled in at dispatch, since a list per new object would take quadratic time.
    pub(crate) fn list(key: &'static str) -> Self {
        Self::changed(
            Source::SCENE,
            vec![Entry {
                key: key.into(),
                value: Vec::new(),
            }],
        )
    }

    pub(crate) fn entries_mut(&mut self) -> &mut [Entry] {
        match &mut self.data {
            Content::Entries(entries) => entries,
            Content::User(_) => &mut [],
        }
    }

    fn merge_id(&self) -> Option<MergeId> {
        Some((self.name.clone(), self.topic.clone()?, self.source.uid))
    }
}

/// Hashes eight bytes at a time. The keys are from here, and nothing depends on their order.
#[derive(Default)]
struct WordHasher(u64);

impl Hasher for WordHasher {
    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }

    fn write(&mut self, bytes: &[u8]) {
        let (words, rest) = bytes.as_chunks::<8>();
        words
            .iter()
            .for_each(|word| self.write_u64(u64::from_le_bytes(*word)));
        self.write_u64(
            rest.iter()
                .fold(rest.len() as u64, |word, &byte| word << 8 | u64::from(byte)),
        );
    }

    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(26) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn write_i64(&mut self, word: i64) {
        self.write_u64(word.cast_unsigned());
    }

    fn write_u8(&mut self, byte: u8) {
        self.write_u64(byte.into());
    }
}

/// The events since the last dispatch, in order.
#[derive(Debug, Default)]
pub(crate) struct Queue {
    events: BTreeMap<u64, Event>,
    latest: HashMap<MergeId, u64, BuildHasherDefault<WordHasher>>,
    pushed: u64,
}

impl Queue {
    pub(crate) fn push(&mut self, event: Event) {
        self.pushed += 1;
        if let Some(id) = event.merge_id()
            && let Some(earlier) = self.latest.insert(id, self.pushed)
        {
            self.events.remove(&earlier);
        }
        self.events.insert(self.pushed, event);
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.events.is_empty()
    }

    pub(crate) fn take(&mut self) -> Vec<Event> {
        self.latest.clear();
        std::mem::take(&mut self.events).into_values().collect()
    }
}

/// Events as one batch, numbered from `first`; None when the filter leaves nothing.
pub(crate) fn batch(
    events: &[Event],
    first: i64,
    filters: Option<&EventFilters>,
) -> Option<Vec<u8>> {
    let mut out = vec![encode::LIST];
    for (seq, event) in (first..).zip(events) {
        write_event(event, seq, filters, &mut out);
    }
    let empty = out.len() == 1;
    out.push(encode::END);
    (!empty).then_some(out)
}

fn write_event(event: &Event, seq: i64, filters: Option<&EventFilters>, out: &mut Vec<u8>) {
    let keys = match filters.map(|filters| filters.keys_of(event.source)) {
        Some(None) => return,
        Some(keys) => keys,
        None => None,
    };
    let wanted = |entry: &&Entry| keys.is_none_or(|keys| keys.contains(&entry.key));
    if let Content::Entries(entries) = &event.data
        && !entries.is_empty()
        && !entries.iter().any(|entry| wanted(&entry))
    {
        return;
    }
    out.push(encode::MAP);
    member(out, "event", |out| encode::text(out, event.name.as_bytes()));
    for (key, number) in [("uid", event.source.uid), ("handle", event.source.handle)] {
        if number != -1 {
            member(out, key, |out| push_int(out, number));
        }
    }
    member(out, "data", |out| write_data(out, &event.data, wanted));
    member(out, "seq", |out| push_int(out, seq));
    out.push(encode::END);
}

/// The wanted members as a map.
fn write_data(out: &mut Vec<u8>, content: &Content, wanted: impl Fn(&&Entry) -> bool) {
    let entries = match content {
        Content::User(map) => return out.extend(map),
        Content::Entries(entries) => entries,
    };
    out.push(encode::MAP);
    for entry in entries.iter().filter(wanted) {
        encode::text(out, entry.key.as_bytes());
        out.extend(&entry.value);
    }
    out.push(encode::END);
}

fn member(out: &mut Vec<u8>, key: &str, value: impl FnOnce(&mut Vec<u8>)) {
    encode::text(out, key.as_bytes());
    value(out);
}

#[cfg(test)]
mod tests {
    use super::{Class, Content, Entry, Event, Queue, Source, batch};

    fn event(uid: i64, key: &'static str, value: u8) -> Event {
        let source = Source {
            class: Class::Object,
            handle: uid,
            uid,
        };
        Event::changed(
            source,
            vec![Entry {
                key: key.into(),
                value: vec![value],
            }],
        )
    }

    fn values(events: &[Event]) -> Vec<u8> {
        let value = |event: &Event| match &event.data {
            Content::Entries(entries) => entries[0].value[0],
            Content::User(_) => 0,
        };
        events.iter().map(value).collect()
    }

    #[test]
    fn the_last_of_the_same_kind_stays_at_its_own_place() {
        let mut queue = Queue::default();
        for (uid, key, value) in [(1, "a", 1), (2, "a", 2), (1, "b", 3), (1, "a", 4)] {
            queue.push(event(uid, key, value));
        }
        for value in [5, 6] {
            queue.push(Event {
                topic: None,
                ..event(1, "c", value)
            });
        }
        assert_eq!(values(&queue.take()), [2, 3, 4, 5, 6]);
        assert!(queue.is_empty());
    }

    #[test]
    fn a_batch_is_open_ended_and_numbers_its_events() {
        let bytes = batch(&[event(1, "a", 0xf5)], 7, None).expect("there is an event");
        let expected =
            b"\x9f\xbf\x65event\x6dobjectChanged\x63uid\x01\x66handle\x01\x64data\xbf\x61a\xf5\xff\x63seq\x07\xff\xff";
        assert_eq!(bytes, expected);
    }
}
