//! The event loop that all sockets of a simulator share; made at first need.

use std::cell::OnceCell;
use std::rc::Rc;
use std::time::Duration;

use io::EventLoop;

/// The event loop of one simulator.
#[derive(Default)]
pub struct SharedEventLoop(OnceCell<Rc<EventLoop>>);

impl SharedEventLoop {
    /// The event loop, which is created by the first call.
    ///
    /// # Errors
    /// When the system cannot create one.
    pub fn get(&self) -> std::io::Result<Rc<EventLoop>> {
        if let Some(event_loop) = self.0.get() {
            return Ok(event_loop.clone());
        }
        let event_loop = Rc::new(EventLoop::new()?);
        Ok(self.0.get_or_init(|| event_loop).clone())
    }

    /// Runs the sockets until input arrives, at most for `limit`; false at once if there are no sockets.
    pub fn wait_for_input(&self, limit: Duration) -> bool {
        self.0.get().is_some_and(|event_loop| {
            event_loop.wait(limit);
            true
        })
    }
}
