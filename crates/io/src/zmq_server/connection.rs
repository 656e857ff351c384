//! The sending side of a connection, and what it is waiting for.

use std::io::{self, ErrorKind, IoSlice};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::net::tcp::OwnedWriteHalf;
use tokio::sync::Notify;
use tokio::time::Instant;

use super::super::zmtp;

/// Bytes that may wait for a client to read them, beyond the answer that made it so many.
const MAX_UNREAD: usize = 64 << 20;

/// The sending side of a connection.
pub(super) struct Connection {
    stream: OwnedWriteHalf,
    outgoing: Mutex<Outgoing>,
    /// Wakes the connection's task when there is something to send, or when it is its turn.
    more: Notify,
    state: Mutex<State>,
}

/// The state of a connection.
pub(super) struct State {
    /// Its request waits for the simulator. The next one has to wait as well, so that all connections have their turn.
    pub(super) is_queued: bool,
    /// More has come in meanwhile.
    pub(super) has_more: bool,
    /// Its request has no answer yet.
    is_asking: bool,
    /// It has made a request at some time.
    has_asked: bool,
    /// The time of the last request or reply.
    last_active: Instant,
}

#[derive(Default)]
pub struct Outgoing {
    /// The envelope of the reply to the last request.
    pub(super) envelope: Vec<u8>,
    /// Bytes that the system has not accepted yet.
    unsent: Vec<u8>,
    /// Nothing can be sent any more.
    is_abandoned: bool,
}

impl Connection {
    pub(super) fn new(stream: OwnedWriteHalf) -> Self {
        let state = State {
            is_queued: false,
            has_more: false,
            is_asking: false,
            has_asked: false,
            last_active: Instant::now(),
        };
        Self {
            stream,
            outgoing: Mutex::default(),
            more: Notify::new(),
            state: state.into(),
        }
    }

    pub(super) fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A request is going to wait for the simulator.
    pub(super) fn enter_queue(&self) {
        *self.state() = State {
            is_queued: true,
            has_more: false,
            is_asking: true,
            has_asked: true,
            last_active: Instant::now(),
        };
    }

    /// The simulator has the request.
    pub(super) fn leave_queue(&self) {
        let mut state = self.state();
        state.is_queued = false;
        // Usually the next request comes after the answer, which wakes the task by itself.
        if state.has_more {
            self.more.notify_one();
        }
    }

    /// Whether it has ever asked for something, and since when it has been silent; None while it waits for an answer.
    pub(super) fn silence(&self) -> Option<(bool, Instant)> {
        let state = self.state();
        let is_silent = !state.is_asking && !self.outgoing().is_abandoned;
        is_silent.then_some((state.has_asked, state.last_active))
    }

    /// Ends the task of the connection.
    pub(super) fn abandon(&self) {
        self.outgoing().is_abandoned = true;
        self.more.notify_one();
    }

    pub(super) fn outgoing(&self) -> MutexGuard<'_, Outgoing> {
        self.outgoing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn answer(&self, content: &[u8]) {
        let mut state = self.state();
        (state.is_asking, state.last_active) = (false, Instant::now());
        drop(state);
        let mut outgoing = self.outgoing();
        let head = zmtp::answer_head(&outgoing.envelope, content);
        if self.send(&mut outgoing, &head, content).is_err() {
            drop(outgoing);
            self.abandon();
        }
    }

    /// Writes bytes and those that follow; what the system does not accept at once is stored.
    pub(super) fn send(
        &self,
        outgoing: &mut Outgoing,
        head: &[u8],
        content: &[u8],
    ) -> io::Result<()> {
        if outgoing.unsent.len() > MAX_UNREAD {
            return Err(ErrorKind::OutOfMemory.into());
        }
        let sent = if outgoing.unsent.is_empty() {
            self.write(head, content)?
        } else {
            0
        };
        if sent < head.len() + content.len() {
            let (head_left, content_left) = left(head, content, sent);
            outgoing.unsent.extend_from_slice(head_left);
            outgoing.unsent.extend_from_slice(content_left);
            self.more.notify_one();
        }
        Ok(())
    }

    /// Writes as much as the system takes without waiting.
    fn write(&self, head: &[u8], content: &[u8]) -> io::Result<usize> {
        let mut sent = 0;
        while sent < head.len() + content.len() {
            let (head, content) = left(head, content, sent);
            let both = [IoSlice::new(head), IoSlice::new(content)];
            match self.stream.try_write_vectored(&both) {
                Ok(count) => sent += count,
                Err(error) if error.kind() == ErrorKind::WouldBlock => break,
                Err(error) => return Err(error),
            }
        }
        Ok(sent)
    }

    /// Sends what was stored.
    fn flush(&self) -> io::Result<()> {
        let mut outgoing = self.outgoing();
        let sent = self.write(&outgoing.unsent, &[])?;
        outgoing.unsent.drain(..sent);
        Ok(())
    }

    /// Whether something is stored.
    fn has_unsent(&self) -> io::Result<bool> {
        let outgoing = self.outgoing();
        if outgoing.is_abandoned {
            Err(ErrorKind::ConnectionAborted.into())
        } else {
            Ok(!outgoing.unsent.is_empty())
        }
    }

    /// Waits until what is stored can be sent, or there is something to send.
    pub(super) async fn wait_to_send(&self) -> io::Result<()> {
        if self.has_unsent()? {
            self.stream.writable().await?;
            self.flush()
        } else {
            self.more.notified().await;
            Ok(())
        }
    }
}

/// What is left of two parts of which so many bytes are done with.
fn left<'a>(head: &'a [u8], content: &'a [u8], done: usize) -> (&'a [u8], &'a [u8]) {
    let of_head = done.min(head.len());
    (&head[of_head..], &content[done - of_head..])
}
