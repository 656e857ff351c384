//! Socket addresses, and their form in scripts.

use std::io;
use std::net::SocketAddr;

use rustix::net::SocketAddrAny;
use socket2::{Domain, SockAddr};

/// The address family of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Whatever the first address is.
    Any,
    /// IPv4.
    Inet,
    /// IPv6.
    Inet6,
    /// Paths on this machine.
    Unix,
}

impl Family {
    pub(crate) fn admits(self, address: SocketAddr) -> bool {
        match self {
            Self::Any => true,
            Self::Inet => address.is_ipv4(),
            Self::Inet6 => address.is_ipv6(),
            Self::Unix => false,
        }
    }

    pub(super) fn of(domain: Domain) -> Self {
        match domain {
            Domain::IPV4 => Self::Inet,
            Domain::IPV6 => Self::Inet6,
            _ => Self::Unix,
        }
    }

    /// The domain of a socket that is opened before its address is known.
    pub(super) fn domain(self) -> Option<Domain> {
        match self {
            Self::Any => None,
            Self::Inet => Some(Domain::IPV4),
            Self::Inet6 => Some(Domain::IPV6),
            Self::Unix => Some(Domain::UNIX),
        }
    }
}

/// The address of a socket or of its peer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SocketAddress {
    /// An IP address with a port.
    Net(SocketAddr),
    /// A path; empty for a socket without a name.
    Path(Vec<u8>),
}

impl SocketAddress {
    pub(super) fn of(address: &SockAddr) -> Self {
        match address.as_socket() {
            Some(address) => Self::Net(address),
            None => Self::Path(path_bytes(address)),
        }
    }

    pub(super) fn of_any(address: Option<SocketAddrAny>) -> Self {
        let Some(address) = address else {
            return Self::Path(Vec::new());
        };
        match SocketAddr::try_from(address.clone()) {
            Ok(address) => Self::Net(address),
            Err(_) => Self::Path(any_path_bytes(address)),
        }
    }

    pub(super) fn address(&self) -> io::Result<SockAddr> {
        match self {
            Self::Net(address) => Ok((*address).into()),
            Self::Path(path) => path_address(path),
        }
    }
}

#[cfg(unix)]
fn path_bytes(address: &SockAddr) -> Vec<u8> {
    use std::os::unix::ffi::OsStrExt;
    address
        .as_pathname()
        .map(|path| path.as_os_str().as_bytes().to_vec())
        .unwrap_or_default()
}

#[cfg(unix)]
fn any_path_bytes(address: SocketAddrAny) -> Vec<u8> {
    let path = rustix::net::SocketAddrUnix::try_from(address).ok();
    path.and_then(|address| address.path().map(|path| path.to_bytes().to_vec()))
        .unwrap_or_default()
}

#[cfg(unix)]
fn path_address(path: &[u8]) -> io::Result<SockAddr> {
    use std::os::unix::ffi::OsStrExt;
    SockAddr::unix(std::ffi::OsStr::from_bytes(path))
}

#[cfg(not(unix))]
fn path_bytes(_: &SockAddr) -> Vec<u8> {
    Vec::new()
}

#[cfg(not(unix))]
fn any_path_bytes(_: SocketAddrAny) -> Vec<u8> {
    Vec::new()
}

#[cfg(not(unix))]
fn path_address(path: &[u8]) -> io::Result<SockAddr> {
    SockAddr::unix(String::from_utf8_lossy(path).as_ref())
}
