//! The world outside: sockets and whole messages, serial ports, programs. What messages say is not known here.

mod event_loop;
mod file_lock;
#[cfg(unix)]
mod peer_process;
#[cfg(not(unix))]
#[path = "peer_process_elsewhere.rs"]
mod peer_process;
mod process;
#[cfg(feature = "serial")]
mod serial;
#[cfg(not(feature = "serial"))]
#[path = "serial_left_out.rs"]
mod serial;
pub(crate) mod signals;
mod simx_server;
pub(crate) mod socket;
mod ws;
pub(crate) mod zmq;
mod zmq_server;
mod zmtp;

pub(crate) use event_loop::EventLoop;
pub(crate) use file_lock::FileLock;
#[cfg(unix)]
pub(crate) use file_lock::lock_file;
pub(crate) use peer_process::{PeerError, PeerProcess};
pub(crate) use process::{Process, ProcessError, Program};
pub(crate) use serial::SerialPort;
pub(crate) use simx_server::SimxServer;
pub(crate) use ws::{HttpReply, Numbers, SendError, WsEndpoint, WsEvent, WsPages, WsRequest};
pub(crate) use ws::{Site, SiteMessage, SiteReply, SiteServer, SiteWaker, Visitor};
pub(crate) use zmq_server::{Incoming, ZmqServer};
