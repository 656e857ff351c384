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
#[expect(unsafe_code, reason = "an edge to C")]
pub mod signals;
mod simx_server;
pub mod socket;
mod ws;
pub mod zmq;
mod zmq_server;
mod zmtp;

pub use event_loop::EventLoop;
pub use file_lock::FileLock;
#[cfg(unix)]
pub use file_lock::lock_file;
pub use peer_process::{PeerError, PeerProcess};
pub use process::{Process, ProcessError, Program};
pub use serial::SerialPort;
pub use simx_server::SimxServer;
pub use ws::{HttpReply, IdCounter, SendError, WsEndpoint, WsEvent, WsPages, WsRequest};
pub use ws::{Site, SiteMessage, SiteReply, SiteServer, SiteWaker, Visitor};
pub use zmq_server::{Incoming, ZmqServer};
