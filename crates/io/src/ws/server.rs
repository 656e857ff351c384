//! Server side of the WebSocket handshake, and plain HTTP requests.

use std::sync::Arc;
use std::time::Duration;

use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::oneshot;
use tokio::task::JoinSet;
use tokio::time::{sleep, timeout};
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::tungstenite::handshake::server::{create_response, write_response};
use tokio_tungstenite::tungstenite::http::StatusCode;
use tokio_tungstenite::tungstenite::http::header::{
    EXPECT, HeaderValue, ORIGIN, SEC_WEBSOCKET_PROTOCOL,
};
use tokio_tungstenite::tungstenite::protocol::Role;

use super::chunks::Chunks;
use super::http::{Head, Reply, Requester, response};
use super::pages::Pages;
use super::places::{Place, Places};
use super::{Connection, HANDSHAKE_TIMEOUT, READ_BUFFER, Reports, WsEvent, config, connection};

/// Connections of one server. At the limit, the one that has been silent for longest gives way to a new one. If all have made their requests,
/// that waits until one ends.
pub(super) const MAX_CONNECTIONS: usize = 1000;
/// Pause when the system has no more sockets.
pub(super) const RETRY_DELAY: Duration = Duration::from_millis(100);
/// Time limit for a client to read an HTTP response.
const READ_TIMEOUT: Duration = Duration::from_secs(60);

/// Serves everyone who connects.
pub(super) async fn accept_all(
    listener: TcpListener,
    pages: Pages,
    reports: Reports,
    connections: usize,
) {
    let pages = Arc::new(pages);
    let places = Places::new(connections);
    let mut tasks = JoinSet::new();
    loop {
        while tasks.try_join_next().is_some() {}
        let Ok((stream, _)) = listener.accept().await else {
            // Out of file descriptors, for instance.
            places.end_silent();
            sleep(RETRY_DELAY).await;
            continue;
        };
        let Some(mut place) = places.take().await else {
            return;
        };
        let (reports, pages) = (reports.clone(), pages.clone());
        tasks.spawn(async move {
            serve(stream, &mut place, &pages, &reports).await;
        });
    }
}

async fn serve(mut stream: TcpStream, place: &mut Place, pages: &Pages, reports: &Reports) {
    let connection = reports.numbers.next();
    // Small messages are sent at once; if this cannot be set, they are sent later.
    let _ = stream.set_nodelay(true);
    let mut received = Vec::new();
    let head = timeout(HANDSHAKE_TIMEOUT, read_head(&mut stream, &mut received));
    let Some(head) = place.receive(head).await else {
        return; // Nobody has heard of it.
    };
    let refused = match head {
        Ok(Ok(head)) if head.is_upgrade() && !pages.admit(head.header(ORIGIN)) => {
            let origin = head.header(ORIGIN).unwrap_or_default().to_owned();
            reports.report(WsEvent::Refused(connection, origin)).await;
            return respond(
                &mut stream,
                &Reply::status(StatusCode::FORBIDDEN.as_u16()),
                "",
                true,
            )
            .await;
        }
        Ok(Ok(head)) if head.is_upgrade() => match upgrade(&mut stream, &head).await {
            Ok(()) => {
                let socket = WebSocketStream::from_partially_read(
                    stream,
                    received,
                    Role::Server,
                    Some(config()),
                )
                .await;
                return connection::converse(socket, connection, reports).await;
            }
            Err(status) => Some(status),
        },
        Ok(Ok(head)) => return answer(stream, connection, &head, received, reports).await,
        Ok(Err(refused)) => refused,
        Err(_) => Some(StatusCode::REQUEST_TIMEOUT),
    };
    let reason = refused.map_or_else(
        || "the connection ended".to_owned(),
        |status| status.to_string(),
    );
    let refuse = async {
        if let Some(status) = refused {
            respond(&mut stream, &Reply::status(status.as_u16()), "", true).await;
        }
    };
    tokio::join!(reports.report(WsEvent::Fail(connection, reason)), refuse);
}

/// Reads the head of a request; what was read beyond it stays in `received`.
///
/// # Errors
/// The status to answer with; none when the peer is gone.
pub(super) async fn read_head(
    stream: &mut TcpStream,
    received: &mut Vec<u8>,
) -> Result<Head, Option<StatusCode>> {
    loop {
        if let Some((head, length)) = Head::parse(received)? {
            received.drain(..length);
            return Ok(head);
        }
        read_some(stream, received).await.ok_or(None)?;
    }
}

/// Appends what comes next; nothing at the end of the connection.
async fn read_some(stream: &mut TcpStream, received: &mut Vec<u8>) -> Option<()> {
    received.reserve(READ_BUFFER);
    match stream.read_buf(received).await {
        Ok(count) if count > 0 => Some(()),
        _ => None,
    }
}

/// Answers the handshake of a WebSocket client.
///
/// # Errors
/// The status to answer with when it is none.
pub(super) async fn upgrade(stream: &mut TcpStream, head: &Head) -> Result<(), StatusCode> {
    let mut answer = create_response(&head.handshake()?).map_err(|_| StatusCode::BAD_REQUEST)?;
    // Any sub-protocol is accepted; a browser fails unless the reply names one of its own.
    let offered = head
        .header(SEC_WEBSOCKET_PROTOCOL)
        .and_then(|list| list.split(',').next());
    if let Some(first) = offered.and_then(|name| HeaderValue::from_str(name.trim()).ok()) {
        answer.headers_mut().insert(SEC_WEBSOCKET_PROTOCOL, first);
    }
    let mut bytes = Vec::new();
    write_response(&mut bytes, &answer).map_err(|_| StatusCode::BAD_REQUEST)?;
    // If the peer is gone, the next read fails.
    let _ = stream.write_all(&bytes).await;
    Ok(())
}

/// Lets the script answer an HTTP request.
async fn answer(
    mut stream: TcpStream,
    connection: Connection,
    head: &Head,
    received: Vec<u8>,
    reports: &Reports,
) {
    let reply = match read_body(&mut stream, head, received).await {
        Ok(body) => {
            let (sender, answered) = oneshot::channel();
            let resource = head.target.clone();
            reports
                .report(WsEvent::Http {
                    connection,
                    resource,
                    body,
                    requester: Requester(sender),
                })
                .await;
            answered.await.ok()
        }
        Err(status) => status.map(|status| Reply::status(status.as_u16())),
    };
    if let Some(reply) = reply {
        respond(&mut stream, &reply, &head.target, head.method != "HEAD").await;
    }
}

/// Reads the body of a request whose first bytes are there.
///
/// # Errors
/// The status to answer with; none when the peer is gone.
async fn read_body(
    stream: &mut TcpStream,
    head: &Head,
    mut body: Vec<u8>,
) -> Result<Vec<u8>, Option<StatusCode>> {
    let is_chunked = head.is_chunked()?;
    let length = head.body_length()?;
    if (is_chunked || body.len() < length) && head.header(EXPECT).is_some() {
        stream
            .write_all(b"HTTP/1.1 100 Continue\r\n\r\n")
            .await
            .map_err(|_| None)?;
    }
    if is_chunked {
        return read_chunks(stream, body).await;
    }
    while body.len() < length {
        read_more(stream, &mut body).await?;
    }
    body.truncate(length);
    Ok(body)
}

async fn read_chunks(
    stream: &mut TcpStream,
    mut received: Vec<u8>,
) -> Result<Vec<u8>, Option<StatusCode>> {
    let mut chunks = Chunks::default();
    while !chunks.take(&mut received)? {
        read_more(stream, &mut received).await?;
    }
    Ok(chunks.into_body())
}

/// Appends what comes next of a body.
async fn read_more(
    stream: &mut TcpStream,
    received: &mut Vec<u8>,
) -> Result<(), Option<StatusCode>> {
    let more = timeout(HANDSHAKE_TIMEOUT, read_some(stream, received)).await;
    more.map_err(|_| StatusCode::REQUEST_TIMEOUT)?.ok_or(None)
}

async fn respond(stream: &mut TcpStream, reply: &Reply, target: &str, with_body: bool) {
    let bytes = response(reply, target, with_body);
    if let Ok(Ok(())) = timeout(READ_TIMEOUT, stream.write_all(&bytes)).await {
        connection::linger(stream).await;
    }
}
