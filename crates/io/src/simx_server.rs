//! The sockets of a server of the legacy remote API.
//!
//! They have a thread of their own: a client expects an answer to each message at once, and waits for ever without one, however long the
//! simulator is busy. Only when commands have come, the answer waits a moment for their results, so that a blocking call takes one round
//! trip instead of two with a rest between them.

use std::collections::VecDeque;
use std::io::{self, ErrorKind};
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use heap::resource::Resource;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::sync::Notify;
use tokio::time::{Instant, timeout};

use super::event_loop::{EventLoop, Waker};
use wire::simx::{Packets, Received, Session, cut};

/// A client that is silent for so long is gone.
const SILENCE_TIMEOUT: Duration = Duration::from_secs(10);

/// How long an answer waits for the results of the commands it answers.
const RESULT_TIMEOUT: Duration = Duration::from_millis(20);

/// Connections that may have said nothing yet; at the limit the oldest gives way.
const MAX_SILENT: usize = 64;

/// Pause after a connection that could not be accepted.
const RETRY_DELAY: Duration = Duration::from_millis(50);

/// Bytes read at once.
const CHUNK: usize = 64 << 10;

/// A server for one client at a time; others wait until that one is gone.
pub struct SimxServer {
    shared: Arc<Shared>,
    /// None only while it is dropped.
    thread: Option<JoinHandle<()>>,
    _resource: Resource,
}

/// What both threads use.
struct Shared {
    session: Mutex<Session>,
    /// Commands wait for the simulator.
    waker: Waker,
    /// The simulator has executed commands.
    executed: Notify,
    /// The server is to end.
    end: Notify,
    max_packet: usize,
    /// Zero of the session's times.
    begun: Instant,
}

impl SimxServer {
    /// Serves the clients that `listener` accepts, in packets of at most `max_packet` bytes. `age` is the time since the simulator was made.
    ///
    /// # Errors
    /// When the system refuses a thread or an event queue.
    pub fn start(
        event_loop: &EventLoop,
        listener: TcpListener,
        max_packet: usize,
        session: Session,
        age: Duration,
    ) -> io::Result<Self> {
        listener.set_nonblocking(true)?;
        let now = Instant::now();
        let shared = Arc::new(Shared {
            session: session.into(),
            waker: event_loop.waker(),
            executed: Notify::new(),
            end: Notify::new(),
            max_packet,
            begun: now.checked_sub(age).unwrap_or(now),
        });
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_io()
            .enable_time()
            .build()?;
        let theirs = shared.clone();
        let thread = std::thread::Builder::new()
            .name("legacy remote API".into())
            .spawn(move || {
                runtime.block_on(async {
                    tokio::select! {
                        () = theirs.end.notified() => {}
                        () = serve_all(listener, &theirs) => {}
                    }
                });
            })?;
        Ok(Self {
            shared,
            thread: Some(thread),
            _resource: Resource::new(|| "the server of the legacy remote API".to_owned()),
        })
    }

    /// What is known of the client. Hold it for a moment only: the client waits.
    pub fn session(&self) -> MutexGuard<'_, Session> {
        self.shared.session()
    }

    /// The simulator is about to take the commands that wait.
    pub fn acknowledge(&self) {
        self.shared.waker.reset();
    }

    /// The results of commands are there.
    pub fn note_executed(&self) {
        self.shared.executed.notify_one();
    }
}

impl Drop for SimxServer {
    fn drop(&mut self) {
        self.shared.end.notify_one();
        if let Some(thread) = self.thread.take() {
            // It does nothing but wait for its sockets, so it ends at once; if it has panicked, it has ended.
            let _ = thread.join();
        }
    }
}

impl Shared {
    fn session(&self) -> MutexGuard<'_, Session> {
        self.session.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn now(&self) -> i64 {
        // 64 bits of milliseconds do not overflow.
        self.begun.elapsed().as_millis() as i64
    }

    /// Waits for the results of what has just come.
    async fn wait_for_results(&self) {
        self.waker.wake();
        let executed = async {
            while self.session().is_waiting() {
                self.executed.notified().await;
            }
        };
        // The client gets its results later if they are not there in time.
        let _ = timeout(RESULT_TIMEOUT, executed).await;
    }

    /// The packets of the reply to the last message.
    fn reply(&self, packets: &Packets) -> Vec<u8> {
        let mut session = self.session();
        let message = session.reply(self.now());
        if session.is_ready() {
            self.waker.wake();
        }
        drop(session);
        cut(&message, self.max_packet, packets.order())
    }
}

/// A connection that has said nothing yet.
struct Silent {
    stream: TcpStream,
    from: SocketAddr,
    since: Instant,
}

/// The next connection that says something: those that do not hold nobody up.
async fn next_client(
    listener: &tokio::net::TcpListener,
    silent: &mut VecDeque<Silent>,
) -> (TcpStream, SocketAddr) {
    loop {
        tokio::select! {
            biased;
            index = first_to_speak(silent) => if let Some(client) = silent.remove(index) {
                return (client.stream, client.from);
            },
            accepted = listener.accept() => match accepted {
                Ok((stream, from)) => {
                    silent.push_back(Silent { stream, from, since: Instant::now() });
                    silent.drain(..silent.len().saturating_sub(MAX_SILENT));
                }
                // Out of file descriptors, for instance.
                Err(_) => tokio::time::sleep(RETRY_DELAY).await,
            },
            () = tokio::time::sleep(SILENCE_TIMEOUT) => {}
        }
        silent.retain(|client| client.since.elapsed() < SILENCE_TIMEOUT);
    }
}

/// Waits until there is something to read from one of the connections, which may be its end.
async fn first_to_speak(silent: &VecDeque<Silent>) -> usize {
    if silent.is_empty() {
        return std::future::pending().await;
    }
    let words = silent.iter().map(|client| {
        Box::pin(async {
            // At the end of the connection there is nothing to read, and on failure neither: serving it ends at once.
            let _ = client.stream.peek(&mut [0]).await;
        })
    });
    futures::future::select_all(words).await.1
}

/// Serves one connection after the other.
async fn serve_all(listener: TcpListener, shared: &Shared) {
    // This does not fail: the thread has a runtime, and the listener is valid.
    let Ok(listener) = tokio::net::TcpListener::from_std(listener) else {
        return;
    };
    let mut silent = VecDeque::new();
    loop {
        let (stream, from) = next_client(&listener, &mut silent).await;
        shared.session().connect(text_of(from.ip()));
        // The client is gone, whether the connection was closed or failed.
        let _ = serve(stream, shared).await;
        shared.session().disconnect();
        // A simulation that waits for this client must continue.
        shared.waker.wake();
    }
}

/// Serves one connection to its end.
async fn serve(mut stream: TcpStream, shared: &Shared) -> io::Result<()> {
    stream.set_nodelay(true)?;
    let (mut packets, mut chunk) = (Packets::default(), vec![0; CHUNK]);
    loop {
        while let Some(message) = packets.next_message().map_err(refused)? {
            let received = shared
                .session()
                .receive(&message, packets.order(), shared.now());
            let Received { is_waiting, ends } = received.map_err(refused)?;
            if is_waiting {
                shared.wait_for_results().await;
            }
            timeout(SILENCE_TIMEOUT, stream.write_all(&shared.reply(&packets))).await??;
            if ends {
                return Ok(());
            }
        }
        let count = timeout(SILENCE_TIMEOUT, stream.read(&mut chunk)).await??;
        if count == 0 {
            return Ok(());
        }
        packets.feed(&chunk[..count]);
    }
}

pub fn refused(violation: wire::simx::Violation) -> io::Error {
    io::Error::new(ErrorKind::InvalidData, violation)
}

/// An address as the status shows it: that of version 4 also where it came by way of version 6.
fn text_of(address: IpAddr) -> String {
    address.to_canonical().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Read, Write};

    fn server() -> (SimxServer, SocketAddr) {
        let event_loop = EventLoop::new().expect("an event loop");
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
        let address = listener.local_addr().expect("it is bound");
        let session = Session::new(false);
        (
            SimxServer::start(&event_loop, listener, 1300, session, Duration::ZERO)
                .expect("a thread"),
            address,
        )
    }

    /// An empty message.
    fn empty(id: u8) -> Vec<u8> {
        let mut message = vec![0; 18];
        (message[2], message[3]) = (11, id);
        cut(&message, 1300, Default::default())
    }

    fn exchange(stream: &mut std::net::TcpStream, message: &[u8]) -> io::Result<[u8; 24]> {
        stream.write_all(message)?;
        let mut reply = [0; 24];
        stream.read_exact(&mut reply)?;
        Ok(reply)
    }

    #[test]
    fn an_empty_message_has_an_empty_reply_at_once() {
        let (server, address) = server();
        let mut client = std::net::TcpStream::connect(address).expect("it listens");
        let reply = exchange(&mut client, &empty(0)).expect("a reply comes");
        assert_eq!(
            reply[..13],
            [1, 0, 18, 0, 0, 0, 0, 0, 11, 0xff, 0xff, 0xff, 0xff]
        );
        assert_eq!(server.session().peer(), Some("127.0.0.1"));
    }

    #[test]
    fn the_next_client_is_served_when_the_first_is_gone() {
        let (server, address) = server();
        let mut first = std::net::TcpStream::connect(address).expect("it listens");
        exchange(&mut first, &empty(0)).expect("a reply comes");
        let mut second = std::net::TcpStream::connect(address).expect("it listens");
        second.write_all(&empty(0)).expect("the system takes it");
        drop(first);
        let mut reply = [0; 24];
        second.read_exact(&mut reply).expect("a reply comes");
        assert_eq!(server.session().connection(), Some(2));
    }

    #[test]
    fn connections_that_say_nothing_hold_nobody_up() {
        let (_server, address) = server();
        let open = || std::net::TcpStream::connect(address).expect("it listens");
        let silent: Vec<_> = (0..2 * MAX_SILENT).map(|_| open()).collect();
        let mut client = open();
        client
            .set_read_timeout(Some(SILENCE_TIMEOUT / 2))
            .expect("it is no zero");
        exchange(&mut client, &empty(0)).expect("a reply comes before the others are given up");
        drop((client, silent));
    }

    #[test]
    fn what_is_no_message_ends_the_connection() {
        let (_server, address) = server();
        for bad in [&b"GET / HTTP/1.1\r\n\r\n"[..], &[1, 0, 2, 0, 0, 0, 0, 0]] {
            let mut client = std::net::TcpStream::connect(address).expect("it listens");
            assert!(exchange(&mut client, bad).is_err());
        }
        let mut client = std::net::TcpStream::connect(address).expect("it listens");
        assert!(exchange(&mut client, &empty(0)).is_ok());
    }

    #[test]
    fn the_end_of_the_server_ends_its_connection() {
        let (server, address) = server();
        let mut client = std::net::TcpStream::connect(address).expect("it listens");
        exchange(&mut client, &empty(0)).expect("a reply comes");
        drop(server);
        assert_eq!(client.read(&mut [0]).ok(), Some(0));
    }
}
