//! The ZeroMQ end of the remote API.
//!
//! The sockets live on the simulator's own thread and move with its event loop: a request costs no change of threads, which takes longer
//! than most requests. A ROUTER socket speaks to the clients' REQ sockets, so that it is known which connection sent what, and when one goes.

use std::cell::RefCell;
use std::collections::HashMap;
use std::net::TcpListener;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use bytes::Bytes;
use futures::StreamExt;
use futures::channel::mpsc::Receiver;
use zeromq::{RouterRecvHalf, RouterSendHalf, RouterSocket, Socket, SocketEvent, SocketRecv, SocketSend, ZmqMessage};

use super::event_loop::{Deliver, EventLoop, Inbox, Task};

/// Requests that may wait for the simulator; clients have one each, so more are a sign of something else.
const MOST_REQUESTS: usize = 1024;
/// Rest after a message that could not be read.
const REST: Duration = Duration::from_millis(1);

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
    event_loop: Rc<EventLoop>,
    sender: RefCell<RouterSendHalf>,
    inbox: RefCell<Inbox<Arrival>>,
    peers: RefCell<Peers>,
    stop: Arc<AtomicBool>,
    _receiving: Task,
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
    /// When the listener cannot be used.
    pub(crate) fn start(
        event_loop: Rc<EventLoop>,
        listener: TcpListener,
        stop: Arc<AtomicBool>,
    ) -> std::io::Result<Self> {
        let mut socket = RouterSocket::new();
        let events = socket.monitor();
        event_loop.block_on(socket.bind_listener(listener)).map_err(std::io::Error::other)?;
        let (sender, receiver) = socket.split();
        let (deliver, inbox) = event_loop.inbox(MOST_REQUESTS);
        let receiving = event_loop.spawn(receive_all(receiver, events, deliver));
        Ok(Self {
            event_loop,
            sender: RefCell::new(sender),
            inbox: RefCell::new(inbox),
            peers: RefCell::default(),
            stop,
            _receiving: receiving,
        })
    }

    /// The next of what came in; waits for it at most that long.
    pub(crate) fn receive(&self, patience: Duration) -> Option<Incoming> {
        let arrival = self.event_loop.fetch(&mut self.inbox.borrow_mut(), patience)?;
        let mut peers = self.peers.borrow_mut();
        match arrival {
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
        let _ = self.event_loop.block_on(self.sender.borrow_mut().send(message));
    }
}

/// Delivers requests and departures.
async fn receive_all(mut receiver: RouterRecvHalf, mut events: Receiver<SocketEvent>, deliver: Deliver<Arrival>) {
    loop {
        let arrival = tokio::select! {
            biased;
            message = receiver.recv() => match message {
                Ok(message) => request(message),
                Err(_) => {
                    tokio::time::sleep(REST).await;
                    None
                }
            },
            Some(event) = events.next() => match event {
                SocketEvent::Disconnected(peer) => Some(Arrival::Gone(Bytes::copy_from_slice(&peer))),
                _ => None,
            },
        };
        if let Some(arrival) = arrival {
            deliver.deliver(arrival).await;
        }
    }
}

/// The frames of a REQ socket: who, an empty one, the message. Anything else is ignored.
fn request(message: ZmqMessage) -> Option<Arrival> {
    let [identity, empty, content] = <[Bytes; 3]>::try_from(message.into_vec()).ok()?;
    empty.is_empty().then(|| Arrival::Request(identity, content.into()))
}
