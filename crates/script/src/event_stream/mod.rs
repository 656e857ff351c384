//! The stream of events of a simulator: what waits to be sent, in the form in which it is sent.
//!
//! What the events are about is not known here: `events` makes them from the changes of the scene.

pub(crate) mod encode;
mod filter;
pub(crate) mod protocol;
pub(crate) mod queue;

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

use crate::log::verbosity;
use queue::{Class, Content, Entry, Event, Queue, Source};
use scene::{Cursor, Data, Handle, Key, special};
use wire::cbor;

pub use filter::EventFilters;
pub(crate) use protocol::Protocol;

/// Bit of the options of `sim.pushUserEvent`.
const MERGEABLE: i64 = 1;

/// The stream of one simulator.
pub struct EventStream {
    /// Shared with every environment, which looks at it after each call that may have changed something.
    pub listening: Rc<Cell<bool>>,
    pub(crate) queue: RefCell<Queue>,
    /// What was sent last, as the readers of the scene keep it, while there are listeners.
    pub(crate) watch: RefCell<Option<Box<dyn Any>>>,
    /// Cursor into the scene's journal, while there are listeners.
    pub(crate) cursor: RefCell<Option<Cursor>>,
    pub(crate) next_seq: Cell<i64>,
    /// A scene without a snapshot sent yet.
    pub(crate) scene_is_new: Cell<bool>,
    /// Time, steps and state as last sent.
    pub(crate) clock: Cell<(f64, u64, i64)>,
    /// The version of the event protocol for listeners.
    pub protocol: Cell<Protocol>,
    /// The version that the next collection changes to.
    pub(crate) requested_protocol: Cell<Option<Protocol>>,
}

impl EventStream {
    /// A stream without listeners, of a scene not sent yet.
    pub(crate) fn new() -> Self {
        Self {
            listening: Rc::default(),
            queue: RefCell::default(),
            watch: RefCell::default(),
            cursor: RefCell::default(),
            next_seq: Cell::new(0),
            scene_is_new: Cell::new(true),
            clock: Cell::default(),
            protocol: Cell::default(),
            requested_protocol: Cell::default(),
        }
    }

    /// Adds an event to those that wait for the next dispatch.
    pub(crate) fn push(&self, event: Event) {
        self.queue.borrow_mut().push(event);
    }

    /// The first of `count` numbers for events.
    pub(crate) fn take_numbers(&self, count: usize) -> i64 {
        self.next_seq
            .replace(self.next_seq.get() + numbers::count(count))
    }

    /// Switches to another protocol: with listeners at the next collection, since they get what was before in the old one.
    pub(crate) fn request_protocol(&self, protocol: Protocol) {
        if self.listening.get() {
            self.requested_protocol.set(Some(protocol));
        } else {
            self.protocol.set(protocol);
        }
    }

    /// An event that a script defined.
    pub(crate) fn push_user_event(
        &self,
        name: String,
        (handle, uid): (i64, i64),
        data: &Data,
        options: i64,
    ) {
        if !self.listening.get() {
            return;
        }
        let source = Source {
            class: class_of(handle),
            handle,
            uid,
        };
        let topic = (options & MERGEABLE != 0).then(|| "".into());
        let event = Event {
            name: name.into(),
            source,
            data: user_content(data),
            topic,
        };
        self.push(event);
    }

    /// A line of the log.
    pub(crate) fn push_log_event(&self, origin: &str, level: i64, text: &str) {
        if !self.listening.get() {
            return;
        }
        let flag = |bits: i64| Data::Bool(level & bits == bits);
        let flags = Data::map([
            ("undecorated", flag(verbosity::UNDECORATED)),
            ("onlyterminal", flag(verbosity::ONLY_TERMINAL)),
        ]);
        let entries = vec![
            data_entry("origin", &Data::text(origin)),
            data_entry("msg", &Data::text(text)),
            int_entry("verbosity", verbosity::plain(level)),
            data_entry("flags", &flags),
        ];
        self.push(Event::new("logMsg", Source::NONE, entries));
    }
}

pub(crate) fn int_entry(key: &'static str, value: i64) -> Entry {
    data_entry(key, &Data::Int(value))
}

pub(crate) fn data_entry(key: &'static str, value: &Data) -> Entry {
    Entry {
        key: key.into(),
        value: cbor::encode(value),
    }
}

fn class_of(handle: i64) -> Class {
    match handle {
        special::APP => Class::App,
        special::SCENE => Class::Scene,
        _ if Handle::from_raw(handle).is_some() => Class::Object,
        _ => Class::None,
    }
}

/// Named members can be filtered; anything else goes as it is.
fn user_content(data: &Data) -> Content {
    let Data::Map(members) = data else {
        return Content::User(cbor::encode(data));
    };
    let entry = |(key, value): &(Key, Data)| match key {
        Key::Text(name) => {
            let key = String::from_utf8_lossy(name).into_owned();
            Some(Entry {
                key: key.into(),
                value: cbor::encode(value),
            })
        }
        _ => None,
    };
    let entries: Option<Vec<Entry>> = members.iter().map(entry).collect();
    entries.map_or_else(|| Content::User(cbor::encode(data)), Content::Entries)
}
