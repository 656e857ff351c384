//! Servers for programs outside.

pub(crate) mod zmq;
