//! The ZeroMQ end of the remote API.
//!
//! The sockets live on the simulator's own thread and move while it receives: a request costs no change of threads, which takes longer
//! than most requests. A ROUTER socket speaks to the clients' REQ sockets, so that it is known which connection sent what, and when one goes.

use std::cell::RefCell;
use std::collections::{HashMap, VecDeque};
use std::net::TcpListener;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use bytes::Bytes;
use futures::channel::mpsc::Receiver;
use futures::{FutureExt, StreamExt};
use tokio::runtime::Runtime;
use zeromq::{RouterRecvHalf, RouterSendHalf, RouterSocket, Socket, SocketEvent, SocketRecv, SocketSend, ZmqMessage};

/// A connection, as long as it lasts.
pub(crate) type Peer = u64;

/// What came in.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Incoming {
    Request(Peer, Vec<u8>),
    /// The connection is gone.
    Gone(Peer),
}

type Identity = Bytes;

/// What the sockets have to say.
enum Arrival {
    Request(Identity, Vec<u8>),
    Gone(Identity),
}

/// A server for REQ sockets.
pub(crate) struct ZmqServer {
    runtime: Runtime,
    sockets: RefCell<Sockets>,
    peers: RefCell<Peers>,
    /// What `wait` has seen and `receive` has not.
    seen: RefCell<VecDeque<Arrival>>,
    stop: Arc<AtomicBool>,
}

struct Sockets {
    sender: RouterSendHalf,
    receiver: RouterRecvHalf,
    events: Receiver<SocketEvent>,
}

/// Numbers for connections.
#[derive(Default)]
struct Peers {
    by_identity: HashMap<Identity, Peer>,
    identities: HashMap<Peer, Identity>,
    last: Peer,
}

impl Peers {
    fn number(&mut self, identity: &Identity) -> Peer {
        if let Some(&peer) = self.by_identity.get(identity) {
            return peer;
        }
        self.last += 1;
        self.by_identity.insert(identity.clone(), self.last);
        self.identities.insert(self.last, identity.clone());
        self.last
    }

    fn forget(&mut self, identity: &Identity) -> Option<Peer> {
        let peer = self.by_identity.remove(identity)?;
        self.identities.remove(&peer);
        Some(peer)
    }
}

impl ZmqServer {
    /// Serves the connections `listener` accepts. Once `stop` is set, nobody is waited for.
    ///
    /// # Errors
    /// When there can be no event loop.
    pub(crate) fn start(listener: TcpListener, stop: Arc<AtomicBool>) -> std::io::Result<Self> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().enable_time().build()?;
        let sockets = runtime.block_on(open(listener)).map_err(std::io::Error::other)?;
        Ok(Self { runtime, sockets: RefCell::new(sockets), peers: RefCell::default(), seen: RefCell::default(), stop })
    }

    /// Moves the sockets until something has arrived, or for that long.
    fn next(&self, patience: Duration) -> Option<Arrival> {
        let mut sockets = self.sockets.borrow_mut();
        self.runtime.block_on(async {
            // The loop looks at the system's sockets only when there is nothing else to do.
            tokio::task::yield_now().await;
            if patience.is_zero() {
                // A timer would take up to a millisecond.
                return sockets.next().now_or_never().flatten();
            }
            tokio::time::timeout(patience, sockets.next()).await.ok().flatten()
        })
    }

    /// Waits until something has come in, at most that long.
    pub(crate) fn wait(&self, patience: Duration) {
        let mut seen = self.seen.borrow_mut();
        if seen.is_empty() {
            seen.extend(self.next(patience));
        }
    }

    /// The next of what came in; waits for it at most that long.
    pub(crate) fn receive(&self, patience: Duration) -> Option<Incoming> {
        let seen = self.seen.borrow_mut().pop_front();
        let mut peers = self.peers.borrow_mut();
        match seen.or_else(|| self.next(patience))? {
            Arrival::Request(identity, bytes) => Some(Incoming::Request(peers.number(&identity), bytes)),
            // One that never sent a request is nobody's loss.
            Arrival::Gone(identity) => peers.forget(&identity).map(Incoming::Gone),
        }
    }

    /// Whether the program is about to end, so that nobody must be waited for.
    pub(crate) fn is_closed(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Answers a connection; nothing happens when it is gone.
    pub(crate) fn reply(&self, peer: Peer, bytes: Vec<u8>) {
        let Some(identity) = self.peers.borrow().identities.get(&peer).cloned() else { return };
        let content = Bytes::from(bytes);
        let message = ZmqMessage::try_from(vec![identity, Bytes::new(), content]).expect("three frames are a message");
        // A client that is gone is reported by the monitor.
        let _ = self.runtime.block_on(self.sockets.borrow_mut().sender.send(message));
    }
}

impl Sockets {
    /// The next request or departure; None for anything else.
    async fn next(&mut self) -> Option<Arrival> {
        tokio::select! {
            biased;
            message = self.receiver.recv() => message.ok().and_then(request),
            event = self.events.next() => match event {
                Some(SocketEvent::Disconnected(peer)) => Some(Arrival::Gone(Bytes::copy_from_slice(&peer))),
                _ => None,
            },
        }
    }
}

async fn open(listener: TcpListener) -> zeromq::ZmqResult<Sockets> {
    let mut socket = RouterSocket::new();
    let events = socket.monitor();
    socket.bind_listener(listener).await?;
    let (sender, receiver) = socket.split();
    Ok(Sockets { sender, receiver, events })
}

/// The frames of a REQ socket: who, an empty one, the message. Anything else is ignored.
fn request(message: ZmqMessage) -> Option<Arrival> {
    let [identity, empty, content] = <[Bytes; 3]>::try_from(message.into_vec()).ok()?;
    empty.is_empty().then(|| Arrival::Request(identity, content.into()))
}
