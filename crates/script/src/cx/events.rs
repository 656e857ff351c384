//! The stream of events.

use super::Cx;
use crate::event_stream::EventFilters;
use crate::sys_call::SysCall;
use scene::Data;

impl Cx<'_> {
    /// Notes that the calling script has a callback, whether or not it defines a function of that name.
    pub fn note_callback(&mut self, call: SysCall) {
        self.sim.note_callbacks(call.bit());
    }

    /// Sets which events the calling script gets; None for all.
    pub fn set_event_filters(&mut self, filters: Option<EventFilters>) {
        self.sim.set_event_filters(self.script(), filters);
    }

    /// A snapshot of everything, as one batch. What is pending is delivered first.
    pub fn genesis_events(&mut self) -> Vec<u8> {
        self.sim.genesis_events()
    }

    /// An event of the calling script's own.
    pub fn push_user_event(&mut self, name: String, source: (i64, i64), data: &Data, options: i64) {
        self.sim.events.push_user_event(name, source, data, options);
    }
}
