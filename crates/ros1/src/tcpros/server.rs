//! A server of any protocol over TCP: a thread that accepts, and one for each connection.

use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv4Addr, Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};

use crate::{Result, limits};

/// Its connections end with it.
pub(crate) struct Server {
    address: SocketAddr,
    shared: Arc<Shared>,
    /// None only while it is dropped.
    thread: Option<JoinHandle<()>>,
}

struct Shared {
    is_closing: AtomicBool,
    connections: Mutex<Connections>,
    /// How many connections there are at most.
    limit: usize,
}

#[derive(Default)]
struct Connections {
    count: u64,
    open: BTreeMap<u64, Open>,
}

struct Open {
    stream: TcpStream,
    has_spoken: bool,
}

impl Shared {
    fn connections(&self) -> MutexGuard<'_, Connections> {
        self.connections
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Notes a connection. If there are too many, the oldest that has said nothing gives way; none when there is none.
    fn open(&self, stream: &TcpStream) -> Option<u64> {
        let mut connections = self.connections();
        if connections.open.len() >= self.limit {
            connections.end_silent()?;
        }
        connections.count += 1;
        let number = connections.count;
        let open = Open {
            stream: stream.try_clone().ok()?,
            has_spoken: false,
        };
        connections.open.insert(number, open);
        Some(number)
    }

    /// Waits until a connection says something; false when it ends before, or has to give way.
    fn has_received(&self, number: u64, stream: &TcpStream) -> bool {
        let _ = stream.set_read_timeout(Some(limits::SILENCE_TIMEOUT));
        let heard = stream.peek(&mut [0]).is_ok_and(|count| count > 0);
        let _ = stream.set_read_timeout(None);
        let mut connections = self.connections();
        let open = connections.open.get_mut(&number).filter(|_| heard);
        open.map(|open| open.has_spoken = true).is_some()
    }
}

impl Connections {
    fn end_silent(&mut self) -> Option<()> {
        let mut silent = self.open.iter().filter(|(_, open)| !open.has_spoken);
        let number = *silent.next()?.0;
        let ended = self.open.remove(&number)?;
        // Shutting down fails only if the connection is closed already.
        let _ = ended.stream.shutdown(Shutdown::Both);
        Some(())
    }
}

/// A connection, as its thread has it.
pub(crate) type Connection = TcpStream;

impl Server {
    /// Calls `serve` on a thread for each connection.
    pub(crate) fn start(
        listener: TcpListener,
        name: &str,
        serve: impl Fn(Connection) + Clone + Send + 'static,
    ) -> Result<Self> {
        Self::start_limited(listener, name, limits::CONNECTIONS, serve)
    }

    fn start_limited(
        listener: TcpListener,
        name: &str,
        limit: usize,
        serve: impl Fn(Connection) + Clone + Send + 'static,
    ) -> Result<Self> {
        let address = listener.local_addr()?;
        let shared = Arc::new(Shared {
            is_closing: AtomicBool::new(false),
            connections: Mutex::default(),
            limit,
        });
        let theirs = shared.clone();
        let name = name.to_string();
        let thread = thread::Builder::new().name(name.clone()).spawn(move || {
            for stream in listener.incoming() {
                if theirs.is_closing.load(Ordering::Acquire) {
                    return;
                }
                if let Ok(stream) = stream {
                    accept(stream, &name, &theirs, serve.clone());
                }
            }
        })?;
        Ok(Self {
            address,
            shared,
            thread: Some(thread),
        })
    }

    pub(crate) fn port(&self) -> u16 {
        self.address.port()
    }
}

/// What cannot be served is closed.
fn accept(
    stream: TcpStream,
    name: &str,
    shared: &Arc<Shared>,
    serve: impl FnOnce(Connection) + Send + 'static,
) {
    let Some(number) = shared.open(&stream) else {
        return;
    };
    let theirs = shared.clone();
    let started = thread::Builder::new()
        .name(name.to_string())
        .spawn(move || {
            let _ = stream.set_nodelay(true);
            if theirs.has_received(number, &stream) {
                serve(stream);
            }
            theirs.connections().open.remove(&number);
        });
    if started.is_err() {
        shared.connections().open.remove(&number);
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.shared.is_closing.store(true, Ordering::Release);
        // Ends the wait for connections.
        let loopback = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), self.address.port());
        let woken = TcpStream::connect_timeout(&loopback, limits::TIMEOUT);
        if let Some(thread) = self.thread.take()
            && woken.is_ok()
        {
            // The thread wakes up from `accept` and sees that it is to end; if it has panicked, it has ended.
            let _ = thread.join();
        }
        for open in self.shared.connections().open.values() {
            // Shutting down fails only if the connection is closed already.
            let _ = open.stream.shutdown(Shutdown::Both);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Read, Write};

    use super::{Server, TcpListener, TcpStream, limits};

    #[test]
    fn connections_that_say_nothing_give_way() {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
        let address = listener.local_addr().expect("it is bound");
        let echo = |mut stream: TcpStream| {
            let mut word = [0; 2];
            while stream.read_exact(&mut word).is_ok() && stream.write_all(&word).is_ok() {}
        };
        let _server = Server::start_limited(listener, "echo", 4, echo).expect("a thread");
        let open = || {
            let stream = TcpStream::connect(address).expect("it listens");
            let limit = limits::SILENCE_TIMEOUT / 2;
            stream.set_read_timeout(Some(limit)).expect("it is no zero");
            stream
        };
        let answers = |stream: &mut TcpStream| {
            stream.write_all(b"hi").expect("it reads");
            let mut answer = [0; 2];
            stream.read_exact(&mut answer).map(|()| answer).ok()
        };
        let mut friend = open();
        assert_eq!(answers(&mut friend), Some(*b"hi"));
        let silent: Vec<_> = (0..20).map(|_| open()).collect();
        assert_eq!(answers(&mut open()), Some(*b"hi"));
        assert_eq!(answers(&mut friend), Some(*b"hi"), "it has spoken");
        drop(silent);
    }
}
