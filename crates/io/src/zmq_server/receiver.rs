//! The receiving side of a connection.

use std::io::{self, ErrorKind};
use std::mem::MaybeUninit;
use std::pin::Pin;
use std::task::{Context, Poll, ready};

use tokio::io::{AsyncRead, ReadBuf};
use tokio::net::tcp::OwnedReadHalf;

use super::super::zmtp::{self, Decoder, PeerMessage};
use super::connection::Connection;

/// Bytes read of a connection whose request waits for its turn: the end of the connection shows behind them.
const MAX_AHEAD: usize = 1 << 20;
/// Size of a read.
const CHUNK: usize = 64 << 10;

/// The receiving side of a connection.
pub(super) struct Receiver {
    stream: OwnedReadHalf,
    decoder: Decoder,
}

impl Receiver {
    pub(super) fn new(stream: OwnedReadHalf) -> Self {
        Self {
            stream,
            decoder: Decoder::new(),
        }
    }

    /// Reads what has come; an error at its end.
    fn poll_read(&mut self, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let mut chunk = [MaybeUninit::uninit(); CHUNK];
        let mut chunk = ReadBuf::uninit(&mut chunk);
        ready!(Pin::new(&mut self.stream).poll_read(context, &mut chunk))?;
        if chunk.filled().is_empty() {
            return Poll::Ready(Err(ErrorKind::UnexpectedEof.into()));
        }
        self.decoder.feed(chunk.filled());
        Poll::Ready(Ok(()))
    }

    /// Waits until there is something to read or to send, and does that.
    async fn read_or_send(&mut self, connection: &Connection) -> io::Result<()> {
        tokio::select! {
            read = std::future::poll_fn(|context| self.poll_read(context)) => read,
            sent = connection.wait_to_send() => sent,
        }
    }

    /// Greets the peer and waits until it has introduced itself.
    pub(super) async fn shake_hands(&mut self, connection: &Connection) -> io::Result<()> {
        connection.send(&mut connection.outgoing(), &zmtp::hello(), &[])?;
        while !self.decoder.is_ready() {
            self.read_or_send(connection).await?;
            self.decoder.shake_hands().map_err(io::Error::other)?;
        }
        Ok(())
    }

    /// Waits until the simulator has the request before. What comes in meanwhile is stored, up to a limit, to see the end of the connection.
    pub(super) async fn wait_for_turn(&mut self, connection: &Connection) -> io::Result<()> {
        loop {
            connection.state().has_more = self.decoder.stored() > 0;
            if !connection.state().is_queued {
                return Ok(());
            }
            if self.decoder.stored() < MAX_AHEAD {
                self.read_or_send(connection).await?;
            } else {
                connection.wait_to_send().await?;
            }
        }
    }

    /// The next request of the peer; pings are answered here.
    pub(super) async fn next_request(
        &mut self,
        connection: &Connection,
    ) -> io::Result<zmtp::Request> {
        loop {
            match self.decoder.next().map_err(io::Error::other)? {
                Some(PeerMessage::Request(request)) => return Ok(request),
                Some(PeerMessage::Ping(context)) => {
                    connection.send(&mut connection.outgoing(), &zmtp::pong(&context), &[])?;
                }
                None => self.read_or_send(connection).await?,
            }
        }
    }
}
