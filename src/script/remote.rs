//! The door for programs outside: whole messages come in, whole messages go out. What carries them is not known here.

use std::time::Duration;

/// A connection, as long as it lasts.
pub(crate) type Peer = u64;

/// What came in.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Incoming {
    Request(Peer, Vec<u8>),
    /// The connection is gone.
    Gone(Peer),
}

/// Where requests of other programs come from.
pub(crate) trait RemotePort {
    /// The next of what came in; waits for it at most that long.
    fn receive(&self, patience: Duration) -> Option<Incoming>;

    /// Waits until something has come in, at most that long.
    fn wait(&self, patience: Duration);

    /// Answers a connection; nothing happens when it is gone.
    fn reply(&self, peer: Peer, bytes: Vec<u8>);

    /// Whether the program is about to end, so that nobody must be waited for.
    fn is_closed(&self) -> bool;
}
