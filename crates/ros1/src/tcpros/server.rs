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

#[derive(Default)]
struct Shared {
    is_closing: AtomicBool,
    connections: Mutex<Connections>,
}

#[derive(Default)]
struct Connections {
    count: u64,
    open: BTreeMap<u64, TcpStream>,
}

impl Shared {
    fn connections(&self) -> MutexGuard<'_, Connections> {
        self.connections
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Notes a connection, if there are not too many.
    fn open(&self, stream: &TcpStream) -> Option<u64> {
        let mut connections = self.connections();
        if connections.open.len() >= limits::CONNECTIONS {
            return None;
        }
        connections.count += 1;
        let number = connections.count;
        connections.open.insert(number, stream.try_clone().ok()?);
        Some(number)
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
        let address = listener.local_addr()?;
        let shared = Arc::new(Shared::default());
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
            serve(stream);
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
        for stream in self.shared.connections().open.values() {
            // Shutting down fails only if the connection is closed already.
            let _ = stream.shutdown(Shutdown::Both);
        }
    }
}
