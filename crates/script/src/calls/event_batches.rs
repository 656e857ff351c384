//! Delivery of events, as one batch per script (`sysCall_event`; spec: events).

use std::rc::Rc;

use crate::event_stream::queue::{self, Event, Source};
use crate::event_stream::{EventFilters, int_entry};
use crate::host::{Sim, state};
use crate::sys_call::SysCall;
use crate::wall_clock;
use scene::Data;

impl Sim {
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

    fn deliver_pending_events(self: &Rc<Self>) {
        if self.events.queue.borrow().is_empty() {
            return;
        }
        let mut events = self.events.queue.borrow_mut().take();
        self.fill_in_lists(&mut events);
        let tape = self.options.permissions.tape();
        let now = tape.input("the time of an event", wall_clock::unix_milliseconds);
        let now = int_entry("time", now.unwrap_or_default());
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

    /// A snapshot of everything, as one batch. What is pending is dispatched first, so that the next batch continues the numbers.
    pub(crate) fn genesis_events(self: &Rc<Self>) -> Vec<u8> {
        if self.events.listening.get() {
            self.collect_events();
            self.collect_unrecorded_changes();
            self.deliver_pending_events();
        }
        let events = self.genesis();
        let count = numbers::count(events.len());
        // The numbers a snapshot at the start would have had.
        let next = self.events.next_seq.get().max(count);
        self.events.next_seq.set(next);
        queue::batch(&events, next - count, None).unwrap_or_default()
    }
}
