//! Communication channels of scripts: tubes, semaphores, serial ports, WebSocket endpoints, and the event loop of the sockets.

pub(in crate::script) mod system_semaphore;
pub(in crate::script) mod tubes;
pub(in crate::script) mod web_socket_log;
pub(crate) mod web_sockets;

use std::cell::{OnceCell, RefCell};
use std::rc::Rc;
use std::time::Duration;

use super::binding::by_handle::ByHandle;
use crate::io::{EventLoop, SerialPort};
use system_semaphore::SystemSemaphores;
use tubes::Tubes;
use web_sockets::{Endpoint, WebSockets};

/// The open channels of one simulator.
#[derive(Default)]
pub(crate) struct Channels {
    pub(in crate::script) tubes: RefCell<Tubes>,
    pub(in crate::script) semaphores: RefCell<SystemSemaphores>,
    pub(in crate::script) serial_ports: RefCell<ByHandle<SerialPort>>,
    pub(in crate::script) web_sockets: RefCell<WebSockets>,
    /// Where all sockets live; made at first need.
    event_loop: OnceCell<Rc<EventLoop>>,
}

impl Channels {
    /// The event loop of this simulator's sockets.
    ///
    /// # Errors
    /// When the system cannot create one.
    pub(crate) fn event_loop(&self) -> std::io::Result<Rc<EventLoop>> {
        if let Some(event_loop) = self.event_loop.get() {
            return Ok(event_loop.clone());
        }
        let event_loop = Rc::new(EventLoop::new()?);
        Ok(self.event_loop.get_or_init(|| event_loop).clone())
    }

    /// Runs the sockets until something has arrived, at most that long; false at once when there are none.
    pub(crate) fn wait_for_arrival(&self, limit: Duration) -> bool {
        self.event_loop.get().is_some_and(|event_loop| {
            event_loop.wait(limit);
            true
        })
    }

    pub(crate) fn web_socket(&self, number: u64) -> Option<Rc<Endpoint>> {
        self.web_sockets.borrow().get(number)
    }

    /// Closes an endpoint and all its connections at once.
    pub(crate) fn stop_web_socket(&self, number: u64) {
        let endpoint = self.web_sockets.borrow_mut().remove(number);
        // Nothing is borrowed while connections end and handlers are released.
        if let Some(endpoint) = endpoint {
            endpoint.stop();
        }
    }

    /// Closes the tubes that end with the interpreter of a script.
    pub(in crate::script) fn end_script(&self, script: i64) {
        self.tubes.borrow_mut().close_those_of(script);
    }

    /// Closes what ends with the simulation.
    pub(in crate::script) fn end_simulation(&self) {
        self.serial_ports.borrow_mut().clear();
    }
}
