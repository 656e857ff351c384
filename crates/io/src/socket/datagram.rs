//! Datagrams: UDP and local ones.

use std::io;

use heap::resource::Resource;
use rustix::net::RecvFlags;
use socket2::Type;

use super::failure::is_pending;
use super::{Failure, Family, Socket, SocketAddress, Timeout, Wait, open};

/// The most a datagram can hold.
const MAX_DATAGRAM: usize = 65_536;

/// A datagram socket, or the place for one.
pub struct Datagram {
    /// Whether it is connected to one peer.
    pub connected: bool,
    /// The time limits of its calls.
    pub timeout: Timeout,
    /// The addresses it is for.
    pub family: Family,
    socket: Option<Socket>,
    _resource: Resource,
}

impl Datagram {
    /// A datagram socket for addresses of a family; opened at once unless the first address decides on the family.
    pub fn new(family: Family) -> Result<Self, Failure> {
        let socket = family
            .domain()
            .map(|domain| open(domain, Type::DGRAM))
            .transpose()?;
        Ok(Self {
            connected: false,
            timeout: Timeout::default(),
            family,
            socket,
            _resource: Resource::new(|| "a UDP socket".to_owned()),
        })
    }

    /// The socket of the system; None before it is opened and after it was closed.
    pub fn socket(&self) -> Option<&Socket> {
        self.socket.as_ref()
    }

    /// Takes another socket, or none; returns the one before.
    pub fn replace_socket(&mut self, socket: Option<Socket>) -> Option<Socket> {
        std::mem::replace(&mut self.socket, socket)
    }

    fn opened(&self) -> Result<&Socket, Failure> {
        self.socket.as_ref().ok_or_else(Failure::not_open)
    }

    /// Closes the socket.
    pub fn close(&mut self) {
        self.socket = None;
    }

    /// Binds to the first of these addresses that is free.
    pub fn bind(&mut self, places: &[SocketAddress]) -> Result<(), Failure> {
        self.try_each(places, |socket, place| Ok(socket.bind(&place.address()?)?))
    }

    /// Speaks to the first of these places only.
    pub fn connect(&mut self, places: &[SocketAddress]) -> Result<(), Failure> {
        self.try_each(places, |socket, place| {
            Ok(socket.connect(&place.address()?)?)
        })?;
        self.connected = true;
        Ok(())
    }

    fn try_each(
        &mut self,
        places: &[SocketAddress],
        attempt: impl Fn(&Socket, &SocketAddress) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let is_open = self.socket.is_some();
        let mut result = Err(Failure::not_open());
        for (i, place) in places.iter().enumerate() {
            if i > 0 && !is_open {
                self.socket = None;
            }
            result = self
                .open_for(place)
                .and_then(|()| attempt(self.opened()?, place));
            if result.is_ok() {
                break;
            }
        }
        result
    }

    fn open_for(&mut self, place: &SocketAddress) -> Result<(), Failure> {
        if self.socket.is_none() {
            let domain = place.address()?.domain();
            self.socket = Some(open(domain, Type::DGRAM)?);
            self.family = Family::of(domain);
        }
        Ok(())
    }

    /// Speaks to everybody again.
    pub fn disconnect(&mut self) -> Result<(), Failure> {
        rustix::net::connect_unspec(&**self.opened()?)?;
        self.connected = false;
        Ok(())
    }

    /// Sends to the peer, or to `place`.
    pub fn send(
        &mut self,
        data: &[u8],
        place: Option<&SocketAddress>,
        wait: &Wait<'_>,
    ) -> Result<usize, Failure> {
        let address = place.map(SocketAddress::address).transpose()?;
        if let Some(place) = place {
            self.open_for(place)?;
        }
        let socket = self.opened()?;
        loop {
            let sent = match &address {
                Some(address) => socket.send_to(data, address),
                None => socket.send(data),
            };
            match sent {
                Ok(count) => return Ok(count),
                Err(error) if is_pending(&error) => wait.writable(socket)?,
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// The next datagram and where it came from. What is longer than `size` is lost.
    pub fn receive(
        &self,
        size: usize,
        wait: &Wait<'_>,
    ) -> Result<(Vec<u8>, SocketAddress), Failure> {
        let socket = self.socket.as_ref().ok_or(Failure::Closed)?;
        let mut data = vec![0; size.min(MAX_DATAGRAM)];
        loop {
            match rustix::net::recvfrom(&**socket, &mut data[..], RecvFlags::empty()) {
                Ok((count, _, from)) => {
                    data.truncate(count);
                    return Ok((data, SocketAddress::of_any(from)));
                }
                Err(error) if is_pending(&io::Error::from(error)) => wait.readable(socket)?,
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// The own address.
    pub fn local(&self) -> Result<SocketAddress, Failure> {
        Ok(SocketAddress::of(&self.opened()?.local_addr()?))
    }

    /// The address of the peer it is connected to.
    pub fn peer(&self) -> Result<SocketAddress, Failure> {
        Ok(SocketAddress::of(&self.opened()?.peer_addr()?))
    }
}
