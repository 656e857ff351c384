//! The DDS wire protocol RTPS 2.3, as far as ROS 2 needs it: discovery of participants and endpoints, topics without keys, best-effort
//! and reliable, fragments, and the identities of requests and replies. Payloads are bytes; what they mean is somebody else's.
//!
//! [`Core`] is the protocol as a value: datagrams and times in, datagrams out. [`Participant`] is a core with sockets and a thread.
//! There are no keys of programs' topics, content filters, partitions or security.
//!
//! Facts of the protocol are from the specifications of the OMG: DDS 1.4, DDSI-RTPS 2.3.

mod bytes;
mod compose;
mod core;
mod discovery;
mod fragments;
mod guid;
mod message;
mod network;
mod parameters;
mod participant;
mod peers;
mod qos;
mod reader;
mod writer;

use std::net::SocketAddrV4;

pub use self::core::{Core, CoreSettings, Written};
pub use discovery::Endpoint;
pub use guid::{EntityId, Guid, Prefix, SampleIdentity};
pub use message::Timestamp;
pub use network::{Discovery, Network, OpenError, Range};
pub use participant::Participant;
pub use qos::{Durability, History, Liveliness, Qos, Reliability};
pub use reader::Sample;
pub use writer::Correlation;

/// Bytes for an address.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Datagram {
    /// Where they go.
    pub to: SocketAddrV4,
    /// What is sent.
    pub bytes: Vec<u8>,
}

/// What a participant keeps at most, whatever peers send.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Messages of a writer or reader.
    pub max_messages: usize,
    /// Bytes of messages that wait in a reader, or of pieces of one writer; also the largest message.
    pub max_bytes: usize,
    /// Participants that are known.
    pub max_peers: usize,
    /// Endpoints that are known of a participant.
    pub max_endpoints: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            max_messages: 1000,
            max_bytes: 64 << 20,
            max_peers: 256,
            max_endpoints: 2048,
        }
    }
}
