//! The world outside: sockets and whole messages. What messages say is not known here.

mod event_loop;
mod zmq_server;

pub(crate) use event_loop::EventLoop;
pub(crate) use zmq_server::{Incoming, ZmqServer};
