//! Addresses: what may be reached, and what others are told.

use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener, TcpStream, ToSocketAddrs, UdpSocket};

use crate::clock::Deadline;
use crate::{Error, Result};

/// Which addresses are bound and reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeNetwork {
    /// Those of this machine only.
    Loopback,
    /// All. Others reach this machine at the address; if it is unspecified, at the one that leads to the master.
    Address(Ipv4Addr),
}

/// A host and a port in an address such as `http://localhost:11311/`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) host: String,
    pub(crate) port: u16,
}

impl Place {
    /// From `scheme://host:port`, with or without a slash at the end.
    pub(crate) fn parse(uri: &str, scheme: &'static str) -> Result<Self> {
        let wrong = || Error::Address(uri.to_string(), scheme);
        let rest = uri
            .strip_prefix(scheme)
            .and_then(|rest| rest.strip_prefix("://"))
            .ok_or_else(wrong)?;
        let (place, _path) = rest.split_once('/').unwrap_or((rest, ""));
        let (host, port) = place.rsplit_once(':').ok_or_else(wrong)?;
        let host = host.trim_start_matches('[').trim_end_matches(']');
        let is_host = !host.is_empty()
            && host
                .chars()
                .all(|c| c.is_ascii_alphanumeric() || "-_.:".contains(c));
        let port = port.parse().map_err(|_| wrong())?;
        if is_host {
            Ok(Self {
                host: host.into(),
                port,
            })
        } else {
            Err(wrong())
        }
    }
}

impl NodeNetwork {
    /// A server's socket, at a port that the system chooses.
    pub(crate) fn listen(self) -> Result<TcpListener> {
        let address = match self {
            Self::Loopback => Ipv4Addr::LOCALHOST,
            Self::Address(_) => Ipv4Addr::UNSPECIFIED,
        };
        Ok(TcpListener::bind((address, 0))?)
    }

    /// The host name that others are told.
    pub(crate) fn own_host(self, master: &Place) -> Result<String> {
        match self {
            Self::Loopback => Ok(Ipv4Addr::LOCALHOST.to_string()),
            Self::Address(address) if !address.is_unspecified() => Ok(address.to_string()),
            Self::Address(_) => {
                let to_master = addresses(master)?;
                let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0))?;
                socket.connect(to_master.as_slice())?;
                Ok(socket.local_addr()?.ip().to_string())
            }
        }
    }

    /// Connects, if that is allowed.
    pub(crate) fn connect(self, place: &Place, deadline: Deadline) -> Result<TcpStream> {
        let mut last = Error::Io(std::io::ErrorKind::AddrNotAvailable.into());
        for address in addresses(place)? {
            if self == Self::Loopback && !is_of_this_machine(address.ip()) {
                last = Error::Outside(place.host.clone());
                continue;
            }
            let left = deadline.left().ok_or_else(timed_out)?;
            match TcpStream::connect_timeout(&address, left) {
                Ok(stream) => {
                    stream.set_nodelay(true)?;
                    return Ok(stream);
                }
                Err(error) => last = error.into(),
            }
        }
        Err(last)
    }
}

pub(crate) fn timed_out() -> Error {
    Error::Io(std::io::Error::new(
        std::io::ErrorKind::TimedOut,
        "no answer in time",
    ))
}

/// IPv4 first, as the servers of ROS 1 use it.
fn addresses(place: &Place) -> Result<Vec<SocketAddr>> {
    let found = (place.host.as_str(), place.port).to_socket_addrs();
    let mut found: Vec<SocketAddr> = found
        .map_err(|error| Error::Host(place.host.clone(), error))?
        .collect();
    found.sort_by_key(SocketAddr::is_ipv6);
    Ok(found)
}

/// Only addresses of this machine can be bound.
fn is_of_this_machine(address: IpAddr) -> bool {
    address.is_loopback() || (!address.is_unspecified() && UdpSocket::bind((address, 0)).is_ok())
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn addresses_are_read() {
        let place = |host: &str, port| Place {
            host: host.into(),
            port,
        };
        assert_eq!(
            Place::parse("http://localhost:11311", "http").expect("a place"),
            place("localhost", 11311)
        );
        assert_eq!(
            Place::parse("http://10.0.0.1:80/", "http").expect("a place"),
            place("10.0.0.1", 80)
        );
        assert_eq!(
            Place::parse("rosrpc://a-b:1", "rosrpc").expect("a place"),
            place("a-b", 1)
        );
        for bad in [
            "",
            "http://x",
            "https://x:1",
            "http://x:99999",
            "http://:1",
            "http://a b:1",
            "http://x:1\r\n",
        ] {
            assert!(Place::parse(bad, "http").is_err(), "{bad}");
        }
    }

    #[test]
    fn nothing_outside_of_this_machine_is_reached_unless_allowed() {
        // An address that no machine has.
        let place = Place {
            host: "192.0.2.1".into(),
            port: 11311,
        };
        let deadline = Deadline::after(Duration::from_millis(50));
        assert!(matches!(
            NodeNetwork::Loopback.connect(&place, deadline),
            Err(Error::Outside(_))
        ));
        assert!(is_of_this_machine(IpAddr::V4(Ipv4Addr::new(127, 0, 1, 1))));
    }
}
