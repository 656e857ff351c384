//! The world outside: sockets and whole messages. What messages say is not known here.

mod zmq_server;

pub(crate) use zmq_server::{Incoming, ZmqServer};
