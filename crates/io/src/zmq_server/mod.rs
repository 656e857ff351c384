//! The ZeroMQ server of the remote API: a REP socket that reports which connection sent a message, and when one closes.
//!
//! The sockets live on the simulator's own thread and move with its event loop: a request costs no change of threads, which takes longer
//! than most requests. An answer goes straight to the system; what the system does not accept at once is sent later.

mod connection;
mod receiver;

use std::collections::HashMap;
use std::io;
use std::net::TcpListener;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use heap::resource::Resource;
use tokio::task::JoinSet;
use tokio::time::Instant;

use super::event_loop::{Deliver, EventLoop, Inbox, Task};
use connection::Connection;
use receiver::Receiver;

/// Maximum number of entries that wait for the simulator: for each connection a request and its end.
const MAX_ARRIVALS: usize = 2 * LIMITS.connections + 1;
/// The limits of a server.
const LIMITS: Limits = Limits {
    connections: 512,
    silence: Duration::from_secs(10),
};
/// Time limit of the handshake.
const HANDSHAKE_TIMEOUT: Duration = Duration::from_secs(10);
/// Pause after a connection that could not be accepted.
const RETRY_DELAY: Duration = Duration::from_millis(50);

/// A connection, as long as it lasts.
pub(crate) type Peer = u64;

#[derive(Clone, Copy)]
struct Limits {
    /// Maximum number of connections; a further one replaces the oldest that has made no request yet, or an idle one, or is rejected.
    connections: usize,
    /// A connection without a request for this long is idle.
    silence: Duration,
}

/// Something that has arrived.
#[derive(Debug, PartialEq, Eq)]
pub enum Incoming {
    /// A request, without its envelope.
    Request(Peer, Vec<u8>),
    /// The connection is gone.
    Gone(Peer),
}

/// A server for REQ sockets.
pub struct ZmqServer {
    event_loop: Rc<EventLoop>,
    inbox: std::cell::RefCell<Inbox<Incoming>>,
    connections: Arc<Connections>,
    stop: Arc<AtomicBool>,
    _accepting: Task,
    _resource: Resource,
}

/// All connections that last.
#[derive(Default)]
struct Connections(Mutex<HashMap<Peer, Arc<Connection>>>);

impl ZmqServer {
    /// Serves the connections that `listener` accepts. Once `stop` is set, waits end.
    ///
    /// # Errors
    /// When the listener cannot be used.
    pub fn start(
        event_loop: Rc<EventLoop>,
        listener: TcpListener,
        stop: Arc<AtomicBool>,
    ) -> io::Result<Self> {
        Self::start_limited(event_loop, listener, stop, LIMITS)
    }

    fn start_limited(
        event_loop: Rc<EventLoop>,
        listener: TcpListener,
        stop: Arc<AtomicBool>,
        limits: Limits,
    ) -> io::Result<Self> {
        listener.set_nonblocking(true)?;
        let listener =
            event_loop.block_on(async { tokio::net::TcpListener::from_std(listener) })?;
        let (deliver, inbox) = event_loop.inbox(MAX_ARRIVALS);
        let connections = Arc::<Connections>::default();
        let accepting =
            event_loop.spawn(accept_all(listener, connections.clone(), deliver, limits));
        Ok(Self {
            event_loop,
            inbox: inbox.into(),
            connections,
            stop,
            _accepting: accepting,
            _resource: Resource::new(|| "the server of the ZeroMQ remote API".to_owned()),
        })
    }

    /// The next of what came in; waits for it at most that long. Requests of connections that are gone are dropped.
    pub fn receive(&self, timeout: Duration) -> Option<Incoming> {
        loop {
            let incoming = self
                .event_loop
                .fetch(&mut self.inbox.borrow_mut(), timeout)?;
            let Incoming::Request(peer, _) = &incoming else {
                return Some(incoming);
            };
            if let Some(connection) = self.connections.lock().get(peer) {
                connection.leave_queue();
                return Some(incoming);
            }
        }
    }

    /// Whether the program is about to end, so that waits must end.
    pub fn is_closed(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Whether other sockets of the event loop have received data.
    pub fn others_wait(&self) -> bool {
        self.event_loop.arrivals() > self.inbox.borrow().len()
    }

    /// Answers a connection; nothing happens when it is gone.
    pub fn reply(&self, peer: Peer, bytes: &[u8]) {
        let Some(connection) = self.connections.lock().get(&peer).cloned() else {
            return;
        };
        connection.answer(bytes);
    }
}

impl Connections {
    fn lock(&self) -> MutexGuard<'_, HashMap<Peer, Arc<Connection>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends the oldest connection that has made no request yet, or else the one that has been silent for longest; false when none has been for
    /// that long.
    fn end_silent(&self, silence: Duration) -> bool {
        let now = Instant::now();
        let connections = self.lock();
        let silent = connections
            .values()
            .filter_map(|connection| Some((connection.silence()?, connection)));
        match silent.min_by_key(|(order, _)| *order) {
            Some(((has_asked, since), connection))
                if !has_asked || now.duration_since(since) >= silence =>
            {
                connection.abandon();
                true
            }
            _ => false,
        }
    }
}

/// Serves every connection in its own task, until this one ends.
async fn accept_all(
    listener: tokio::net::TcpListener,
    connections: Arc<Connections>,
    deliver: Deliver<Incoming>,
    limits: Limits,
) {
    let mut tasks = JoinSet::new();
    let mut last = 0;
    loop {
        tokio::select! {
            accepted = listener.accept() => match accepted {
                Ok((stream, _)) if tasks.len() < limits.connections || connections.end_silent(limits.silence) => {
                    last += 1;
                    // If this cannot be set, replies are slower.
                    let _ = stream.set_nodelay(true);
                    let (reading, writing) = stream.into_split();
                    let connection = Arc::new(Connection::new(writing));
                    connections.lock().insert(last, connection.clone());
                    let receiver = Receiver::new(reading);
                    tasks.spawn(serve(receiver, connection, last, connections.clone(), deliver.clone()));
                }
                Ok(_) => {}
                // Out of file descriptors, for instance.
                Err(_) => {
                    connections.end_silent(limits.silence);
                    tokio::time::sleep(RETRY_DELAY).await;
                }
            },
            Some(_) = tasks.join_next() => {}
        }
    }
}

/// Serves one connection to its end.
async fn serve(
    mut receiver: Receiver,
    connection: Arc<Connection>,
    peer: Peer,
    connections: Arc<Connections>,
    deliver: Deliver<Incoming>,
) {
    let introduced =
        tokio::time::timeout(HANDSHAKE_TIMEOUT, receiver.shake_hands(&connection)).await;
    if !matches!(introduced, Ok(Ok(()))) {
        connections.lock().remove(&peer);
        return;
    }
    while let Ok(request) = receiver.next_request(&connection).await {
        connection.outgoing().envelope = request.envelope;
        connection.enter_queue();
        deliver
            .deliver(Incoming::Request(peer, request.content))
            .await;
        if receiver.wait_for_turn(&connection).await.is_err() {
            break;
        }
    }
    connections.lock().remove(&peer);
    deliver.deliver(Incoming::Gone(peer)).await;
}

#[cfg(test)]
mod tests {
    use super::super::zmtp;
    use super::*;
    use std::io::{Read, Write};

    fn server() -> (ZmqServer, std::net::SocketAddr) {
        limited(LIMITS)
    }

    fn limited(limits: Limits) -> (ZmqServer, std::net::SocketAddr) {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
        let address = listener.local_addr().expect("it is bound");
        let event_loop = Rc::new(EventLoop::new().expect("an event loop"));
        (
            ZmqServer::start_limited(event_loop, listener, Arc::default(), limits)
                .expect("the listener is good"),
            address,
        )
    }

    fn connect(address: std::net::SocketAddr) -> std::net::TcpStream {
        let mut stream = std::net::TcpStream::connect(address).expect("the server listens");
        let mut opening = zmtp::hello();
        *opening.last_mut().expect("it is not empty") = b'Q'; // of REQ
        stream.write_all(&opening).expect("the server reads");
        stream
    }

    fn next(server: &ZmqServer) -> Option<Incoming> {
        server.receive(Duration::from_secs(10))
    }

    #[test]
    fn a_request_an_answer_and_the_end() {
        let (server, address) = server();
        let mut client = connect(address);
        client
            .write_all(b"\x01\0\0\x02hi")
            .expect("the server reads");
        assert_eq!(next(&server), Some(Incoming::Request(1, b"hi".to_vec())));
        server.reply(1, b"ho");
        let mut received = vec![0; zmtp::hello().len() + 6];
        client.read_exact(&mut received).expect("the answer comes");
        assert!(received.ends_with(b"\x01\0\0\x02ho"));
        drop(client);
        assert_eq!(next(&server), Some(Incoming::Gone(1)));
        server.reply(1, b"nobody");
    }

    #[test]
    fn a_length_that_lies_ends_the_connection() {
        let (server, address) = server();
        let mut client = connect(address);
        client
            .write_all(b"\x02\0\0\x04\0\0\0\0\0abc")
            .expect("the server reads");
        assert_eq!(next(&server), Some(Incoming::Gone(1)));
    }

    #[test]
    fn a_client_that_does_not_read_is_given_up() {
        let (server, address) = server();
        let mut client = connect(address);
        client
            .write_all(b"\x01\0\0\x02hi")
            .expect("the server reads");
        assert!(matches!(next(&server), Some(Incoming::Request(1, _))));
        for _ in 0..200 {
            server.reply(1, &[0; 1 << 20]);
        }
        assert_eq!(next(&server), Some(Incoming::Gone(1)));
    }

    const HI: &[u8] = b"\x01\0\0\x02hi";

    fn peer_of(incoming: Option<Incoming>) -> Peer {
        match incoming {
            Some(Incoming::Request(peer, _)) => peer,
            other => panic!("no request: {other:?}"),
        }
    }

    #[test]
    fn connections_take_turns() {
        let (server, address) = server();
        let mut greedy = connect(address);
        greedy.write_all(&HI.repeat(100)).expect("the server reads");
        assert_eq!(peer_of(next(&server)), 1);
        let mut modest = connect(address);
        modest.write_all(HI).expect("the server reads");
        let peers: Vec<Peer> = (0..20)
            .map(|_| peer_of(next(&server)))
            .take_while(|&peer| peer == 1)
            .collect();
        assert!(peers.len() < 20, "one connection goes before all others");
        for _ in 0..99 - peers.len() {
            assert_eq!(peer_of(next(&server)), 1);
        }
    }

    #[test]
    fn requests_of_connections_that_are_gone_are_dropped() {
        let (server, address) = server();
        let mut client = connect(address);
        client
            .write_all(&HI.repeat(1000))
            .expect("the server reads");
        drop(client);
        let requests = (0..)
            .map_while(|_| next(&server).filter(|incoming| *incoming != Incoming::Gone(1)))
            .count();
        assert!(requests < 10, "{requests}");
    }

    #[test]
    fn connections_that_say_nothing_make_room_at_once() {
        let (server, address) = limited(Limits {
            connections: 8,
            silence: Duration::from_secs(3600),
        });
        let mut friend = connect(address);
        friend.write_all(HI).expect("the server reads");
        assert_eq!(peer_of(next(&server)), 1);
        server.reply(1, b"ho");
        let open = || std::net::TcpStream::connect(address).expect("the server listens");
        let silent: Vec<_> = (0..20).map(|_| open()).collect();
        let greeted: Vec<_> = (0..20).map(|_| connect(address)).collect();
        let mut client = connect(address);
        client.write_all(HI).expect("the server reads");
        let arrived = std::iter::from_fn(|| next(&server));
        let request = arrived
            .take(60)
            .find(|incoming| matches!(incoming, Incoming::Request(..)));
        assert_eq!(request, Some(Incoming::Request(42, b"hi".to_vec())));
        friend.write_all(HI).expect("it is still connected");
        drop((silent, greeted));
        let mut arrived = std::iter::from_fn(|| next(&server)).take(60);
        assert!(arrived.any(|incoming| incoming == Incoming::Request(1, b"hi".to_vec())));
    }

    #[test]
    fn silent_connections_make_room() {
        let (server, address) = limited(Limits {
            connections: 2,
            silence: Duration::ZERO,
        });
        let (mut first, mut second) = (connect(address), connect(address));
        for (client, peer) in [(&mut first, 1), (&mut second, 2)] {
            client.write_all(HI).expect("the server reads");
            assert_eq!(peer_of(next(&server)), peer);
        }
        // Both wait for their answers.
        drop(connect(address));
        assert_eq!(server.receive(Duration::from_millis(20)), None);
        server.reply(2, b"ho");
        let mut third = connect(address);
        third.write_all(HI).expect("the server reads");
        let mut arrivals = [next(&server), next(&server)];
        arrivals.sort_by_key(|incoming| matches!(incoming, Some(Incoming::Request(..))));
        assert!(
            matches!(
                arrivals,
                [Some(Incoming::Gone(2)), Some(Incoming::Request(3, _))]
            ),
            "{arrivals:?}"
        );
    }
}
