//! The event stream: all changes, for scripts with `sysCall_event` (spec: events).
//!
//! Without listeners nothing is collected. Otherwise every call that changed the scene is followed by
//! [`Sim::collect_events`], which turns the scene's journal into events: current values of properties are compared with those
//! last sent. One dispatch per loop iteration merges, numbers and delivers them.

mod collect;
mod genesis;
mod keys;
mod watch;

use std::any::Any;
use std::rc::Rc;

use crate::event_stream::EventFilters;
use crate::host::{Env, Script, Sim};
use crate::sys_call::SysCall;
use scene::Topics;
use watch::{Listeners, Watch};

impl Env {
    /// Turns the changes of a call into events, if there are listeners.
    pub(crate) fn collect_events(&self) {
        if self.events_wanted.get()
            && let Some(sim) = self.sim.upgrade()
        {
            sim.collect_events();
        }
    }
}

impl Sim {
    /// Another script listens to events.
    pub(crate) fn add_event_listener(self: &Rc<Self>) {
        self.collect_events();
        let mut listeners = self
            .take_watch()
            .map_or_else(|| self.no_listeners(), |watch| watch.listeners);
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
        let watch = watch.map(|watch| Box::new(watch) as Box<dyn Any>);
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
            ..self.no_listeners()
        }
    }

    /// Listeners that are gone need no watching.
    pub(crate) fn update_listeners(self: &Rc<Self>) {
        let listeners = self.listeners();
        let same = self
            .events
            .watch
            .borrow()
            .as_ref()
            .and_then(|watch| watch.downcast_ref::<Watch>())
            .is_some_and(|watch| watch.listeners == listeners);
        if !same {
            self.collect_events();
            self.watch_for_listeners(listeners);
        }
    }

    /// Switches to the protocol that was asked for, if any; listeners receive a new snapshot.
    fn change_protocol(self: &Rc<Self>) {
        let Some(protocol) = self.events.requested_protocol.take() else {
            return;
        };
        if self.events.protocol.replace(protocol) != protocol {
            self.watch_for_listeners(self.listeners());
            self.push_genesis();
        }
    }

    fn no_listeners(&self) -> Listeners {
        Listeners {
            protocol: self.events.protocol.get(),
            filters: Vec::new(),
        }
    }

    /// What was sent last; nothing is watched until it is put back.
    fn take_watch(&self) -> Option<Box<Watch>> {
        self.events.watch.take()?.downcast().ok()
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
        let Some(watch) = self.take_watch() else {
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
}
