//! The world outside of the simulator.

use std::rc::Rc;

use super::Cx;
use crate::io::EventLoop;

impl Cx<'_> {
    /// The event loop of this simulator's sockets.
    ///
    /// # Errors
    /// When the system cannot create one.
    pub(crate) fn event_loop(&self) -> std::io::Result<Rc<EventLoop>> {
        self.sim.event_loop.get()
    }
}
