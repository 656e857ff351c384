//! WebSocket endpoints: servers, which answer plain HTTP at the same port, and clients.
//!
//! Everything happens while the event loop runs; events for scripts wait in the endpoint's inbox. Both directions are bounded: a full
//! inbox stops the reading, so that senders have to wait, and a connection with too much to send refuses more.

mod chunks;
mod client;
mod connection;
mod http;
mod pages;
mod places;
mod server;
mod site;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::net::TcpListener;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use heap::resource::Resource;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio_tungstenite::tungstenite::protocol::WebSocketConfig;

use super::event_loop::{Deliver, EventLoop, Inbox, Task};
pub use client::Request as WsRequest;
pub use connection::{Outgoing, SendError};
pub use http::Reply as HttpReply;
use http::Requester;
pub use pages::Pages as WsPages;
pub use site::{Site, SiteMessage, SiteReply, SiteServer, SiteWaker, Visitor};

/// The largest message and the largest body of an HTTP request, bytes.
const MAX_MESSAGE: usize = 32_000_000;
/// Maximum size of an endpoint's inbox: events, and bytes in them.
const MAX_EVENTS: usize = 4096;
const MAX_BYTES: usize = 2 * MAX_MESSAGE;
/// Time limit of the opening and closing handshakes.
const HANDSHAKE_TIMEOUT: Duration = Duration::from_secs(5);
/// Size of a read from a socket.
const READ_BUFFER: usize = 1 << 14;

/// A connection, as long as it lasts. Endpoints and connections of a simulator share one count.
pub(crate) type Connection = u64;

/// Counts endpoints and connections.
#[derive(Clone, Default)]
pub struct IdCounter(Arc<AtomicU64>);

impl IdCounter {
    /// The next number, from 1.
    pub fn next(&self) -> u64 {
        self.0.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Whether that number has been issued.
    pub fn was_issued(&self, number: u64) -> bool {
        (1..=self.0.load(Ordering::Relaxed)).contains(&number)
    }
}

/// An event of an endpoint.
pub enum WsEvent {
    /// A connection is established.
    Open(Connection),
    /// There will be no connection, and why.
    Fail(Connection, String),
    /// The same for a client that has not reached a server.
    Unreachable(Connection, std::io::Error),
    /// A page of this origin was refused.
    Refused(Connection, String),
    /// A connection has ended.
    Close(Connection),
    /// A message, text or binary.
    Message(Connection, Vec<u8>),
    /// A plain HTTP request, to be answered; without an answer its connection just ends.
    Http {
        /// The connection of the request.
        connection: Connection,
        /// The target as sent, with its query.
        resource: String,
        /// The body of the request; empty without one.
        body: Vec<u8>,
        /// Where the answer goes.
        requester: Requester,
    },
}

/// An event on its way to the simulator.
struct Arrival {
    event: WsEvent,
    /// Comes with `WsEvent::Open`.
    outgoing: Option<Outgoing>,
    /// The share of the event in the inbox.
    _room: Option<OwnedSemaphorePermit>,
}

/// Data that the tasks of an endpoint share.
#[derive(Clone)]
struct Reports {
    deliver: Deliver<Arrival>,
    room: Arc<Semaphore>,
    numbers: IdCounter,
}

impl Reports {
    async fn report(&self, event: WsEvent) {
        let size = match &event {
            WsEvent::Message(_, bytes) | WsEvent::Http { body: bytes, .. } => bytes.len(),
            _ => 0,
        };
        self.put(event, None, size).await;
    }

    async fn report_open(&self, connection: Connection, outgoing: Outgoing) {
        self.put(WsEvent::Open(connection), Some(outgoing), 0).await;
    }

    async fn put(&self, event: WsEvent, outgoing: Option<Outgoing>, size: usize) {
        let permits = u32::try_from(size.min(MAX_BYTES)).expect("the bound is small");
        let room = self.room.clone().acquire_many_owned(permits).await.ok();
        self.deliver
            .deliver(Arrival {
                event,
                outgoing,
                _room: room,
            })
            .await;
    }
}

/// A server or a client. When it is dropped, its sockets are closed at once.
pub struct WsEndpoint {
    event_loop: Rc<EventLoop>,
    inbox: RefCell<Inbox<Arrival>>,
    open: RefCell<BTreeMap<Connection, Outgoing>>,
    /// The port of a server.
    port: Option<u16>,
    task: Option<Task>,
    _resource: Resource,
}

impl WsEndpoint {
    /// Serves those who connect to `listener`, of web pages only `pages`.
    ///
    /// # Errors
    /// When the listener cannot be used.
    pub fn listen(
        event_loop: Rc<EventLoop>,
        listener: TcpListener,
        pages: WsPages,
        numbers: IdCounter,
    ) -> std::io::Result<Self> {
        Self::listen_limited(
            event_loop,
            listener,
            pages,
            numbers,
            server::MAX_CONNECTIONS,
        )
    }

    fn listen_limited(
        event_loop: Rc<EventLoop>,
        listener: TcpListener,
        pages: WsPages,
        numbers: IdCounter,
        connections: usize,
    ) -> std::io::Result<Self> {
        listener.set_nonblocking(true)?;
        let port = listener.local_addr()?.port();
        let listener =
            event_loop.block_on(async { tokio::net::TcpListener::from_std(listener) })?;
        let mut server = Self::new(event_loop, numbers, |reports| {
            server::accept_all(listener, pages, reports, connections)
        });
        server.port = Some(port);
        Ok(server)
    }

    /// Connects to a server; how that ends is an event.
    pub fn connect(event_loop: Rc<EventLoop>, request: WsRequest, numbers: IdCounter) -> Self {
        Self::new(event_loop, numbers, |reports| {
            client::connect(request, reports)
        })
    }

    fn new<T: Future<Output = ()> + Send + 'static>(
        event_loop: Rc<EventLoop>,
        numbers: IdCounter,
        task: impl FnOnce(Reports) -> T,
    ) -> Self {
        let (deliver, inbox) = event_loop.inbox(MAX_EVENTS);
        let reports = Reports {
            deliver,
            room: Arc::new(Semaphore::new(MAX_BYTES)),
            numbers,
        };
        let task = Some(event_loop.spawn(task(reports)));
        Self {
            event_loop,
            inbox: RefCell::new(inbox),
            open: RefCell::default(),
            port: None,
            task,
            _resource: Resource::new(|| "a WebSocket".to_owned()),
        }
    }

    /// The port of a server; None for a client.
    pub fn port(&self) -> Option<u16> {
        self.port
    }

    /// How many events wait.
    pub fn arrived(&self) -> usize {
        self.inbox.borrow().len()
    }

    /// The next event, if there is one.
    pub fn next(&self) -> Option<WsEvent> {
        let Arrival {
            event, outgoing, ..
        } = self.inbox.borrow_mut().fetch()?;
        match (&event, outgoing) {
            (WsEvent::Open(connection), Some(outgoing)) => {
                self.open.borrow_mut().insert(*connection, outgoing);
            }
            (WsEvent::Close(connection), _) => {
                self.open.borrow_mut().remove(connection);
            }
            _ => {}
        }
        Some(event)
    }

    /// Sends a message, as soon as the event loop moves.
    ///
    /// # Errors
    /// When the connection is gone or takes no more, or this is no message.
    pub fn send(
        &self,
        connection: Connection,
        data: Vec<u8>,
        opcode: i64,
    ) -> Result<(), SendError> {
        let message = connection::message(data, opcode)?;
        self.open
            .borrow()
            .get(&connection)
            .ok_or(SendError::Expired)?
            .send(message)
    }
}

impl Drop for WsEndpoint {
    fn drop(&mut self) {
        self.task = None;
        // The tasks own the sockets, which close once the tasks have been cancelled.
        self.event_loop.turn();
    }
}

fn config() -> WebSocketConfig {
    WebSocketConfig::default()
        .read_buffer_size(READ_BUFFER)
        .max_message_size(Some(MAX_MESSAGE))
        .max_frame_size(Some(MAX_MESSAGE))
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    #[test]
    fn connections_that_say_nothing_give_way() {
        let event_loop = Rc::new(EventLoop::new().expect("an event loop"));
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
        let address = listener.local_addr().expect("it is bound");
        let (pages, numbers) = (WsPages::All, IdCounter::default());
        let server = WsEndpoint::listen_limited(event_loop.clone(), listener, pages, numbers, 4)
            .expect("the listener is good");
        let open = || std::net::TcpStream::connect(address).expect("it listens");
        let silent: Vec<_> = (0..20).map(|_| open()).collect();
        let mut client = open();
        client
            .write_all(b"GET /here HTTP/1.1\r\n\r\n")
            .expect("it reads");
        // Less than the time after which silent connections are given up anyway.
        event_loop.wait(HANDSHAKE_TIMEOUT / 2);
        let said = server.next();
        assert!(
            matches!(&said, Some(WsEvent::Http { resource, .. }) if resource == "/here"),
            "nothing was heard, or something else"
        );
        drop((client, silent));
    }
}
