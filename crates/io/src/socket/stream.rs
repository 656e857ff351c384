//! Connections and listeners: TCP, local streams, TLS.

use std::io::{ErrorKind, Read, Write};
use std::time::Instant;

use heap::resource::Resource;
use socket2::{SockAddr, Type};

use super::failure::is_pending;
use super::reader::{Pattern, Reader};
use super::tls::Tls;
use super::wait::now;
use super::{Failure, Family, Socket, SocketAddress, Timeout, Wait, open};

/// The state of a stream object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Neither connected nor listening.
    Master,
    /// Connected, or about to be.
    Client,
    /// Listening for connections.
    Server,
}

/// A stream socket, or the place for one.
pub struct Stream {
    /// What it is used for.
    pub role: Role,
    /// The time limits of its calls.
    pub timeout: Timeout,
    /// The addresses it is for.
    pub family: Family,
    /// Bytes sent so far, for `getstats`.
    pub sent: f64,
    /// Added to the bytes received.
    received_before: f64,
    birth: Instant,
    /// Seconds added to the age.
    age_before: f64,
    socket: Option<Socket>,
    reader: Reader,
    pub(super) tls: Option<Box<Tls>>,
    _resource: Resource,
}

impl Stream {
    /// A stream without a socket: the first address decides on that.
    pub(crate) fn unopened(family: Family) -> Self {
        Self {
            role: Role::Master,
            timeout: Timeout::default(),
            family,
            sent: 0.0,
            received_before: 0.0,
            birth: now(),
            age_before: 0.0,
            socket: None,
            reader: Reader::default(),
            tls: None,
            _resource: Resource::new(|| "a TCP socket".to_owned()),
        }
    }

    /// A stream for addresses of a family.
    pub fn new(family: Family) -> Result<Self, Failure> {
        let mut stream = Self::unopened(family);
        if let Some(domain) = family.domain() {
            stream.socket = Some(open(domain, Type::STREAM)?);
        }
        Ok(stream)
    }

    /// The socket of the system; None before it is opened and after it was closed.
    pub fn socket(&self) -> Option<&Socket> {
        self.socket.as_ref()
    }

    /// Takes another socket, or none; returns the one before.
    pub fn replace_socket(&mut self, socket: Option<Socket>) -> Option<Socket> {
        std::mem::replace(&mut self.socket, socket)
    }

    /// Moves the stream to another object; this one has no socket any more.
    pub fn handed_over(&mut self) -> Self {
        let empty = Self {
            role: self.role,
            timeout: self.timeout,
            ..Self::unopened(self.family)
        };
        std::mem::replace(self, empty)
    }

    /// Whether the connection is encrypted.
    pub fn is_tls(&self) -> bool {
        self.tls.is_some()
    }

    fn opened(&self) -> Result<&Socket, Failure> {
        self.socket.as_ref().ok_or_else(Failure::not_open)
    }

    /// Whether unread data have arrived.
    pub fn is_dirty(&self) -> bool {
        !self.reader.is_empty() || self.tls.as_ref().is_some_and(|tls| tls.has_plaintext())
    }

    /// Ends TLS, closes the socket, and forgets what was not read.
    pub fn close(&mut self) {
        if let (Some(tls), Some(socket)) = (&mut self.tls, &self.socket) {
            tls.say_goodbye(socket);
        }
        self.tls = None;
        self.socket = None;
        self.reader = Reader::default();
    }

    /// Binds to the first address that lets it.
    pub fn bind(&mut self, places: &[SocketAddress]) -> Result<(), Failure> {
        self.try_each(places, false, |stream, address| {
            Ok(stream.opened()?.bind(address)?)
        })
    }

    /// Connects to the first address that answers.
    pub fn connect(&mut self, places: &[SocketAddress], wait: &Wait<'_>) -> Result<(), Failure> {
        // Set even when connecting times out: the system continues to establish the connection.
        self.role = Role::Client;
        self.try_each(places, wait.is_zero(), |stream, address| {
            stream.connect_to(address, wait)
        })
    }

    /// Tries one place after the other, each with a socket of its own if there was none. A time-out may be the last word.
    fn try_each(
        &mut self,
        places: &[SocketAddress],
        is_hasty: bool,
        attempt: impl Fn(&Self, &SockAddr) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let is_open = self.socket.is_some();
        let mut result = Err(Failure::not_open());
        for (i, place) in places.iter().enumerate() {
            if i > 0 && !is_open {
                self.socket = None;
            }
            let address = place.address()?;
            result = self
                .open_for(&address)
                .and_then(|()| attempt(self, &address));
            match result {
                Ok(()) | Err(Failure::Interrupted) => break,
                Err(Failure::Timeout) if is_hasty => break,
                Err(_) => {}
            }
        }
        result
    }

    fn open_for(&mut self, address: &SockAddr) -> Result<(), Failure> {
        if self.socket.is_none() {
            self.socket = Some(open(address.domain(), Type::STREAM)?);
            self.family = Family::of(address.domain());
        }
        Ok(())
    }

    fn connect_to(&self, address: &SockAddr, wait: &Wait<'_>) -> Result<(), Failure> {
        let socket = self.opened()?;
        match socket.connect(address) {
            Ok(()) => return Ok(()),
            Err(error) if is_pending(&error) => wait.writable(socket)?,
            Err(error) => return Err(error.into()),
        }
        match socket.take_error()? {
            Some(error) => Err(error.into()),
            None => Ok(()),
        }
    }

    /// Becomes a server; `backlog` connections may wait to be accepted.
    pub fn listen(&mut self, backlog: i32) -> Result<(), Failure> {
        self.opened()?.listen(backlog)?;
        self.role = Role::Server;
        Ok(())
    }

    /// The next connection.
    pub fn accept(&self, wait: &Wait<'_>) -> Result<Self, Failure> {
        let socket = self.opened()?;
        loop {
            match socket.accept() {
                Ok((accepted, _)) => {
                    accepted.set_nonblocking(true)?;
                    let mut client = Self::unopened(self.family);
                    client.role = Role::Client;
                    client.socket = Some(Socket::new(accepted));
                    return Ok(client);
                }
                Err(error) if is_pending(&error) => wait.readable(socket)?,
                // The client has closed the connection before it was accepted.
                Err(error) if error.kind() == ErrorKind::ConnectionAborted => {}
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Appends to `out` what `pattern` requests, or what came before a failure.
    pub fn receive(
        &mut self,
        pattern: Pattern,
        out: &mut Vec<u8>,
        wait: &Wait<'_>,
    ) -> Result<(), Failure> {
        let Self {
            reader,
            socket,
            tls,
            ..
        } = self;
        let socket = socket.as_ref().ok_or(Failure::Closed)?;
        reader.read(pattern, out, |space| match tls {
            Some(tls) => tls.read(socket, space, wait),
            None => read(socket, space, wait),
        })
    }

    /// Sends everything, or returns how much was sent.
    pub fn send(&mut self, data: &[u8], wait: &Wait<'_>) -> (usize, Result<(), Failure>) {
        let Some(socket) = &self.socket else {
            return (0, Err(Failure::Closed));
        };
        let mut count = 0;
        let mut result = Ok(());
        while count < data.len() && result.is_ok() {
            let sent = match &mut self.tls {
                Some(tls) => tls.write(socket, &data[count..], wait),
                None => write(socket, &data[count..], wait),
            };
            match sent {
                Ok(sent) => count += sent,
                Err(failure) => result = Err(failure),
            }
        }
        self.sent += count as f64;
        (count, result)
    }

    /// Ends one direction of the connection, or both.
    pub fn shutdown(&self, how: std::net::Shutdown) {
        if let Some(socket) = &self.socket {
            // As in LuaSocket, it is no error if the connection was already closed.
            let _ = socket.shutdown(how);
        }
    }

    /// Whether it has no address yet; the system chooses one when it becomes a server.
    pub fn is_unbound(&self) -> bool {
        self.local()
            .is_ok_and(|place| matches!(place, SocketAddress::Net(address) if address.port() == 0))
    }

    /// The own address.
    pub fn local(&self) -> Result<SocketAddress, Failure> {
        Ok(SocketAddress::of(&self.opened()?.local_addr()?))
    }

    /// The address of the peer.
    pub fn peer(&self) -> Result<SocketAddress, Failure> {
        Ok(SocketAddress::of(&self.opened()?.peer_addr()?))
    }

    /// Bytes received and sent, and seconds since the object was made.
    pub fn stats(&self) -> (f64, f64, f64) {
        let received = self.received_before + self.reader.received as f64;
        (
            received,
            self.sent,
            self.age_before + self.birth.elapsed().as_secs_f64(),
        )
    }

    /// Sets the values of [`stats`](Self::stats).
    pub fn set_stats(&mut self, received: f64, sent: f64, age: f64) {
        self.received_before = received - self.reader.received as f64;
        self.sent = sent;
        self.birth = now();
        self.age_before = age;
    }
}

/// Some bytes, at least one.
pub(super) fn read(socket: &Socket, space: &mut [u8], wait: &Wait<'_>) -> Result<usize, Failure> {
    loop {
        match (&**socket).read(space) {
            Ok(0) => return Err(Failure::Closed),
            Ok(count) => return Ok(count),
            Err(error) if is_pending(&error) => wait.readable(socket)?,
            Err(error) => return Err(error.into()),
        }
    }
}

/// Sends some bytes, at least one.
fn write(socket: &Socket, data: &[u8], wait: &Wait<'_>) -> Result<usize, Failure> {
    loop {
        match (&**socket).write(data) {
            Ok(count) => return Ok(count),
            Err(error) if is_pending(&error) => wait.writable(socket)?,
            Err(error) => return Err(error.into()),
        }
    }
}
