//! What modules hold of the world outside: sockets, ports, tubes, semaphores.

use std::cell::{OnceCell, Ref, RefMut};
use std::net::TcpListener;
use std::rc::Rc;

use super::Cx;
use crate::io::{EventLoop, Numbers, SerialPort, WsEndpoint, ZmqServer, zmq};
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
        self.sim.event_loop()
    }

    /// Where programs outside call functions, by ZeroMQ.
    pub(crate) fn zmq_server(&self) -> Option<Rc<ZmqServer>> {
        self.sim.zmq_server()
    }

    /// The ZeroMQ context all scripts share; made at first need.
    pub(crate) fn zmq_context(&self) -> &OnceCell<Rc<zmq::Context>> {
        &self.sim.zmq_context
    }

    /// Shares of it are counted: each script that has ZeroMQ sockets holds one.
    pub(crate) fn zmq_users(&self) -> &Rc<()> {
        &self.sim.zmq_users
    }

    /// Where the WebSocket remote API listens.
    pub(crate) fn remote_listener(&self) -> Option<std::io::Result<TcpListener>> {
        self.sim.remote_listener.borrow().as_ref().map(TcpListener::try_clone)
    }

    /// The numbers of WebSocket endpoints and connections.
    pub(crate) fn web_socket_numbers(&self) -> Numbers {
        self.sim.web_sockets.borrow().numbers.clone()
    }

    pub(crate) fn web_socket(&self, number: u64) -> Option<Rc<Endpoint>> {
        self.sim.web_socket(number)
    }

    /// Adds an endpoint of the calling script.
    pub(crate) fn add_web_socket(&mut self, role: Role, socket: WsEndpoint) -> Rc<Endpoint> {
        self.sim.add_web_socket(self, role, socket)
    }

    /// Closes an endpoint and all its connections at once.
    pub(crate) fn stop_web_socket(&mut self, number: u64) {
        self.sim.stop_web_socket(number);
    }

    pub(crate) fn serial_ports_mut(&mut self) -> RefMut<'_, ByHandle<SerialPort>> {
        self.sim.serial_ports.borrow_mut()
    }

    pub(crate) fn tubes(&self) -> Ref<'_, Tubes> {
        self.sim.tubes.borrow()
    }

    pub(crate) fn tubes_mut(&mut self) -> RefMut<'_, Tubes> {
        self.sim.tubes.borrow_mut()
    }

    /// Waits until no other program holds the semaphore; at once if this simulator does already.
    ///
    /// # Errors
    /// When the key is too long, its file cannot be made, or the user wants the program to end.
    pub(crate) fn acquire_semaphore(&mut self, key: &[u8]) -> ApiResult<()> {
        self.sim.acquire_semaphore(key)
    }

    pub(crate) fn release_semaphore(&mut self, key: &[u8]) {
        self.sim.semaphores.borrow_mut().release(key);
    }
}
