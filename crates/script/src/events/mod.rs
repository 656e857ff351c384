//! The event stream: all changes, for scripts with `sysCall_event` (spec: events).
//!
//! Without listeners nothing is collected. Otherwise every call that changed the scene is followed by
//! [`Sim::collect_events`], which turns the scene's journal into events: current values of properties are compared with those
//! last sent. One dispatch per loop iteration merges, numbers and delivers them.

mod collect;
mod encode;
mod filter;
mod genesis;
mod keys;
mod protocol;
mod queue;
mod watch;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use super::calls::callback::SysCall;
use super::lifecycle::instance::{Script, state};
use super::log::verbosity;
use super::sim::Sim;
use super::step::wall_clock;
use queue::{Class, Content, Entry, Event, Queue, Source};
use scene::{Cursor, Data, Handle, Key, Topics, special};
use watch::{Listeners, Watch};
use wire::cbor;

pub use filter::EventFilters;
pub(crate) use protocol::Protocol;

/// Bit of the options of `sim.pushUserEvent`.
const MERGEABLE: i64 = 1;

/// The stream of one simulator.
pub struct EventStream {
    /// Shared with every environment, which looks at it after each call that may have changed something.
    pub listening: Rc<Cell<bool>>,
    queue: RefCell<Queue>,
    watch: RefCell<Option<Watch>>,
    /// Cursor into the scene's journal, while there are listeners.
    cursor: RefCell<Option<Cursor>>,
    next_seq: Cell<i64>,
    /// A scene without a snapshot sent yet.
    scene_is_new: Cell<bool>,
    /// Time, steps and state as last sent.
    clock: Cell<(f64, u64, i64)>,
    /// The version of the event protocol for listeners.
    pub protocol: Cell<Protocol>,
}

impl EventStream {
    /// A stream without listeners, of a scene not sent yet.
    pub(super) fn new() -> Self {
        Self {
            listening: Rc::default(),
            queue: RefCell::default(),
            watch: RefCell::default(),
            cursor: RefCell::default(),
            next_seq: Cell::new(0),
            scene_is_new: Cell::new(true),
            clock: Cell::default(),
            protocol: Cell::default(),
        }
    }

    /// Adds an event to those that wait for the next dispatch.
    fn push(&self, event: Event) {
        self.queue.borrow_mut().push(event);
    }

    /// The first of `count` numbers for events.
    fn take_numbers(&self, count: usize) -> i64 {
        self.next_seq.replace(self.next_seq.get() + count as i64)
    }

    fn no_listeners(&self) -> Listeners {
        Listeners {
            protocol: self.protocol.get(),
            filters: Vec::new(),
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

impl Sim {
    /// Another script listens to events.
    pub(crate) fn add_event_listener(self: &Rc<Self>) {
        self.collect_events();
        let mut listeners = self
            .events
            .watch
            .take()
            .map_or_else(|| self.events.no_listeners(), |watch| watch.listeners);
        let first = listeners.filters.is_empty();
        listeners.filters.push(None);
        self.watch_for_listeners(listeners);
        if first && self.events.scene_is_new.replace(false) {
            self.push_genesis();
        }
    }

    /// Sets which events the state of `script` gets; None for all.
    pub(crate) fn set_event_filters(
        self: &Rc<Self>,
        script: &Script,
        filters: Option<EventFilters>,
    ) {
        let Some(runtime) = script.current_runtime() else {
            return;
        };
        runtime.env.event_filters.replace(filters);
        if self.events.listening.get() {
            self.collect_events();
            let listeners = self.listeners();
            self.watch_for_listeners(listeners);
        }
    }

    /// Watches on behalf of these listeners from now on; not at all when there are none.
    fn watch_for_listeners(self: &Rc<Self>, listeners: Listeners) {
        let listening = !listeners.filters.is_empty();
        self.events.listening.set(listening);
        self.read_journal_while(listening);
        let watch = listening.then(|| Watch::new(self, listeners));
        if !listening {
            self.events.queue.take();
        }
        self.events.clock.set(self.clock_values());
        self.events.watch.replace(watch);
    }

    /// Begins to read the journal of the scene as it is now, goes on, or stops.
    fn read_journal_while(&self, listening: bool) {
        let mut cursor = self.events.cursor.borrow_mut();
        if !listening {
            *cursor = None;
        } else if cursor.is_none() {
            let scene = self.scene.borrow();
            let mut new = scene.journal().follow(Topics::ALL);
            scene.journal().skip(&mut new);
            *cursor = Some(new);
        }
    }

    /// All scripts that listen.
    fn listeners(&self) -> Listeners {
        let scripts = self.scripts.all();
        let runtimes = scripts.iter().filter_map(|script| script.current_runtime());
        let listening = runtimes.filter(|runtime| runtime.env.responds_to(SysCall::Event));
        let filters = listening
            .map(|runtime| runtime.env.event_filters.borrow().clone())
            .collect();
        Listeners {
            filters,
            ..self.events.no_listeners()
        }
    }

    /// Delivers what has happened since the last dispatch, as one batch per script.
    pub(crate) fn dispatch_events(self: &Rc<Self>) {
        if !self.events.listening.get() {
            self.events.scene_is_new.set(false);
            return;
        }
        self.update_listeners();
        self.collect_events();
        self.collect_unrecorded_changes();
        self.deliver_pending_events();
    }

    /// Listeners that are gone need no watching.
    fn update_listeners(self: &Rc<Self>) {
        let listeners = self.listeners();
        let same = self
            .events
            .watch
            .borrow()
            .as_ref()
            .is_some_and(|watch| watch.listeners == listeners);
        if !same {
            self.collect_events();
            self.watch_for_listeners(listeners);
        }
    }

    fn deliver_pending_events(self: &Rc<Self>) {
        if self.events.queue.borrow().is_empty() {
            return;
        }
        let mut events = self.events.queue.borrow_mut().take();
        self.fill_in_lists(&mut events);
        let now = int_entry("time", wall_clock::unix_milliseconds());
        events.push(Event::new("msgDispatchTime", Source::NONE, vec![now]));
        let first = self.events.take_numbers(events.len());
        self.deliver_events(&events, first);
    }

    /// Delivers events numbered from `first` to all listeners, filtered for each.
    fn deliver_events(self: &Rc<Self>, events: &[Event], first: i64) {
        let mut whole: Option<Data> = None;
        for script in self.active_scripts().iter() {
            let Some(runtime) = script.current_runtime() else {
                continue;
            };
            if script.base_state() != state::INITIALIZED || !runtime.env.responds_to(SysCall::Event)
            {
                continue;
            }
            let filters = runtime.env.event_filters.borrow().clone();
            let batch = |filters: Option<&EventFilters>| {
                queue::batch(events, first, filters).map(Data::Buffer)
            };
            let wanted = match &filters {
                None => Some(
                    whole
                        .get_or_insert_with(|| batch(None).unwrap_or(Data::Nil))
                        .clone(),
                ),
                Some(filters) => batch(Some(filters)),
            };
            if let Some(batch) = wanted {
                self.deliver(script, SysCall::Event, &[batch]);
            }
        }
    }

    /// Switches to another protocol; listeners receive a new snapshot.
    pub(crate) fn set_event_protocol(self: &Rc<Self>, protocol: Protocol) {
        if self.events.protocol.get() == protocol {
            return;
        }
        self.collect_events();
        self.events.protocol.set(protocol);
        if self.events.listening.get() {
            self.watch_for_listeners(self.listeners());
            self.push_genesis();
        }
    }

    /// Another scene has taken the place of the one before.
    pub(crate) fn note_new_scene(self: &Rc<Self>) {
        if self.events.listening.get() {
            self.collect_events();
            self.push_genesis();
        } else {
            self.events.scene_is_new.set(true);
        }
    }

    /// More changed than the journal holds: listeners get a new snapshot.
    fn restart_events(self: &Rc<Self>) {
        let Some(watch) = self.events.watch.take() else {
            return;
        };
        self.watch_for_listeners(watch.listeners);
        self.push_genesis();
    }

    fn push_genesis(self: &Rc<Self>) {
        self.genesis()
            .into_iter()
            .for_each(|event| self.events.push(event));
    }

    /// A snapshot of everything, as one batch. What is pending is dispatched first, so that the next batch continues the numbers.
    pub(crate) fn genesis_events(self: &Rc<Self>) -> Vec<u8> {
        if self.events.listening.get() {
            self.collect_events();
            self.collect_unrecorded_changes();
            self.deliver_pending_events();
        }
        let events = self.genesis();
        let count = events.len() as i64;
        // The numbers a snapshot at the start would have had.
        let next = self.events.next_seq.get().max(count);
        self.events.next_seq.set(next);
        queue::batch(&events, next - count, None).unwrap_or_default()
    }
}

fn int_entry(key: &'static str, value: i64) -> Entry {
    data_entry(key, &Data::Int(value))
}

fn data_entry(key: &'static str, value: &Data) -> Entry {
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
