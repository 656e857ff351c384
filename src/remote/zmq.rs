//! The ZeroMQ end of the remote API: one thread that owns the sockets and passes whole messages on.
//!
//! A ROUTER socket speaks to the clients' REQ sockets, so that it is known which connection sent what, and when one goes.

use std::cell::RefCell;
use std::collections::HashMap;
use std::net::TcpListener;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

use bytes::Bytes;
use futures::StreamExt;
use tokio::sync::mpsc as queue;
use zeromq::{RouterSendHalf, RouterSocket, Socket, SocketEvent, SocketRecv, SocketSend, ZmqMessage};

use crate::script::{Incoming, Peer, RemotePort};

type Identity = Bytes;

/// What the thread passes on.
enum Arrival {
    Request(Identity, Vec<u8>),
    Gone(Identity),
}

/// A server for REQ sockets. Its thread ends when this is dropped.
pub(crate) struct ZmqServer {
    arrivals: Receiver<Arrival>,
    replies: queue::UnboundedSender<(Identity, Bytes)>,
    peers: RefCell<Peers>,
    /// What `wait` has seen and `receive` has not.
    seen: RefCell<Option<Arrival>>,
    stop: Arc<AtomicBool>,
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
    /// When there can be no thread or no event loop.
    pub(crate) fn start(listener: TcpListener, stop: Arc<AtomicBool>) -> std::io::Result<Self> {
        let (arrived, arrivals) = channel();
        let (replies, outgoing) = queue::unbounded_channel();
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().enable_time().build()?;
        std::thread::Builder::new()
            .name("remote API".into())
            .spawn(move || runtime.block_on(serve(listener, arrived, outgoing)))?;
        Ok(Self { arrivals, replies, peers: RefCell::default(), seen: RefCell::default(), stop })
    }
}

impl ZmqServer {
    #[allow(clippy::disallowed_methods, reason = "without its thread there is nothing to wait for, but time must pass")]
    fn next(&self, patience: Duration) -> Option<Arrival> {
        if patience.is_zero() {
            return self.arrivals.try_recv().ok();
        }
        match self.arrivals.recv_timeout(patience) {
            Ok(arrival) => Some(arrival),
            Err(RecvTimeoutError::Timeout) => None,
            // A thread that has failed sends nothing; waiting for it must still take its time.
            Err(RecvTimeoutError::Disconnected) => {
                std::thread::sleep(patience);
                None
            }
        }
    }
}

impl RemotePort for ZmqServer {
    fn wait(&self, patience: Duration) {
        let mut seen = self.seen.borrow_mut();
        if seen.is_none() {
            *seen = self.next(patience);
        }
    }

    fn receive(&self, patience: Duration) -> Option<Incoming> {
        let arrival = self.seen.take().or_else(|| self.next(patience))?;
        let mut peers = self.peers.borrow_mut();
        match arrival {
            Arrival::Request(identity, bytes) => Some(Incoming::Request(peers.number(&identity), bytes)),
            // One that never sent a request is nobody's loss.
            Arrival::Gone(identity) => peers.forget(&identity).map(Incoming::Gone),
        }
    }

    fn is_closed(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn reply(&self, peer: Peer, bytes: Vec<u8>) {
        if let Some(identity) = self.peers.borrow().identities.get(&peer) {
            // The thread outlives the sender, except when it failed: then there is nobody to answer.
            let _ = self.replies.send((identity.clone(), bytes.into()));
        }
    }
}

async fn serve(
    listener: TcpListener,
    arrived: Sender<Arrival>,
    mut outgoing: queue::UnboundedReceiver<(Identity, Bytes)>,
) {
    let mut socket = RouterSocket::new();
    let mut events = socket.monitor();
    if socket.bind_listener(listener).await.is_err() {
        return;
    }
    let (mut sender, mut receiver) = socket.split();
    loop {
        let passed_on = tokio::select! {
            message = receiver.recv() => message.ok().and_then(request).map_or(Ok(()), |request| arrived.send(request)),
            event = events.next() => match event {
                Some(SocketEvent::Disconnected(peer)) => arrived.send(Arrival::Gone(Bytes::copy_from_slice(&peer))),
                _ => Ok(()),
            },
            reply = outgoing.recv() => match reply {
                Some((identity, bytes)) => { send(&mut sender, identity, bytes).await; Ok(()) }
                // The server was dropped.
                None => return,
            },
        };
        if passed_on.is_err() {
            return;
        }
    }
}

/// The frames of a REQ socket: who, an empty one, the message. Anything else is ignored.
fn request(message: ZmqMessage) -> Option<Arrival> {
    let [identity, empty, content] = <[Bytes; 3]>::try_from(message.into_vec()).ok()?;
    empty.is_empty().then(|| Arrival::Request(identity, content.into()))
}

async fn send(socket: &mut RouterSendHalf, identity: Identity, content: Bytes) {
    let message = ZmqMessage::try_from(vec![identity, Bytes::new(), content]).expect("three frames are a message");
    // A client that is gone is reported by the monitor.
    let _ = socket.send(message).await;
}
