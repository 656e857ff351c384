//! Monitors: the events of a socket's connections, for a PAIR socket of the script.
//!
//! libzmq blocks its own threads while the events of a monitor are not read, and then every call that binds or closes a socket. So its monitor
//! writes to a relay that always reads: a thread with a queue, which forwards as much as the script's socket accepts. What exceeds the queue
//! is lost. The relay ends with the monitor, whose last event it always requests, or with the context.

use std::collections::VecDeque;
use std::ffi::{CString, c_int, c_short};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::JoinHandle;

use zmq_sys as ffi;

use super::context::Context;
use super::libzmq::{PollItem, RawSocket, poll_items};
use super::{Errno, ZmqResult, c_text};

/// Maximum number of events queued for a script, in addition to those in libzmq's queues.
const MAX_EVENTS: usize = 1000;
/// The thread calls libzmq and little else.
const STACK_SIZE: usize = 256 * 1024;
const POLLIN: c_short = ffi::ZMQ_POLLIN as c_short;
const POLLOUT: c_short = ffi::ZMQ_POLLOUT as c_short;
const DONTWAIT: c_int = ffi::ZMQ_DONTWAIT as c_int;
const SNDMORE: c_int = ffi::ZMQ_SNDMORE as c_int;
const PAIR: c_int = ffi::ZMQ_PAIR as c_int;
const STOPPED: c_int = ffi::ZMQ_EVENT_MONITOR_STOPPED as c_int;
/// An event is a number of 16 bits and a value of 32.
const HEAD: usize = 6;
/// Longest address in an event.
const MAX_ADDRESS: usize = 4096;

/// Numbers for the addresses of relays, unique in the program.
static RELAYS: AtomicU64 = AtomicU64::new(0);

/// The monitor of a socket.
pub(super) struct Monitor {
    relay: JoinHandle<()>,
    lost: Arc<AtomicBool>,
}

impl Monitor {
    /// Publishes the events of a socket's connections at `endpoint`.
    ///
    /// # Errors
    /// When the address is none of `inproc`, or in use.
    pub(super) fn start(
        context: &Context,
        socket: &RawSocket,
        endpoint: &str,
        events: c_int,
    ) -> ZmqResult<Self> {
        let (input, output) = (context.socket(PAIR)?, context.socket(PAIR)?);
        let endpoint = c_text(endpoint)?;
        output.bind(&endpoint)?;
        let address = c_text(&format!(
            "inproc://swanilda.monitor.{}",
            RELAYS.fetch_add(1, Ordering::Relaxed)
        ))?;
        // Without a limit at the receiver libzmq has none on the way to it, and never blocks.
        input.set(ffi::ZMQ_RCVHWM as c_int, &0_i32.to_ne_bytes())?;
        socket.monitor(Some(&address), events | STOPPED)?;
        input.connect(&address)?;
        let lost = Arc::<AtomicBool>::default();
        let relay = Relay {
            input,
            output,
            endpoint,
            events,
            queue: VecDeque::new(),
            lost: lost.clone(),
        };
        let thread = std::thread::Builder::new()
            .name("zmq monitor".into())
            .stack_size(STACK_SIZE);
        let relay = thread
            .spawn(move || relay.run())
            .map_err(|_| Errno::NO_MEMORY)?;
        Ok(Self { relay, lost })
    }

    /// Ends it and frees its address.
    pub(super) fn stop(self, socket: &RawSocket) {
        // It fails when the context is terminated, which ends the relay as well.
        let _ = socket.monitor(None, 0);
        // The relay forwards what its script accepts at once, and ends. It does not panic.
        let _ = self.relay.join();
    }

    /// Whether events were lost since the last call.
    pub(super) fn has_lost(&self) -> bool {
        self.lost.swap(false, Ordering::Relaxed)
    }
}

/// # Errors
/// The errors of libzmq for an invalid address of a monitor.
pub(super) fn check_endpoint(endpoint: &str) -> ZmqResult<()> {
    match endpoint.split_once("://") {
        None | Some(("", _) | (_, "")) => Err(Errno::INVALID),
        Some(("inproc", _)) => Ok(()),
        Some(_) => Err(Errno::NO_PROTOCOL),
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
    input: RawSocket,
    output: RawSocket,
    endpoint: CString,
    /// The events that the script selected.
    events: c_int,
    queue: VecDeque<Event>,
    lost: Arc<AtomicBool>,
}

impl Relay {
    fn run(mut self) {
        while self.wait().is_ok() {
            let goes_on = self.read();
            self.forward();
            if !goes_on {
                break;
            }
        }
        // Now, not when the socket is closed in the background: a caller that waits for the end may bind the address again.
        let _ = self.output.unbind(&self.endpoint);
    }

    /// Waits until an event arrives or can be forwarded.
    ///
    /// # Errors
    /// When the context is terminated.
    fn wait(&self) -> ZmqResult<()> {
        let output_events = if self.queue.is_empty() { 0 } else { POLLOUT };
        let mut items = [
            PollItem::new(&self.input, POLLIN),
            PollItem::new(&self.output, output_events),
        ];
        match poll_items(&mut items, -1) {
            Err(error) if error != Errno::INTERRUPTED => Err(error),
            _ => Ok(()),
        }
    }

    /// Reads events of the monitor; returns whether more may follow.
    fn read(&mut self) -> bool {
        while let Ok(head) = receive(&self.input, HEAD) {
            let event = Event {
                head,
                address: receive(&self.input, MAX_ADDRESS).unwrap_or_default(),
            };
            let number = event.number();
            if number & self.events != 0 {
                self.enqueue(event);
            }
            if number == STOPPED {
                return false;
            }
        }
        true
    }

    fn enqueue(&mut self, event: Event) {
        if self.queue.len() == MAX_EVENTS {
            self.forward();
        }
        if self.queue.len() < MAX_EVENTS {
            self.queue.push_back(event);
        } else {
            self.lost.store(true, Ordering::Relaxed);
        }
    }

    /// Sends as many events as the script's socket accepts.
    fn forward(&mut self) {
        while let Some(Event { head, address }) = self.queue.front() {
            if self.output.send(head, SNDMORE | DONTWAIT).is_err() {
                return;
            }
            // It fails only when the receiver is gone since the first part was sent.
            let _ = self.output.send(address, DONTWAIT);
            self.queue.pop_front();
        }
    }
}

/// The next part of a message, if there is one, cut to `room` bytes.
fn receive(socket: &RawSocket, room: usize) -> ZmqResult<Vec<u8>> {
    let mut bytes = vec![0_u8; room];
    let length = socket.receive(&mut bytes, DONTWAIT)?;
    bytes.truncate(length);
    Ok(bytes)
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
        let endpoint = socket
            .get(ffi::ZMQ_LAST_ENDPOINT as c_int, 256)
            .expect("it is bound");
        let address = String::from_utf8(endpoint).expect("it is text");
        (
            socket,
            address
                .trim_start_matches("tcp://")
                .trim_end_matches('\0')
                .to_owned(),
        )
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
    fn unread_events_block_nobody() {
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
    fn a_late_reader_receives_all_events() {
        let context = Rc::new(Context::new().expect("a context"));
        let (socket, address) = monitored(&context);
        drop(TcpStream::connect(&address).expect("it listens"));
        let reader = Rc::new(Socket::new(&context, ffi::ZMQ_PAIR as c_int).expect("a socket"));
        assert_eq!(reader.connect("inproc://watch"), Ok(()));
        assert_eq!(
            (next(&reader), next(&reader)),
            (
                ffi::ZMQ_EVENT_LISTENING as u16,
                ffi::ZMQ_EVENT_ACCEPTED as u16
            )
        );
        drop(socket);
        while next(&reader) != STOPPED as u16 {}
        drop(reader);
        end(context);
    }

    #[test]
    fn another_monitor_replaces_the_first() {
        let context = Rc::new(Context::new().expect("a context"));
        let (socket, _) = monitored(&context);
        for endpoint in ["inproc://watch", "inproc://second", "inproc://watch"] {
            assert_eq!(socket.monitor(endpoint, STOPPED), Ok(()));
        }
        let other = Socket::new(&context, ffi::ZMQ_REP as c_int).expect("a socket");
        assert_eq!(
            other.monitor("inproc://watch", ALL),
            Err(Errno(ffi::errno::EADDRINUSE))
        );
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
