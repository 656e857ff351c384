//! Sockets as scripts use them: streams with a buffered reader, datagrams, two timeouts, waiting for many at once, TLS.
//!
//! A call blocks its script for as long as its timeouts allow, and looks in between whether the simulator is being stopped.

mod address;
mod datagram;
mod failure;
mod lookup;
mod options;
mod reader;
mod stream;
#[cfg(feature = "tls")]
mod tls;
#[cfg(not(feature = "tls"))]
#[path = "tls_left_out.rs"]
mod tls;
mod tls_settings;
mod wait;

pub use address::{Family, SocketAddress};
pub use datagram::Datagram;
pub use failure::Failure;
pub use lookup::{Lookup, host_name, name_of, numeric, port};
pub use options::{OptionValue, option, set_option};
pub use reader::Pattern;
pub use stream::{Role, Stream};
pub use tls_settings::{TlsSettings, Verify};
pub use wait::{Timeout, Wait, select, sleep};

use std::rc::Rc;

/// A socket of the system. Two objects of a script may share one.
pub type Socket = Rc<socket2::Socket>;

/// The system's number of a socket.
pub fn descriptor(socket: &Socket) -> i64 {
    #[cfg(unix)]
    return std::os::fd::AsRawFd::as_raw_fd(&**socket).into();
    #[cfg(windows)]
    return std::os::windows::io::AsRawSocket::as_raw_socket(&**socket) as i64;
}

/// Opens a socket whose calls never block: waiting is done in [`wait`].
fn open(domain: socket2::Domain, kind: socket2::Type) -> std::io::Result<Socket> {
    let socket = socket2::Socket::new(domain, kind, None)?;
    socket.set_nonblocking(true)?;
    Ok(Rc::new(socket))
}
