//! The stream of events: everything that changes, told to the scripts that have `sysCall_event` (spec: events).
//!
//! Nothing is collected while nobody listens. While somebody does, every call that changed the scene is followed by
//! [`Sim::collect_events`], which turns the scene's journal into events: what a property is now is compared with what was
//! last told. One dispatch per loop iteration merges, numbers and delivers them.

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
use crate::scene::{Cursor, Data, Handle, Key, Topics, special};
use crate::wire::cbor;
use queue::{Class, Content, Entry, Event, Queue, Source};
use watch::{Audience, Watch};

pub(crate) use filter::Filters;
pub(crate) use protocol::Protocol;

/// Bit of the options of `sim.pushUserEvent`.
const MERGEABLE: i64 = 1;

/// The stream of one simulator.
pub(crate) struct EventStream {
    /// Shared with every Lua state, which looks at it after each call that may have changed something.
    pub listening: Rc<Cell<bool>>,
    queue: RefCell<Queue>,
    watch: RefCell<Option<Watch>>,
    /// Where the journal of the scene was read last, while somebody listens.
    cursor: RefCell<Option<Cursor>>,
    next_seq: Cell<i64>,
    /// A scene nobody was told about yet.
    scene_is_new: Cell<bool>,
    /// Time, steps and state as they were told.
    clock: Cell<(f64, u64, i64)>,
    pub protocol: Cell<Protocol>,
}

impl EventStream {
    /// A stream nobody listens to, of a scene nobody was told about.
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
}

impl Sim {
    /// A script that listens has come.
    pub(crate) fn add_event_listener(self: &Rc<Self>) {
        self.collect_events();
        let mut audience = self.events.watch.take().map_or_else(|| self.nobody(), |watch| watch.audience);
        let first = audience.filters.is_empty();
        audience.filters.push(None);
        self.watch_for(audience);
        if first && self.events.scene_is_new.replace(false) {
            self.push_genesis();
        }
    }

    /// Sets what the state of `script` wants to hear of; None for everything.
    pub(crate) fn set_event_filters(self: &Rc<Self>, script: &Script, filters: Option<Filters>) {
        let Some(runtime) = script.current_runtime() else { return };
        runtime.env.event_filters.replace(filters);
        if self.events.listening.get() {
            self.collect_events();
            let audience = self.audience();
            self.watch_for(audience);
        }
    }

    /// Begins to watch on behalf of `audience`, or begins anew; ends it when there is none.
    fn watch_for(self: &Rc<Self>, audience: Audience) {
        let listening = !audience.filters.is_empty();
        self.events.listening.set(listening);
        self.follow_scene(listening);
        let watch = listening.then(|| Watch::new(self, audience));
        if !listening {
            self.events.queue.take();
        }
        self.events.clock.set(self.clock_values());
        self.events.watch.replace(watch);
    }

    /// Begins to read the journal of the scene as it is now, goes on, or stops.
    fn follow_scene(&self, listening: bool) {
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

    /// An audience without listeners.
    fn nobody(&self) -> Audience {
        Audience { protocol: self.events.protocol.get(), filters: Vec::new() }
    }

    /// All scripts that listen.
    fn audience(&self) -> Audience {
        let scripts = self.scripts.all();
        let runtimes = scripts.iter().filter_map(|script| script.current_runtime());
        let listening = runtimes.filter(|runtime| runtime.env.responds_to(SysCall::Event));
        let filters = listening.map(|runtime| runtime.env.event_filters.borrow().clone()).collect();
        Audience { filters, ..self.nobody() }
    }

    /// Delivers what has happened since the last dispatch, as one batch per script.
    pub(crate) fn dispatch_events(self: &Rc<Self>) {
        if !self.events.listening.get() {
            self.events.scene_is_new.set(false);
            return;
        }
        self.update_audience();
        self.collect_events();
        self.collect_quiet_changes();
        self.deliver_pending_events();
    }

    /// Listeners that are gone need no watching.
    fn update_audience(self: &Rc<Self>) {
        let audience = self.audience();
        let same = self.events.watch.borrow().as_ref().is_some_and(|watch| watch.audience == audience);
        if !same {
            self.collect_events();
            self.watch_for(audience);
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
        let first = self.events.next_seq.get();
        self.events.next_seq.set(first + events.len() as i64);
        self.deliver_events(&events, first);
    }

    /// Delivers events numbered from `first` to everyone who listens, as much of them as each wants.
    fn deliver_events(self: &Rc<Self>, events: &[Event], first: i64) {
        let mut whole: Option<Data> = None;
        for script in self.active_scripts().iter() {
            let Some(runtime) = script.current_runtime() else { continue };
            if script.base_state() != state::INITIALIZED || !runtime.env.responds_to(SysCall::Event) {
                continue;
            }
            let filters = runtime.env.event_filters.borrow().clone();
            let batch = |filters: Option<&Filters>| queue::batch(events, first, filters).map(Data::Buffer);
            let wanted = match &filters {
                None => Some(whole.get_or_insert_with(|| batch(None).unwrap_or(Data::Nil)).clone()),
                Some(filters) => batch(Some(filters)),
            };
            if let Some(batch) = wanted {
                self.deliver(script, SysCall::Event, &[batch]);
            }
        }
    }

    /// Goes over to another dialect; listeners are told everything anew in it.
    pub(crate) fn set_event_protocol(self: &Rc<Self>, protocol: Protocol) {
        if self.events.protocol.get() == protocol {
            return;
        }
        self.collect_events();
        self.events.protocol.set(protocol);
        if self.events.listening.get() {
            self.watch_for(self.audience());
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

    /// More changed than the journal holds: listeners are told everything anew.
    fn begin_anew(self: &Rc<Self>) {
        let Some(watch) = self.events.watch.take() else { return };
        self.watch_for(watch.audience);
        self.push_genesis();
    }

    fn push_genesis(self: &Rc<Self>) {
        let events = self.genesis();
        let mut queue = self.events.queue.borrow_mut();
        events.into_iter().for_each(|event| queue.push(event));
    }

    /// A snapshot of everything, as one batch. What is pending is dispatched first, so that the next batch continues the numbers.
    pub(crate) fn genesis_events(self: &Rc<Self>) -> Vec<u8> {
        if self.events.listening.get() {
            self.collect_events();
            self.collect_quiet_changes();
            self.deliver_pending_events();
        }
        let events = self.genesis();
        let count = events.len() as i64;
        // The numbers a snapshot at the start would have had.
        let next = self.events.next_seq.get().max(count);
        self.events.next_seq.set(next);
        queue::batch(&events, next - count, None).unwrap_or_default()
    }

    /// An event a script made up.
    pub(crate) fn push_user_event(&self, name: String, (handle, uid): (i64, i64), data: &Data, options: i64) {
        if !self.events.listening.get() {
            return;
        }
        let source = Source { class: class_of(handle), handle, uid };
        let topic = (options & MERGEABLE != 0).then(|| "".into());
        let event = Event { name: name.into(), source, data: user_content(data), topic };
        self.events.queue.borrow_mut().push(event);
    }

    /// A line of the log.
    pub(crate) fn push_log_event(&self, origin: &str, level: i64, text: &str) {
        if !self.events.listening.get() {
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
        self.events.queue.borrow_mut().push(Event::new("logMsg", Source::NONE, entries));
    }
}

fn int_entry(key: &'static str, value: i64) -> Entry {
    data_entry(key, &Data::Int(value))
}

fn data_entry(key: &'static str, value: &Data) -> Entry {
    Entry { key: key.into(), value: cbor::encode(value) }
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
    let Data::Map(members) = data else { return Content::User(cbor::encode(data)) };
    let entry = |(key, value): &(Key, Data)| match key {
        Key::Text(name) => {
            let key = String::from_utf8_lossy(name).into_owned();
            Some(Entry { key: key.into(), value: cbor::encode(value) })
        }
        _ => None,
    };
    let entries: Option<Vec<Entry>> = members.iter().map(entry).collect();
    entries.map_or_else(|| Content::User(cbor::encode(data)), Content::Entries)
}
