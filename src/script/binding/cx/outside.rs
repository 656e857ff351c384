//! External resources of modules: sockets, ports, tubes, semaphores.

use std::cell::{Ref, RefMut};
use std::rc::Rc;

use super::Cx;
use crate::io::{EventLoop, Numbers, SerialPort, WsEndpoint};
use crate::script::binding::by_handle::ByHandle;
use crate::script::channels::tubes::Tubes;
use crate::script::channels::web_sockets::{Endpoint, Role};
use crate::script::error::ApiResult;

impl Cx<'_> {
    /// The event loop of this simulator's sockets.
    ///
    /// # Errors
    /// When the system has none.
    pub(crate) fn event_loop(&self) -> std::io::Result<Rc<EventLoop>> {
        self.sim.channels.event_loop()
    }

    /// The numbers of WebSocket endpoints and connections.
    pub(crate) fn web_socket_numbers(&self) -> Numbers {
        self.sim.channels.web_sockets.borrow().numbers.clone()
    }

    pub(crate) fn web_socket(&self, number: u64) -> Option<Rc<Endpoint>> {
        self.sim.channels.web_socket(number)
    }

    /// Adds an endpoint of the calling script.
    pub(crate) fn add_web_socket(&mut self, role: Role, socket: WsEndpoint) -> Rc<Endpoint> {
        self.sim.add_web_socket(self, role, socket)
    }

    /// Closes an endpoint and all its connections at once.
    pub(crate) fn stop_web_socket(&mut self, number: u64) {
        self.sim.channels.stop_web_socket(number);
    }

    pub(crate) fn serial_ports_mut(&mut self) -> RefMut<'_, ByHandle<SerialPort>> {
        self.sim.channels.serial_ports.borrow_mut()
    }

    pub(crate) fn tubes(&self) -> Ref<'_, Tubes> {
        self.sim.channels.tubes.borrow()
    }

    pub(crate) fn tubes_mut(&mut self) -> RefMut<'_, Tubes> {
        self.sim.channels.tubes.borrow_mut()
    }

    /// Waits until no other program holds the semaphore; at once if this simulator does already.
    ///
    /// # Errors
    /// When the key is too long, its file cannot be made, or the user wants the program to end.
    pub(crate) fn acquire_semaphore(&mut self, key: &[u8]) -> ApiResult<()> {
        self.sim.acquire_semaphore(key)
    }

    pub(crate) fn release_semaphore(&mut self, key: &[u8]) {
        self.sim.channels.semaphores.borrow_mut().release(key);
    }
}
