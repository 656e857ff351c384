//! A node of ROS 1: it registers at a master, publishes and subscribes to topics, calls and offers services, and reads and writes parameters.
//!
//! The protocols are XML-RPC over HTTP for the master and between nodes, and TCPROS for messages, as wiki.ros.org describes them under
//! ROS/Master_API, ROS/Slave_API, ROS/Parameter Server API and ROS/TCPROS. Messages are bytes; what they mean is somebody else's.
//!
//! Each connection has a thread. What arrives waits in bounded inboxes, where the newest stay, until the owner takes it; what is published
//! waits in bounded queues, so that a slow subscriber costs the publisher nothing. Nothing is bound to, and no connection made to, an address
//! outside of this machine unless [`NodeNetwork::Address`] allows it.
//!
//! # Why no library
//!
//! `rosrust` 0.9 has its messages compiled in, while scripts choose types at run time; it keeps the node in global state, while a process may
//! hold several simulators; and it stands on crates that are no longer maintained (`error-chain`, `hyper` 0.10). This crate needs only packages
//! that were there before: `httparse`, `roxmltree` and `base64`.

mod clock;
mod error;
mod http;
mod inbox;
mod limits;
mod master;
mod name;
mod network;
mod node;
mod offline;
mod publisher;
mod service;
mod slave;
mod subscriber;
mod tcpros;
#[cfg(test)]
mod tests;
mod xmlrpc;

pub use error::{Error, Result};
pub use network::NodeNetwork;
pub use node::{Node, NodeSettings};
pub use publisher::Publisher;
pub use service::{Request, ServiceCall, ServiceServer, ServiceType};
pub use subscriber::Subscriber;
pub use xmlrpc::XmlRpcValue;

/// The type of a topic, as both sides compare it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MessageType {
    /// `std_msgs/String`.
    pub name: String,
    /// 32 hexadecimal digits.
    pub md5: String,
    /// The text of the type and of all types within.
    pub definition: String,
}
