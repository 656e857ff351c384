//! How much a node keeps and reads, whatever others send.

use std::time::Duration;

/// The largest message, in bytes.
pub(crate) const MESSAGE: usize = 64 << 20;

/// The most bytes of messages that wait for one subscriber, or in one inbox.
pub(crate) const WAITING: usize = 64 << 20;

/// The most messages that wait, whatever a program asks for.
pub(crate) const QUEUE: usize = 10_000;

/// The most requests that wait for a service.
pub(crate) const REQUESTS: usize = 100;

/// The largest head of a TCPROS connection.
pub(crate) const HEAD: usize = 1 << 20;

/// The largest text of a call or an answer in XML.
pub(crate) const XML: usize = 16 << 20;

/// How deeply values of XML-RPC are nested.
pub(crate) const NESTING: usize = 32;

/// The most connections of others at a time, of either protocol.
pub(crate) const CONNECTIONS: usize = 256;

/// The most publishers of one topic.
pub(crate) const PUBLISHERS: usize = 256;

/// How long the master, or another node, has for an answer.
pub(crate) const TIMEOUT: Duration = Duration::from_secs(3);

/// How long a connection of another node may say nothing before its head or request is complete.
pub(crate) const SILENCE_TIMEOUT: Duration = Duration::from_secs(30);

/// The shortest and the longest pause before a publisher that was not reached is tried again.
pub(crate) const RETRY_DELAY: [Duration; 2] = [Duration::from_millis(100), Duration::from_secs(5)];
