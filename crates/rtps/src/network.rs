//! Sockets of a participant, and which addresses they use.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, SocketAddrV4, UdpSocket};

use socket2::{Domain, Protocol, Socket, Type};

use crate::core::{MULTICAST, multicast_port, unicast_port};

/// Participants of one domain on one machine.
const MAX_PARTICIPANTS: u32 = 120;
/// Of them, how many are told directly; the others are found by multicast.
const ANNOUNCED_PORTS: u32 = 20;
/// The same at the address of a static peer, where nobody is found by multicast.
const STATIC_PORTS: u32 = 32;
/// What the system is asked to keep for a socket.
const BUFFER: usize = 8 << 20;

/// Where a participant receives and sends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Network {
    /// On this machine only: nothing is bound to, joined on or sent to another address than those of the loopback.
    #[default]
    Loopback,
    /// In the network that an address of this machine belongs to; unspecified for the one that the system prefers.
    Address(Ipv4Addr),
}

/// Whom a participant looks for: ROS 2's `ROS_AUTOMATIC_DISCOVERY_RANGE` and `ROS_STATIC_PEERS`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Discovery {
    /// Where it looks by itself.
    pub range: Range,
    /// Machines where it looks too, unless the range is off: without multicast.
    pub static_peers: Vec<Ipv4Addr>,
}

/// Where a participant looks for others by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Range {
    /// Nowhere, and nobody finds it.
    Off,
    /// On this machine. In a network, nothing is sent or received by multicast.
    Localhost,
    /// Wherever multicast reaches: in the network, or on this machine if that is all that is used.
    #[default]
    Subnet,
}

/// Why a participant cannot be.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// Ports are 16 bits.
    #[error("there is no domain {0}: domains go from 0 to 232")]
    Domain(u32),
    /// Of one domain on one machine.
    #[error("domain {0} has too many participants on this machine")]
    TooMany(u32),
    /// The system's answer.
    #[error("cannot open a socket for domain {domain} at {address}: {error}")]
    Socket {
        /// Which domain.
        domain: u32,
        /// The local address.
        address: Ipv4Addr,
        /// What the system says.
        error: io::Error,
    },
}

/// The sockets of a participant.
pub(crate) struct Sockets {
    pub(crate) unicast: UdpSocket,
    /// Where announcements of others are received.
    pub(crate) multicast: io::Result<Option<UdpSocket>>,
    pub(crate) address: SocketAddrV4,
    pub(crate) is_loopback_only: bool,
}

impl Sockets {
    pub(crate) fn open(domain: u32, network: Network, range: Range) -> Result<Self, OpenError> {
        if domain > 232 {
            return Err(OpenError::Domain(domain));
        }
        let address = match network {
            Network::Loopback => Ipv4Addr::LOCALHOST,
            Network::Address(address) if address.is_unspecified() => preferred_address(),
            Network::Address(address) => address,
        };
        let is_loopback_only = network == Network::Loopback;
        let refused = |error| OpenError::Socket {
            domain,
            address,
            error,
        };
        let (unicast, port) = unicast(domain, address)
            .map_err(refused)?
            .ok_or(OpenError::TooMany(domain))?;
        let is_by_multicast = match range {
            Range::Off => false,
            Range::Localhost => is_loopback_only,
            Range::Subnet => true,
        };
        // Where there is no multicast, as in some containers, others are still found one by one.
        let multicast = is_by_multicast.then(|| multicast(domain, address));
        let multicast = multicast.transpose();
        Ok(Self {
            unicast,
            multicast,
            address: SocketAddrV4::new(address, port),
            is_loopback_only,
        })
    }

    /// Where other participants may be that are not found by multicast.
    pub(crate) fn announce_to(&self, domain: u32, discovery: &Discovery) -> Vec<SocketAddrV4> {
        if discovery.range == Range::Off {
            return Vec::new();
        }
        let here = (*self.address.ip(), ANNOUNCED_PORTS);
        let there = discovery.static_peers.iter().map(|ip| (*ip, STATIC_PORTS));
        let ports = |(ip, count)| {
            (0..count)
                .filter_map(move |number| u16::try_from(unicast_port(domain, number)).ok())
                .map(move |port| SocketAddrV4::new(ip, port))
        };
        let places = [here].into_iter().chain(there).flat_map(ports);
        let mut places: Vec<_> = places.filter(|place| *place != self.address).collect();
        places.sort_unstable();
        places.dedup();
        places
    }

    /// The socket for announcements of others, if there is one.
    pub(crate) fn multicast(&self) -> Option<&UdpSocket> {
        self.multicast.as_ref().ok().and_then(Option::as_ref)
    }

    /// Sends, if the address is allowed. What the system does not take is sent again by the protocol, or lost.
    pub(crate) fn send(&self, to: SocketAddrV4, bytes: &[u8]) {
        let is_allowed = !self.is_loopback_only || to.ip().is_loopback() || *to.ip() == MULTICAST;
        if is_allowed {
            self.unicast.send_to(bytes, to).ok();
        }
    }

    /// Reads a datagram, if there is one from an allowed address.
    pub(crate) fn receive(
        &self,
        socket: &UdpSocket,
        buffer: &mut [u8],
    ) -> Option<(usize, SocketAddrV4)> {
        loop {
            match socket.recv_from(buffer) {
                Ok((length, SocketAddr::V4(from)))
                    if !self.is_loopback_only || from.ip().is_loopback() =>
                {
                    return Some((length, from));
                }
                Ok(_) => {}
                // An earlier datagram was sent to a closed port, which the system reports here.
                Err(error) if error.kind() == io::ErrorKind::ConnectionRefused => {}
                Err(_) => return None,
            }
        }
    }
}

/// The socket with the first free port of the domain, by which everything is sent and most is received.
fn unicast(domain: u32, address: Ipv4Addr) -> io::Result<Option<(UdpSocket, u16)>> {
    for number in 0..MAX_PARTICIPANTS {
        let Ok(port) = u16::try_from(unicast_port(domain, number)) else {
            break;
        };
        let socket = Socket::new(Domain::IPV4, Type::DGRAM, Some(Protocol::UDP))?;
        match socket.bind(&SocketAddrV4::new(address, port).into()) {
            Ok(()) => {
                socket.set_multicast_if_v4(&address)?;
                socket.set_multicast_loop_v4(true)?;
                return Ok(Some((ready(socket)?, port)));
            }
            Err(error) if error.kind() == io::ErrorKind::AddrInUse => {}
            Err(error) => return Err(error),
        }
    }
    Ok(None)
}

/// A socket for the domain's multicast address. It is bound to that address, and gets only what comes by the interface of `address`.
fn multicast(domain: u32, address: Ipv4Addr) -> io::Result<UdpSocket> {
    let socket = Socket::new(Domain::IPV4, Type::DGRAM, Some(Protocol::UDP))?;
    socket.set_reuse_address(true)?;
    #[cfg(unix)]
    socket.set_reuse_port(true)?;
    let port = u16::try_from(multicast_port(domain)).map_err(io::Error::other)?;
    let bound = if cfg!(windows) { address } else { MULTICAST };
    socket.bind(&SocketAddrV4::new(bound, port).into())?;
    socket.join_multicast_v4(&MULTICAST, &address)?;
    // Otherwise Linux delivers datagrams of all groups that any program on this machine has joined.
    #[cfg(target_os = "linux")]
    socket.set_multicast_all_v4(false)?;
    ready(socket)
}

fn ready(socket: Socket) -> io::Result<UdpSocket> {
    // The system may use a smaller buffer; then more datagrams are lost and sent again.
    socket.set_recv_buffer_size(BUFFER).ok();
    socket.set_send_buffer_size(BUFFER).ok();
    socket.set_nonblocking(true)?;
    Ok(socket.into())
}

/// The address from which the system would send to the multicast address. Nothing is sent to find out.
fn preferred_address() -> Ipv4Addr {
    let asked = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).and_then(|socket| {
        socket.connect((MULTICAST, 7400))?;
        socket.local_addr()
    });
    match asked {
        Ok(SocketAddr::V4(address)) => *address.ip(),
        _ => Ipv4Addr::LOCALHOST,
    }
}
