//! Sockets, and waiting for readiness.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::ffi::{c_int, c_long, c_short, c_void};
use std::rc::Rc;

use zmq_sys as ffi;

use super::context::Context;
use super::monitor::{self, Monitor};
use super::{Errno, ZmqResult, c_text, check};

/// The last of the stable types of sockets. Those beyond are drafts, of which only parts are built.
const LAST_TYPE: c_int = ffi::ZMQ_STREAM as c_int;
const LINGER: c_int = ffi::ZMQ_LINGER as c_int;
const USE_FD: c_int = ffi::ZMQ_USE_FD as c_int;
const CONNECT_ROUTING_ID: c_int = ffi::ZMQ_CONNECT_ROUTING_ID as c_int;
/// No option is longer.
const MAX_OPTION: usize = 4096;
/// How long a closed socket tries to deliver what it was told to send, milliseconds: in libzmq for ever, if nobody says otherwise.
const MAX_LINGER: c_int = 30_000;

/// A socket. One that is dropped forgets what it has not sent yet, unless it is closed before.
pub(crate) struct Socket {
    raw: *mut c_void,
    /// Whether it is draining unsent messages.
    is_closed: Cell<bool>,
    /// Names given to connections to be made; libzmq ends the program at the second of the same name.
    connection_names: RefCell<BTreeSet<Vec<u8>>>,
    /// Endpoint of its monitor.
    monitor: RefCell<Option<Monitor>>,
    /// Goes after the socket: a context must not end before its sockets.
    context: Rc<Context>,
}

impl Socket {
    pub(crate) fn new(context: &Rc<Context>, kind: c_int) -> ZmqResult<Self> {
        if kind > LAST_TYPE {
            return Err(Errno::INVALID);
        }
        // SAFETY: the context lives.
        let raw = unsafe { ffi::zmq_socket(context.raw(), kind) };
        if raw.is_null() {
            return Err(Errno::last());
        }
        let context = context.clone();
        Ok(Self {
            raw,
            is_closed: Cell::new(false),
            connection_names: RefCell::default(),
            monitor: RefCell::default(),
            context,
        })
    }

    pub(super) fn raw(&self) -> *mut c_void {
        self.raw
    }

    pub(crate) fn is_in(&self, context: &Rc<Context>) -> bool {
        Rc::ptr_eq(&self.context, context)
    }

    /// Closes it, when nobody else uses it any more. What was to be sent is sent, as long as the option LINGER says.
    pub(crate) fn close(self: Rc<Self>) {
        self.limit_linger();
        self.is_closed.set(true);
    }

    /// Limits its lifetime, even if its messages are never delivered.
    pub(crate) fn limit_linger(&self) {
        let linger = self.get(LINGER, size_of::<c_int>()).ok().and_then(|bytes| bytes.try_into().ok());
        if linger.is_some_and(|linger| !(0..=MAX_LINGER).contains(&c_int::from_ne_bytes(linger))) {
            self.set_linger(MAX_LINGER);
        }
    }

    fn set_linger(&self, milliseconds: c_int) {
        // It fails when its context is shut down: then the limit was set before.
        let _ = self.set(LINGER, &milliseconds.to_ne_bytes());
    }

    pub(crate) fn bind(&self, endpoint: &str) -> ZmqResult<()> {
        let endpoint = c_text(endpoint)?;
        // SAFETY (this and the next three): the socket lives, the text ends with NUL and is copied.
        check(unsafe { ffi::zmq_bind(self.raw, endpoint.as_ptr()) }).map(drop)
    }

    pub(crate) fn unbind(&self, endpoint: &str) -> ZmqResult<()> {
        let endpoint = c_text(endpoint)?;
        check(unsafe { ffi::zmq_unbind(self.raw, endpoint.as_ptr()) }).map(drop)
    }

    pub(crate) fn connect(&self, endpoint: &str) -> ZmqResult<()> {
        let endpoint = c_text(endpoint)?;
        check(unsafe { ffi::zmq_connect(self.raw, endpoint.as_ptr()) }).map(drop)
    }

    pub(crate) fn disconnect(&self, endpoint: &str) -> ZmqResult<()> {
        let endpoint = c_text(endpoint)?;
        check(unsafe { ffi::zmq_disconnect(self.raw, endpoint.as_ptr()) }).map(drop)
    }

    /// Tells what happens to its connections to a PAIR socket at `endpoint`, and no longer to the one before.
    pub(crate) fn monitor(&self, endpoint: &str, events: c_int) -> ZmqResult<()> {
        monitor::check_endpoint(endpoint)?;
        if let Some(before) = self.monitor.take() {
            before.stop(self.raw);
        }
        self.monitor.replace(Some(Monitor::start(&self.context, self.raw, endpoint, events)?));
        Ok(())
    }

    /// Whether unread events of its monitor were dropped since the last call.
    pub(crate) fn has_lost_events(&self) -> bool {
        self.monitor.borrow().as_ref().is_some_and(Monitor::has_lost)
    }

    /// Sets an option to a value of whatever type, given as bytes.
    pub(crate) fn set(&self, option: c_int, value: &[u8]) -> ZmqResult<()> {
        if option == USE_FD {
            // A script has no open files of its own: it could only take one of the program's.
            return Err(Errno::INVALID);
        }
        let names_connection = option == CONNECT_ROUTING_ID;
        // Names that begin with 0 are those libzmq gives.
        if names_connection && (value.first() == Some(&0) || self.connection_names.borrow().contains(value)) {
            return Err(Errno::INVALID);
        }
        // SAFETY: the socket lives, the value is copied.
        check(unsafe { ffi::zmq_setsockopt(self.raw, option, value.as_ptr().cast(), value.len()) })?;
        if names_connection {
            self.connection_names.borrow_mut().insert(value.to_vec());
        }
        Ok(())
    }

    /// The bytes of an option, of which there may be `room`.
    pub(crate) fn get(&self, option: c_int, room: usize) -> ZmqResult<Vec<u8>> {
        let mut value = vec![0_u8; room.min(MAX_OPTION)];
        let mut length = value.len();
        // SAFETY: the socket lives, and libzmq writes at most `length` bytes.
        check(unsafe { ffi::zmq_getsockopt(self.raw, option, value.as_mut_ptr().cast(), &raw mut length) })?;
        value.truncate(length);
        Ok(value)
    }

    /// Sends without waiting. Returns the number of bytes.
    pub(crate) fn send(&self, bytes: &[u8], flags: c_int) -> ZmqResult<c_int> {
        let flags = flags | ffi::ZMQ_DONTWAIT as c_int;
        // SAFETY: the socket lives, the bytes are copied.
        check(unsafe { ffi::zmq_send(self.raw, bytes.as_ptr().cast(), bytes.len(), flags) })
    }
}

impl Drop for Socket {
    fn drop(&mut self) {
        if !self.is_closed.get() {
            self.set_linger(0);
        }
        // SAFETY: the socket lives, and is not used afterwards. It fails only for what is no socket.
        unsafe { ffi::zmq_close(self.raw) };
    }
}

/// Waits until one of the sockets is ready for one of its events, at most that many milliseconds. Returns which ones each is ready for.
pub(crate) fn poll(sockets: &[(Rc<Socket>, c_short)], milliseconds: c_long) -> ZmqResult<Vec<c_short>> {
    let mut items: Vec<ffi::zmq_pollitem_t> = Vec::new();
    // Each socket once: the system refuses lists that are longer than there can be open files, and libzmq ends the program then.
    let places: Vec<usize> = sockets.iter().map(|(socket, events)| place(&mut items, socket, *events)).collect();
    // SAFETY: the sockets live, and there are as many items as said.
    check(unsafe { ffi::zmq_poll(items.as_mut_ptr(), items.len() as c_int, milliseconds) })?;
    Ok(sockets.iter().zip(places).map(|((_, events), place)| items[place].revents & events).collect())
}

/// The place of a socket in the list, at its end if it was not there.
fn place(items: &mut Vec<ffi::zmq_pollitem_t>, socket: &Socket, events: c_short) -> usize {
    let known = items.iter().position(|item| item.socket == socket.raw);
    let place = known.unwrap_or(items.len());
    if known.is_none() {
        items.push(ffi::zmq_pollitem_t { socket: socket.raw, ..Default::default() });
    }
    items[place].events |= events;
    place
}
