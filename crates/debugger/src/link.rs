//! The connection to a client: threads that read and write, so that the simulation waits for neither.

use std::io::{Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{
    Receiver, RecvTimeoutError, Sender, SyncSender, TryRecvError, channel, sync_channel,
};
use std::time::Duration;

use serde_json::Value;

use crate::client::{Client, Incoming};
use crate::framing::{Framing, framed};

/// Messages that wait for a slow client; then the simulation waits.
const MAX_WAITING: usize = 10_000;
/// How long a request may wait before code that runs is asked to let it be looked at, and how often that is done.
const REQUEST_TIMEOUT: Duration = Duration::from_millis(30);
const MAX_ASKED: u32 = 20;
/// How long code may go on when the run is to end.
const END_TIMEOUT: Duration = Duration::from_secs(2);

/// Lets the simulation look at requests in the middle of code that runs.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// The end of the connection that the simulator's thread has.
pub struct Link {
    incoming: Receiver<Incoming>,
    unread: Arc<AtomicUsize>,
    forces_end: Arc<AtomicBool>,
    outgoing: SyncSender<Outgoing>,
    finished: Receiver<()>,
}

enum Outgoing {
    Client(Box<dyn Write + Send>),
    Bytes(Vec<u8>),
    End,
}

impl Link {
    /// One client, over a pair of streams.
    ///
    /// # Errors
    /// When there can be no more threads.
    pub fn of_streams(
        input: impl Read + Send + 'static,
        output: impl Write + Send + 'static,
        wake: Wake,
    ) -> std::io::Result<Self> {
        let (link, reader) = Self::new(wake)?;
        let _ = link.outgoing.send(Outgoing::Client(Box::new(output)));
        std::thread::Builder::new()
            .name("debugger".into())
            .spawn(move || reader.serve(input))?;
        Ok(link)
    }

    /// Clients that come to a port of this machine, one after the other. Port 0 lets the system choose.
    ///
    /// # Errors
    /// When the port is not free.
    pub fn listen(port: u16, wake: Wake) -> std::io::Result<(Self, SocketAddr)> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        let address = listener.local_addr()?;
        let (link, reader) = Self::new(wake)?;
        let outgoing = link.outgoing.clone();
        std::thread::Builder::new()
            .name("debugger".into())
            .spawn(move || {
                for stream in listener.incoming().flatten() {
                    let _ = stream.set_nodelay(true);
                    let Ok(output) = stream.try_clone() else {
                        continue;
                    };
                    if outgoing.send(Outgoing::Client(Box::new(output))).is_err() {
                        return;
                    }
                    reader.serve(stream);
                }
            })?;
        Ok((link, address))
    }

    fn new(wake: Wake) -> std::io::Result<(Self, Reader)> {
        let (to_simulator, incoming) = channel();
        let (outgoing, to_client) = sync_channel(MAX_WAITING);
        let (finish, finished) = channel();
        std::thread::Builder::new()
            .name("debugger, output".into())
            .spawn(move || write_all(&to_client, &finish))?;
        let unread = Arc::<AtomicUsize>::default();
        let forces_end = Arc::<AtomicBool>::default();
        let reader = Reader {
            to_simulator,
            unread: Arc::clone(&unread),
            forces_end: Arc::clone(&forces_end),
            wake,
        };
        let link = Self {
            incoming,
            unread,
            forces_end,
            outgoing,
            finished,
        };
        Ok((link, reader))
    }

    fn noted(&self, incoming: Incoming) -> Incoming {
        self.unread.fetch_sub(1, Ordering::AcqRel);
        incoming
    }
}

impl Client for Link {
    fn try_receive(&self) -> Option<Incoming> {
        match self.incoming.try_recv() {
            Ok(incoming) => Some(self.noted(incoming)),
            Err(TryRecvError::Empty | TryRecvError::Disconnected) => None,
        }
    }

    fn receive(&self, timeout: Duration) -> Option<Incoming> {
        match self.incoming.recv_timeout(timeout) {
            Ok(incoming) => Some(self.noted(incoming)),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(Incoming::Gone(None)),
        }
    }

    fn send(&self, message: &Value) {
        let _ = self.outgoing.send(Outgoing::Bytes(framed(message)));
    }

    fn force_end_on_request(&self) {
        self.forces_end.store(true, Ordering::Release);
    }

    fn finish(&self, timeout: Duration) {
        let _ = self.outgoing.send(Outgoing::End);
        let _ = self.finished.recv_timeout(timeout);
    }
}

fn write_all(messages: &Receiver<Outgoing>, finish: &Sender<()>) {
    let mut client: Option<Box<dyn Write + Send>> = None;
    for message in messages {
        match message {
            Outgoing::Client(new) => client = Some(new),
            Outgoing::End => drop(finish.send(())),
            Outgoing::Bytes(bytes) => {
                let written = client.as_mut().map(|client| {
                    client.write_all(&bytes)?;
                    client.flush()
                });
                if written.is_some_and(|written| written.is_err()) {
                    client = None;
                }
            }
        }
    }
}

struct Reader {
    to_simulator: Sender<Incoming>,
    unread: Arc<AtomicUsize>,
    forces_end: Arc<AtomicBool>,
    wake: Wake,
}

impl Reader {
    /// Reads the messages of a client until it goes.
    fn serve(&self, mut input: impl Read) {
        self.pass(Incoming::Connected);
        let mut framing = Framing::default();
        let mut buffer = [0; 1 << 12];
        let reason = loop {
            match framing.next_message() {
                Ok(Some(message)) => self.pass(Incoming::Message(message)),
                Err(malformed) => break Some(malformed.0),
                Ok(None) => match input.read(&mut buffer) {
                    Ok(0) | Err(_) => break None,
                    Ok(count) => framing.push(&buffer[..count]),
                },
            }
        };
        self.pass(Incoming::Gone(reason));
    }

    fn pass(&self, incoming: Incoming) {
        let command = match &incoming {
            Incoming::Message(message) => {
                message["command"].as_str().unwrap_or_default().to_owned()
            }
            Incoming::Gone(_) => "disconnect".into(),
            Incoming::Connected => String::new(),
        };
        self.hand_over(incoming);
        match command.as_str() {
            // The code has had time to come to a trap; a loop in one line has none.
            "pause" => {
                std::thread::sleep(REQUEST_TIMEOUT);
                (self.wake)();
            }
            "terminate" | "restart" | "disconnect" if self.forces_end.load(Ordering::Acquire) => {
                self.force_end();
            }
            _ => {}
        }
    }

    /// Code that goes on for long after the end is asked again and again.
    fn force_end(&self) {
        let wake = Arc::clone(&self.wake);
        let ask = move || {
            for _ in 0..MAX_ASKED {
                std::thread::sleep(END_TIMEOUT);
                wake();
            }
        };
        // Without a thread, the code ends by itself or with the process.
        let _ = std::thread::Builder::new().spawn(ask);
    }

    fn hand_over(&self, incoming: Incoming) {
        self.unread.fetch_add(1, Ordering::AcqRel);
        if self.to_simulator.send(incoming).is_err() {
            return;
        }
        // Code that runs is not disturbed for what is read soon anyway.
        for _ in 0..MAX_ASKED {
            std::thread::sleep(Duration::from_micros(200));
            if self.unread.load(Ordering::Acquire) == 0 {
                return;
            }
            std::thread::sleep(REQUEST_TIMEOUT);
            if self.unread.load(Ordering::Acquire) == 0 {
                return;
            }
            (self.wake)();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use serde_json::json;

    use super::*;

    #[test]
    fn a_client_comes_speaks_and_goes() {
        let input = [framed(&json!(1)), b"nonsense\r\n\r\n".to_vec()].concat();
        let link =
            Link::of_streams(Cursor::new(input), Vec::new(), Arc::new(|| {})).expect("threads");
        let next = || link.receive(Duration::from_secs(20));
        assert_eq!(next(), Some(Incoming::Connected));
        assert_eq!(next(), Some(Incoming::Message(json!(1))));
        assert_eq!(
            next(),
            Some(Incoming::Gone(Some("a header has no length".into())))
        );
    }
}
