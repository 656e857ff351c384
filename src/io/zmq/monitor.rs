//! Monitors: what happens to the connections of a socket, told to a PAIR socket of the script.
//!
//! libzmq holds up its own threads while nobody takes what a monitor tells, and then whoever binds or closes a socket. So its monitor
//! speaks to a relay, which always listens: a thread with a queue that passes on what the script's socket takes. What exceeds the queue
//! is lost. The relay ends with the monitor, whose last event it always asks for, or with the context.

use std::collections::VecDeque;
use std::ffi::{c_int, c_short, c_void};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::JoinHandle;

use zmq_sys as ffi;

use super::context::Context;
use super::{Errno, ZmqResult, c_text, check};

/// Events kept for a script, besides those libzmq keeps on the way to its socket.
const MOST_EVENTS: usize = 1000;
/// The thread calls libzmq and little else.
const STACK_SIZE: usize = 256 * 1024;
const POLLIN: c_short = ffi::ZMQ_POLLIN as c_short;
const POLLOUT: c_short = ffi::ZMQ_POLLOUT as c_short;
const DONTWAIT: c_int = ffi::ZMQ_DONTWAIT as c_int;
const SNDMORE: c_int = ffi::ZMQ_SNDMORE as c_int;
const STOPPED: c_int = ffi::ZMQ_EVENT_MONITOR_STOPPED as c_int;
/// An event is a number of 16 bits and a value of 32.
const HEAD: usize = 6;
/// Longest address in an event.
const MAX_ADDRESS: usize = 4096;

/// Names for the ends of relays, which all contexts of the program share.
static RELAYS: AtomicU64 = AtomicU64::new(0);

/// The monitor of a socket.
pub(super) struct Monitor {
    relay: JoinHandle<()>,
    lost: Arc<AtomicBool>,
}

impl Monitor {
    /// Reports a socket's connection events at `endpoint`.
    ///
    /// # Errors
    /// When the address is none of `inproc`, or in use.
    pub(super) fn start(context: &Context, socket: *mut c_void, endpoint: &str, events: c_int) -> ZmqResult<Self> {
        let listener = End::new(context)?;
        let teller = End::new(context)?;
        let endpoint = c_text(endpoint)?;
        // SAFETY: the socket lives, the text ends with NUL and is copied.
        check(unsafe { ffi::zmq_bind(teller.0, endpoint.as_ptr()) })?;
        let inside = c_text(&format!("inproc://swanilda.monitor.{}", RELAYS.fetch_add(1, Ordering::Relaxed)))?;
        // Without a limit of the listener libzmq has none on the way to it, and never waits.
        listener.set(ffi::ZMQ_RCVHWM, 0)?;
        // SAFETY (both): the sockets live, the text ends with NUL and is copied.
        check(unsafe { ffi::zmq_socket_monitor(socket, inside.as_ptr(), events | STOPPED) })?;
        check(unsafe { ffi::zmq_connect(listener.0, inside.as_ptr()) })?;
        let lost = Arc::<AtomicBool>::default();
        let relay = Relay { listener, teller, endpoint, events, queue: VecDeque::new(), lost: lost.clone() };
        let thread = std::thread::Builder::new().name("zmq monitor".into()).stack_size(STACK_SIZE);
        let relay = thread.spawn(move || relay.run()).map_err(|_| Errno::NO_MEMORY)?;
        Ok(Self { relay, lost })
    }

    /// Ends it and frees its address.
    pub(super) fn stop(self, socket: *mut c_void) {
        // SAFETY: the socket lives; no address means the end. It fails when the context is over, which ends the relay as well.
        unsafe { ffi::zmq_socket_monitor(socket, std::ptr::null(), 0) };
        // It passes on what its script takes at once, and ends. It does not panic.
        let _ = self.relay.join();
    }

    /// Whether events were lost since this was last asked.
    pub(super) fn has_lost(&self) -> bool {
        self.lost.swap(false, Ordering::Relaxed)
    }
}

/// # Errors
/// As libzmq says what is no address of a monitor.
pub(super) fn check_endpoint(endpoint: &str) -> ZmqResult<()> {
    match endpoint.split_once("://") {
        None | Some(("", _) | (_, "")) => Err(Errno::INVALID),
        Some(("inproc", _)) => Ok(()),
        Some(_) => Err(Errno::NO_PROTOCOL),
    }
}

/// A PAIR socket of a relay.
struct End(*mut c_void);

// SAFETY: a socket may change its thread where that is synchronised, and starting a thread is.
unsafe impl Send for End {}

impl End {
    fn new(context: &Context) -> ZmqResult<Self> {
        // SAFETY: the context lives.
        let raw = unsafe { ffi::zmq_socket(context.raw(), ffi::ZMQ_PAIR as c_int) };
        if raw.is_null() { Err(Errno::last()) } else { Ok(Self(raw)) }
    }

    fn set(&self, option: u32, value: c_int) -> ZmqResult<()> {
        let value = (&raw const value).cast();
        // SAFETY: the socket lives, the value is an integer and copied.
        check(unsafe { ffi::zmq_setsockopt(self.0, option as c_int, value, size_of::<c_int>()) }).map(drop)
    }

    /// A part of a message, if one is there.
    fn receive(&self, room: usize) -> ZmqResult<Vec<u8>> {
        let mut bytes = vec![0_u8; room];
        // SAFETY: the socket lives; libzmq writes at most `room` bytes, and returns how many it would have liked to.
        let length = check(unsafe { ffi::zmq_recv(self.0, bytes.as_mut_ptr().cast(), room, DONTWAIT) })?;
        bytes.truncate(length as usize);
        Ok(bytes)
    }

    /// Sends a part of a message, if there is a receiver.
    fn send(&self, bytes: &[u8], flags: c_int) -> ZmqResult<()> {
        // SAFETY: the socket lives, the bytes are copied.
        check(unsafe { ffi::zmq_send(self.0, bytes.as_ptr().cast(), bytes.len(), flags | DONTWAIT) }).map(drop)
    }
}

impl Drop for End {
    fn drop(&mut self) {
        // SAFETY: the socket lives, and is not used afterwards.
        unsafe { ffi::zmq_close(self.0) };
    }
}

/// The two parts of a message about an event.
struct Event {
    head: Vec<u8>,
    address: Vec<u8>,
}

impl Event {
    fn number(&self) -> c_int {
        let number = self.head.first_chunk().copied().unwrap_or_default();
        u16::from_ne_bytes(number).into()
    }
}

/// Forwards events of libzmq's monitor to the script's socket.
struct Relay {
    listener: End,
    teller: End,
    endpoint: std::ffi::CString,
    /// What the script asked for.
    events: c_int,
    queue: VecDeque<Event>,
    lost: Arc<AtomicBool>,
}

impl Relay {
    fn run(mut self) {
        while self.wait().is_ok() {
            let goes_on = self.listen();
            self.tell();
            if !goes_on {
                break;
            }
        }
        // So that whoever waits for the end finds the address free. SAFETY: the socket lives, the text ends with NUL.
        unsafe { ffi::zmq_unbind(self.teller.0, self.endpoint.as_ptr()) };
    }

    /// Waits until an event arrives or can be forwarded.
    ///
    /// # Errors
    /// When the context is over.
    fn wait(&self) -> ZmqResult<()> {
        let item = |end: &End, events| ffi::zmq_pollitem_t { socket: end.0, events, ..Default::default() };
        let events = if self.queue.is_empty() { 0 } else { POLLOUT };
        let mut items = [item(&self.listener, POLLIN), item(&self.teller, events)];
        // SAFETY: the sockets live, and there are two items.
        match check(unsafe { ffi::zmq_poll(items.as_mut_ptr(), 2, -1) }) {
            Err(error) if error != Errno::INTERRUPTED => Err(error),
            _ => Ok(()),
        }
    }

    /// Receives events of the monitor; returns whether more may follow.
    fn listen(&mut self) -> bool {
        while let Ok(head) = self.listener.receive(HEAD) {
            let event = Event { head, address: self.listener.receive(MAX_ADDRESS).unwrap_or_default() };
            let number = event.number();
            if number & self.events != 0 {
                self.keep(event);
            }
            if number == STOPPED {
                return false;
            }
        }
        true
    }

    fn keep(&mut self, event: Event) {
        if self.queue.len() == MOST_EVENTS {
            self.tell();
        }
        if self.queue.len() < MOST_EVENTS {
            self.queue.push_back(event);
        } else {
            self.lost.store(true, Ordering::Relaxed);
        }
    }

    /// Passes on what the script's socket takes.
    fn tell(&mut self) {
        while let Some(Event { head, address }) = self.queue.front() {
            if self.teller.send(head, SNDMORE).is_err() {
                return;
            }
            // A second part goes wherever the first one went, or nobody is there any more.
            let _ = self.teller.send(address, 0);
            self.queue.pop_front();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::net::TcpStream;
    use std::rc::Rc;
    use std::time::Duration;

    use super::super::{Message, Socket, poll};
    use super::*;

    const ALL: c_int = ffi::ZMQ_EVENT_ALL as c_int;

    fn monitored(context: &Rc<Context>) -> (Socket, String) {
        let socket = Socket::new(context, ffi::ZMQ_REP as c_int).expect("a socket");
        assert_eq!(socket.monitor("inproc://watch", ALL), Ok(()));
        assert_eq!(socket.bind("tcp://127.0.0.1:*"), Ok(()));
        let endpoint = socket.get(ffi::ZMQ_LAST_ENDPOINT as c_int, 256).expect("it is bound");
        let address = String::from_utf8(endpoint).expect("it is text");
        (socket, address.trim_start_matches("tcp://").trim_end_matches('\0').to_owned())
    }

    fn end(context: Rc<Context>) {
        let context = Rc::try_unwrap(context).ok().expect("its sockets are gone");
        assert!(context.terminate().wait(Duration::from_secs(30)));
    }

    fn next(reader: &Rc<Socket>) -> u16 {
        assert_eq!(poll(&[(reader.clone(), POLLIN)], 30_000), Ok(vec![POLLIN]));
        let mut message = Message::closed();
        message.open();
        assert_eq!(message.receive(reader, 0), Ok(HEAD as c_int));
        let number = message.bytes().first_chunk().copied().expect("six bytes");
        message.receive(reader, 0).expect("the address follows");
        assert!(!message.has_more());
        u16::from_ne_bytes(number)
    }

    #[test]
    fn events_nobody_reads_hold_up_nobody() {
        let context = Rc::new(Context::new().expect("a context"));
        let (socket, address) = monitored(&context);
        for _ in 0..1500 {
            TcpStream::connect(&address).expect("it listens");
        }
        assert_eq!(socket.bind("tcp://127.0.0.1:*"), Ok(()));
        assert_eq!(socket.unbind(&format!("tcp://{address}")), Ok(()));
        while !socket.has_lost_events() {
            std::thread::yield_now();
        }
        drop(socket);
        end(context);
    }

    #[test]
    fn a_reader_hears_all_that_happens_even_if_it_comes_late() {
        let context = Rc::new(Context::new().expect("a context"));
        let (socket, address) = monitored(&context);
        drop(TcpStream::connect(&address).expect("it listens"));
        let reader = Rc::new(Socket::new(&context, ffi::ZMQ_PAIR as c_int).expect("a socket"));
        assert_eq!(reader.connect("inproc://watch"), Ok(()));
        assert_eq!((next(&reader), next(&reader)), (ffi::ZMQ_EVENT_LISTENING as u16, ffi::ZMQ_EVENT_ACCEPTED as u16));
        drop(socket);
        while next(&reader) != STOPPED as u16 {}
        drop(reader);
        end(context);
    }

    #[test]
    fn another_monitor_takes_the_place_of_the_first() {
        let context = Rc::new(Context::new().expect("a context"));
        let (socket, _) = monitored(&context);
        for endpoint in ["inproc://watch", "inproc://second", "inproc://watch"] {
            assert_eq!(socket.monitor(endpoint, STOPPED), Ok(()));
        }
        let other = Socket::new(&context, ffi::ZMQ_REP as c_int).expect("a socket");
        assert_eq!(other.monitor("inproc://watch", ALL), Err(Errno(ffi::errno::EADDRINUSE)));
        drop((socket, other));
        end(context);
    }

    #[test]
    fn addresses_that_are_none() {
        assert_eq!(check_endpoint("inproc://a"), Ok(()));
        for bad in ["", "a", "inproc://", "://a"] {
            assert_eq!(check_endpoint(bad), Err(Errno::INVALID), "{bad}");
        }
        assert_eq!(check_endpoint("tcp://127.0.0.1:*"), Err(Errno::NO_PROTOCOL));
    }
}
