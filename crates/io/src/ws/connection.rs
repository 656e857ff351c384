//! One open connection: messages in both directions until it ends.

use std::convert::Infallible;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use futures::stream::{SplitSink, SplitStream};
use futures::{SinkExt, StreamExt};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};
use tokio::time::timeout;
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::tungstenite::protocol::frame::coding::{CloseCode, Data, OpCode};
use tokio_tungstenite::tungstenite::protocol::frame::{CloseFrame, Frame};
use tokio_tungstenite::tungstenite::{Error, Message, Utf8Bytes};

use super::{Connection, HANDSHAKE_TIMEOUT, MAX_MESSAGE, Reports, WsEvent};

/// Maximum size of the queue for a slow peer, bytes.
const MAX_QUEUED: usize = 2 * MAX_MESSAGE;
/// Overhead of a queued message, bytes.
const OVERHEAD: usize = 64;

/// Why a message cannot be sent; the words are CoppeliaSim's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SendError {
    /// An opcode other than continuation, text or binary.
    #[error("invalid opcode: {0}")]
    Opcode(i64),
    /// A text that is not UTF-8.
    #[error("invalid payload: text must be valid UTF-8")]
    Text,
    /// There is no such connection, or no longer.
    #[error("connection_hdl weak_ptr expired")]
    Expired,
    /// It is about to be closed.
    #[error("invalid state")]
    State,
    /// Too many bytes wait to be sent.
    #[error("the peer is too slow: {MAX_QUEUED} bytes are waiting to be sent")]
    Full,
}

/// The message of an opcode as scripts know it.
pub(super) fn message(data: Vec<u8>, opcode: i64) -> Result<Message, SendError> {
    match opcode {
        0 => Ok(Message::Frame(Frame::message(
            data,
            OpCode::Data(Data::Continue),
            true,
        ))),
        1 => Ok(Message::Text(
            Utf8Bytes::try_from(data).map_err(|_| SendError::Text)?,
        )),
        2 => Ok(Message::Binary(data.into())),
        _ => Err(SendError::Opcode(opcode)),
    }
}

/// The way to a peer.
pub struct Outgoing {
    queue: UnboundedSender<Message>,
    /// Bytes on their way; the queue is bounded by them.
    bytes: Arc<AtomicUsize>,
}

impl Outgoing {
    pub(super) fn send(&self, message: Message) -> Result<(), SendError> {
        let size = size(&message);
        if self.bytes.load(Ordering::Relaxed) + size > MAX_QUEUED {
            return Err(SendError::Full);
        }
        self.queue.send(message).map_err(|_| SendError::State)?;
        self.bytes.fetch_add(size, Ordering::Relaxed);
        Ok(())
    }
}

fn size(message: &Message) -> usize {
    message.len() + OVERHEAD
}

/// The messages of an `Outgoing`.
struct Queue {
    messages: UnboundedReceiver<Message>,
    bytes: Arc<AtomicUsize>,
}

fn queue() -> (Outgoing, Queue) {
    let (sender, messages) = unbounded_channel();
    let bytes = Arc::<AtomicUsize>::default();
    (
        Outgoing {
            queue: sender,
            bytes: bytes.clone(),
        },
        Queue { messages, bytes },
    )
}

type Socket = WebSocketStream<TcpStream>;

/// Reports messages of the peer and sends queued ones, until the connection ends.
pub(super) async fn converse(socket: Socket, connection: Connection, reports: &Reports) {
    let (outgoing, queue) = queue();
    reports.report_open(connection, outgoing).await;
    let (mut sink, mut source) = socket.split();
    let refusal = tokio::select! {
        refusal = read_all(&mut source, connection, reports) => refusal,
        never = write_all(&mut sink, queue) => match never {},
    };
    let farewell = async {
        if let (Some(refusal), Ok(socket)) = (refusal, sink.reunite(source)) {
            // The peer may not read any more, so the time is limited.
            let _ = timeout(HANDSHAKE_TIMEOUT, refuse(socket, refusal)).await;
        }
    };
    tokio::join!(reports.report(WsEvent::Close(connection)), farewell);
}

/// Runs until the peer closes, disconnects or violates the protocol; returns the close frame to send.
async fn read_all(
    source: &mut SplitStream<Socket>,
    connection: Connection,
    reports: &Reports,
) -> Option<CloseFrame> {
    while let Some(message) = source.next().await {
        match message {
            Ok(Message::Text(text)) => {
                reports
                    .report(WsEvent::Message(connection, text.as_bytes().to_vec()))
                    .await;
            }
            Ok(Message::Binary(bytes)) => {
                reports
                    .report(WsEvent::Message(connection, bytes.into()))
                    .await;
            }
            Ok(Message::Close(_)) => {
                // The reply to a close is sent while the end of the stream is awaited.
                let _ = timeout(HANDSHAKE_TIMEOUT, async {
                    while source.next().await.is_some() {}
                })
                .await;
                return None;
            }
            // Pings are answered by the library.
            Ok(_) => {}
            Err(error) => return refusal(&error),
        }
    }
    None
}

fn refusal(error: &Error) -> Option<CloseFrame> {
    let code = match error {
        Error::Utf8(_) => CloseCode::Invalid,
        Error::Capacity(_) => CloseCode::Size,
        Error::Protocol(_) => CloseCode::Protocol,
        _ => return None,
    };
    Some(CloseFrame {
        code,
        reason: Utf8Bytes::default(),
    })
}

async fn refuse(mut socket: Socket, refusal: CloseFrame) -> Result<(), Error> {
    socket.send(Message::Close(Some(refusal))).await?;
    linger(socket.get_mut()).await;
    Ok(())
}

/// Closes a connection so that the peer can read the last message: closing while it is still sending would reset the connection.
pub(super) async fn linger(stream: &mut TcpStream) {
    let mut rest = [0; 4096];
    let ended = async {
        stream.shutdown().await?;
        while stream.read(&mut rest).await? > 0 {}
        std::io::Result::Ok(())
    };
    // The connection ends whether or not the peer has read this.
    let _ = timeout(HANDSHAKE_TIMEOUT, ended).await;
}

/// Sends what is queued. When that fails, the reading side notices the end.
async fn write_all(sink: &mut SplitSink<Socket, Message>, mut queue: Queue) -> Infallible {
    while let Some(first) = queue.messages.recv().await {
        if write(sink, first, &mut queue).await.is_err() {
            break;
        }
    }
    drop(queue);
    std::future::pending().await
}

/// One message and those behind it, in as few packets as possible.
async fn write(
    sink: &mut SplitSink<Socket, Message>,
    first: Message,
    queue: &mut Queue,
) -> Result<(), Error> {
    let mut written = size(&first);
    sink.feed(first).await?;
    while let Ok(next) = queue.messages.try_recv() {
        written += size(&next);
        sink.feed(next).await?;
    }
    sink.flush().await?;
    queue.bytes.fetch_sub(written, Ordering::Relaxed);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opcodes_are_those_of_the_protocol() {
        assert!(matches!(message(b"hi".to_vec(), 1), Ok(Message::Text(_))));
        assert!(matches!(message(vec![0, 255], 2), Ok(Message::Binary(_))));
        assert!(matches!(message(vec![], 0), Ok(Message::Frame(_))));
        assert_eq!(message(vec![0, 255], 1).err(), Some(SendError::Text));
        assert_eq!(
            message(vec![], 3).err().map(|e| e.to_string()).as_deref(),
            Some("invalid opcode: 3")
        );
    }

    #[test]
    fn a_queue_takes_so_much_and_no_more() {
        let (outgoing, queue) = queue();
        let large = || Message::Binary(vec![0; MAX_MESSAGE].into());
        assert_eq!(outgoing.send(large()), Ok(()));
        assert_eq!(outgoing.send(large()), Err(SendError::Full));
        drop(queue);
        assert_eq!(
            outgoing.send(Message::Binary(Vec::new().into())),
            Err(SendError::State)
        );
    }
}
