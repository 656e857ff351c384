//! Sockets, and waiting for readiness.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::ffi::{c_int, c_long, c_short};
use std::rc::Rc;

use heap::resource::Resource;
use zmq_sys as ffi;

use super::context::Context;
use super::libzmq::{PollItem, RawSocket, poll_items};
use super::monitor::{self, Monitor};
use super::{Errno, ZmqResult, c_text};

/// The last of the stable types of sockets. Those beyond are drafts, of which only parts are built.
const LAST_TYPE: c_int = ffi::ZMQ_STREAM as c_int;
const LINGER: c_int = ffi::ZMQ_LINGER as c_int;
const USE_FD: c_int = ffi::ZMQ_USE_FD as c_int;
const CONNECT_ROUTING_ID: c_int = ffi::ZMQ_CONNECT_ROUTING_ID as c_int;
/// No option is longer.
const MAX_OPTION: usize = 4096;
/// Longest time that a closed socket tries to deliver unsent messages, milliseconds. libzmq has no limit by default.
const MAX_LINGER: c_int = 30_000;

/// A socket. Dropping it discards unsent messages, unless it is closed before.
pub struct Socket {
    raw: RawSocket,
    /// Whether it may still send its messages after it is dropped.
    is_closed: Cell<bool>,
    /// Names for future connections; libzmq aborts the program when a name is used twice.
    connection_names: RefCell<BTreeSet<Vec<u8>>>,
    monitor: RefCell<Option<Monitor>>,
    /// Dropped after the socket: a context must not end before its sockets.
    context: Rc<Context>,
    _resource: Resource,
}

impl Socket {
    /// A socket of a type, by its number `ZMQ_*`.
    pub fn new(context: &Rc<Context>, kind: c_int) -> ZmqResult<Self> {
        if kind > LAST_TYPE {
            return Err(Errno::INVALID);
        }
        Ok(Self {
            raw: context.socket(kind)?,
            is_closed: Cell::new(false),
            connection_names: RefCell::default(),
            monitor: RefCell::default(),
            context: context.clone(),
            _resource: Resource::new(|| "a ZeroMQ socket".to_owned()),
        })
    }

    pub(super) fn raw(&self) -> &RawSocket {
        &self.raw
    }

    /// Whether it belongs to that context.
    pub fn is_in(&self, context: &Rc<Context>) -> bool {
        Rc::ptr_eq(&self.context, context)
    }

    /// Closes it when the last reference is dropped. Unsent messages are still sent during the time of the option LINGER.
    pub fn close(self: Rc<Self>) {
        self.limit_linger();
        self.is_closed.set(true);
    }

    /// Limits its lifetime, even if its messages are never delivered.
    pub fn limit_linger(&self) {
        let linger = self
            .get(LINGER, size_of::<c_int>())
            .ok()
            .and_then(|bytes| bytes.try_into().ok());
        if linger.is_some_and(|linger| !(0..=MAX_LINGER).contains(&c_int::from_ne_bytes(linger))) {
            self.set_linger(MAX_LINGER);
        }
    }

    fn set_linger(&self, milliseconds: c_int) {
        // It fails when its context is shut down: then the limit was set before.
        let _ = self.set(LINGER, &milliseconds.to_ne_bytes());
    }

    /// Accepts connections at an endpoint.
    pub fn bind(&self, endpoint: &str) -> ZmqResult<()> {
        self.raw.bind(&c_text(endpoint)?)
    }

    /// Accepts no further connections at an endpoint.
    pub fn unbind(&self, endpoint: &str) -> ZmqResult<()> {
        self.raw.unbind(&c_text(endpoint)?)
    }

    /// Connects to an endpoint, now or as soon as there is a peer.
    pub fn connect(&self, endpoint: &str) -> ZmqResult<()> {
        self.raw.connect(&c_text(endpoint)?)
    }

    /// Ends the connection to an endpoint.
    pub fn disconnect(&self, endpoint: &str) -> ZmqResult<()> {
        self.raw.disconnect(&c_text(endpoint)?)
    }

    /// Publishes the events of its connections to a PAIR socket at `endpoint`, in place of an earlier monitor.
    pub fn monitor(&self, endpoint: &str, events: c_int) -> ZmqResult<()> {
        monitor::check_endpoint(endpoint)?;
        if let Some(previous) = self.monitor.take() {
            previous.stop(&self.raw);
        }
        self.monitor.replace(Some(Monitor::start(
            &self.context,
            &self.raw,
            endpoint,
            events,
        )?));
        Ok(())
    }

    /// Whether unread events of its monitor were dropped since the last call.
    pub fn has_lost_events(&self) -> bool {
        self.monitor
            .borrow()
            .as_ref()
            .is_some_and(Monitor::has_lost)
    }

    /// Sets an option to a value of any type, as bytes.
    pub fn set(&self, option: c_int, value: &[u8]) -> ZmqResult<()> {
        if option == USE_FD {
            // A script has no open files: any number would be a file of the program.
            return Err(Errno::INVALID);
        }
        let names_connection = option == CONNECT_ROUTING_ID;
        // libzmq itself makes the names that begin with 0.
        if names_connection
            && (value.first() == Some(&0) || self.connection_names.borrow().contains(value))
        {
            return Err(Errno::INVALID);
        }
        self.raw.set(option, value)?;
        if names_connection {
            self.connection_names.borrow_mut().insert(value.to_vec());
        }
        Ok(())
    }

    /// The bytes of an option, at most `room` of them.
    pub fn get(&self, option: c_int, room: usize) -> ZmqResult<Vec<u8>> {
        let mut value = vec![0_u8; room.min(MAX_OPTION)];
        let length = self.raw.get(option, &mut value)?;
        value.truncate(length);
        Ok(value)
    }

    /// Sends without waiting. Returns the number of bytes.
    pub fn send(&self, bytes: &[u8], flags: c_int) -> ZmqResult<c_int> {
        self.raw.send(bytes, flags | ffi::ZMQ_DONTWAIT as c_int)
    }
}

impl Drop for Socket {
    fn drop(&mut self) {
        if !self.is_closed.get() {
            self.set_linger(0);
        }
    }
}

/// Waits until one of the sockets is ready for one of its events, at most so many milliseconds. Returns the events each is ready for.
pub fn poll(sockets: &[(Rc<Socket>, c_short)], milliseconds: c_long) -> ZmqResult<Vec<c_short>> {
    let mut items = Vec::new();
    // Each socket once: the system limits the list to the number of open files, and libzmq aborts the program beyond it.
    let places: Vec<_> = sockets
        .iter()
        .map(|(socket, events)| place(&mut items, socket, *events))
        .collect();
    poll_items(&mut items, milliseconds)?;
    Ok(sockets
        .iter()
        .zip(places)
        .map(|((_, events), place)| items[place].ready() & events)
        .collect())
}

/// The index of a socket in the list, to which it is added if necessary.
fn place<'a>(items: &mut Vec<PollItem<'a>>, socket: &'a Socket, events: c_short) -> usize {
    if let Some(known) = items.iter().position(|item| item.is_for(&socket.raw)) {
        items[known].add_events(events);
        return known;
    }
    items.push(PollItem::new(&socket.raw, events));
    items.len() - 1
}
