//! A web site with live pages, on a thread of its own: plain files, and WebSocket connections that are sent what is new whenever there is something.
//!
//! What the pages show and say is the business of a [`Site`]. Each connection asks for its messages when it can send them, so that a
//! slow page is handed fewer of them, and nothing queues up.

use std::io;
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use futures::stream::{SplitSink, SplitStream};
use futures::{SinkExt, StreamExt};
use tokio::io::AsyncWriteExt;
use tokio::net::TcpStream;
use tokio::sync::watch;
use tokio::task::JoinSet;
use tokio::time::{sleep, timeout};
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::tungstenite::http::StatusCode;
use tokio_tungstenite::tungstenite::http::header::{
    CONNECTION, CONTENT_LENGTH, HOST, IF_NONE_MATCH, ORIGIN, TRANSFER_ENCODING,
};
use tokio_tungstenite::tungstenite::protocol::{Role, WebSocketConfig};
use tokio_tungstenite::tungstenite::{Message, Utf8Bytes};

use super::http::Head;
use super::pages::host_of;
use super::places::{Place, Places};
use super::server::{MAX_CONNECTIONS, RETRY_DELAY, read_head, upgrade};
use super::{HANDSHAKE_TIMEOUT, READ_BUFFER, connection};

/// The largest message of a page, bytes.
const MAX_REQUEST: usize = 1 << 20;
/// How long a page may take to read what it was sent, and a connection may be silent between two requests.
const PAGE_TIMEOUT: Duration = Duration::from_secs(60);
/// How long open pages are waited for at the end.
const CLOSE_TIMEOUT: Duration = Duration::from_millis(500);

/// What a server shows.
pub trait Site: Send + Sync + 'static {
    /// The answer to a GET for a path (with its query); `known` is what the browser has of it, by the tag of an earlier answer.
    fn get(&self, path: &str, known: Option<&str>) -> SiteReply;

    /// The other side of a WebSocket at that path; none where there is none.
    fn open(&self, path: &str) -> Option<Box<dyn Visitor>>;
}

/// The site's side of one WebSocket connection. Dropped when that ends.
pub trait Visitor: Send {
    /// A message of the page.
    fn receive(&mut self, message: &[u8]);

    /// What to send now. Called after each wake-up, when the messages before have been sent.
    fn messages(&mut self) -> Vec<SiteMessage>;
}

/// A message to a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SiteMessage {
    /// A text message.
    Text(String),
    /// A binary message.
    Binary(Vec<u8>),
}

/// The answer to a GET.
pub struct SiteReply {
    /// The status code.
    pub status: u16,
    /// Besides the length and the connection.
    pub headers: Vec<(&'static str, String)>,
    /// The body, which answers may share.
    pub body: Arc<dyn AsRef<[u8]> + Send + Sync>,
}

/// A running server. It ends when this is dropped.
pub struct SiteServer {
    address: SocketAddr,
    wake: Arc<watch::Sender<Signal>>,
    thread: Option<JoinHandle<()>>,
}

/// Wakes the connections of a server.
#[derive(Clone)]
pub struct SiteWaker(Arc<watch::Sender<Signal>>);

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Signal {
    count: u64,
    ends: bool,
}

impl SiteWaker {
    /// There may be something new for the pages.
    pub fn wake(&self) {
        self.0.send_modify(|signal| signal.count += 1);
    }
}

impl SiteServer {
    /// Serves those who connect to `listener`. The site is made with what wakes the connections.
    ///
    /// # Errors
    /// When the listener cannot be used, or there is no thread for the server.
    pub fn start<S: Site>(
        listener: TcpListener,
        site: impl FnOnce(SiteWaker) -> S,
    ) -> io::Result<Self> {
        Self::start_limited(listener, site, MAX_CONNECTIONS)
    }

    fn start_limited<S: Site>(
        listener: TcpListener,
        site: impl FnOnce(SiteWaker) -> S,
        connections: usize,
    ) -> io::Result<Self> {
        listener.set_nonblocking(true)?;
        let address = listener.local_addr()?;
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()?;
        let (wake, signals) = watch::channel(Signal::default());
        let wake = Arc::new(wake);
        let site = Arc::new(site(SiteWaker(Arc::clone(&wake))));
        let serve = move || {
            let listener = {
                let _context = runtime.enter();
                tokio::net::TcpListener::from_std(listener)
            };
            if let Ok(listener) = listener {
                runtime.block_on(accept_all(listener, site, signals, connections));
            }
        };
        let thread = std::thread::Builder::new()
            .name("view server".into())
            .spawn(serve)?;
        Ok(Self {
            address,
            wake,
            thread: Some(thread),
        })
    }

    /// The address it listens at.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// What wakes the connections of this server.
    pub fn waker(&self) -> SiteWaker {
        SiteWaker(Arc::clone(&self.wake))
    }
}

impl Drop for SiteServer {
    /// Pages are sent the last messages, and are not waited for longer than a moment.
    fn drop(&mut self) {
        self.wake.send_modify(|signal| signal.ends = true);
        if let Some(thread) = self.thread.take() {
            // If the server's thread has panicked, it has ended as well.
            let _ = thread.join();
        }
    }
}

async fn accept_all<S: Site>(
    listener: tokio::net::TcpListener,
    site: Arc<S>,
    mut signals: watch::Receiver<Signal>,
    connections: usize,
) {
    let places = Places::new(connections);
    let mut tasks = JoinSet::new();
    loop {
        let accepted = async {
            let (stream, _) = listener.accept().await.ok()?;
            Some((stream, places.take().await?))
        };
        let accepted = tokio::select! {
            accepted = accepted => accepted,
            _ = signals.wait_for(|signal| signal.ends) => break,
        };
        while tasks.try_join_next().is_some() {}
        match accepted {
            Some((stream, mut place)) => {
                let (site, signals) = (Arc::clone(&site), signals.clone());
                tasks.spawn(async move {
                    serve(stream, &mut place, &*site, signals).await;
                });
            }
            None => {
                // Out of file descriptors, for instance.
                places.end_silent();
                sleep(RETRY_DELAY).await;
            }
        }
    }
    let _ = timeout(CLOSE_TIMEOUT, async {
        while tasks.join_next().await.is_some() {}
    })
    .await;
}

/// The requests of one connection, one after the other.
async fn serve<S: Site>(
    mut stream: TcpStream,
    place: &mut Place,
    site: &S,
    mut signals: watch::Receiver<Signal>,
) {
    let local = stream.local_addr().map(|address| address.ip()).ok();
    let _ = stream.set_nodelay(true);
    let mut received = Vec::new();
    loop {
        let head = tokio::select! {
            head = place.receive(timeout(PAGE_TIMEOUT, read_head(&mut stream, &mut received))) => head,
            _ = signals.wait_for(|signal| signal.ends) => return,
        };
        let Some(Ok(Ok(head))) = head else {
            if let Some(Ok(Err(Some(status)))) = head {
                refuse(&mut stream, status, "").await;
            }
            return;
        };
        if let Err(status) = check(&head, local) {
            return refuse(&mut stream, status, &head.method).await;
        }
        if head.is_upgrade() {
            return open(stream, site, &head, received, signals).await;
        }
        let reply = site.get(&head.target, head.header(IF_NONE_MATCH));
        let goes_on = head.is_current
            && head
                .header(CONNECTION)
                .is_none_or(|value| !value.eq_ignore_ascii_case("close"));
        if !respond(&mut stream, &reply, &head.method, goes_on).await || !goes_on {
            return connection::linger(&mut stream).await;
        }
    }
}

/// Whether a request may be answered: a GET without a body, to a name that means this machine, of a page of this server or of none. A page of another server
/// cannot pretend to be one of this by a name of its own that leads here.
fn check(head: &Head, local: Option<IpAddr>) -> Result<(), StatusCode> {
    let host = head.header(HOST).ok_or(StatusCode::BAD_REQUEST)?;
    if !is_this_machine(host, local) {
        return Err(StatusCode::FORBIDDEN);
    }
    let own = |origin: &str| {
        origin
            .split_once("://")
            .is_some_and(|(_, authority)| authority == host)
    };
    if head.headers.contains_key(ORIGIN) && !head.header(ORIGIN).is_some_and(own) {
        return Err(StatusCode::FORBIDDEN);
    }
    if !matches!(head.method.as_str(), "GET" | "HEAD") {
        return Err(StatusCode::METHOD_NOT_ALLOWED);
    }
    let has_body = head.headers.contains_key(TRANSFER_ENCODING)
        || head
            .header(CONTENT_LENGTH)
            .is_some_and(|length| length.trim() != "0");
    if has_body {
        Err(StatusCode::BAD_REQUEST)
    } else {
        Ok(())
    }
}

/// Whether a `Host` is this machine by a local name or by an address: its own, or the one connected to.
fn is_this_machine(host: &str, local: Option<IpAddr>) -> bool {
    let is_own = |address: IpAddr| address.is_loopback() || Some(address) == local;
    host_of(host).is_some_and(|name| {
        name.eq_ignore_ascii_case("localhost") || name.parse().is_ok_and(is_own)
    })
}

async fn refuse(stream: &mut TcpStream, status: StatusCode, method: &str) {
    let reply = SiteReply {
        status: status.as_u16(),
        headers: Vec::new(),
        body: Arc::new(Vec::new()),
    };
    respond(stream, &reply, method, false).await;
    connection::linger(stream).await;
}

/// Sends an answer; false when the browser is gone or too slow.
async fn respond(stream: &mut TcpStream, reply: &SiteReply, method: &str, goes_on: bool) -> bool {
    let reason = StatusCode::from_u16(reply.status)
        .ok()
        .and_then(|status| status.canonical_reason())
        .unwrap_or_default();
    let body = (*reply.body).as_ref();
    let connection = if goes_on { "keep-alive" } else { "close" };
    let mut head = format!(
        "HTTP/1.1 {} {reason}\r\nConnection: {connection}\r\n",
        reply.status
    );
    let has_no_body =
        [StatusCode::NO_CONTENT, StatusCode::NOT_MODIFIED].map(|status| status.as_u16());
    if !has_no_body.contains(&reply.status) {
        head.push_str(&format!("Content-Length: {}\r\n", body.len()));
    }
    for (name, value) in &reply.headers {
        head.push_str(&format!("{name}: {value}\r\n"));
    }
    head.push_str("\r\n");
    let sent = async {
        stream.write_all(head.as_bytes()).await?;
        if method != "HEAD" {
            stream.write_all(body).await?;
        }
        stream.flush().await
    };
    matches!(timeout(PAGE_TIMEOUT, sent).await, Ok(Ok(())))
}

/// A WebSocket connection, until it ends.
async fn open<S: Site>(
    mut stream: TcpStream,
    site: &S,
    head: &Head,
    received: Vec<u8>,
    signals: watch::Receiver<Signal>,
) {
    let Some(visitor) = site.open(&head.target) else {
        return refuse(&mut stream, StatusCode::NOT_FOUND, &head.method).await;
    };
    if let Err(status) = upgrade(&mut stream, head).await {
        return refuse(&mut stream, status, &head.method).await;
    }
    let config = WebSocketConfig::default()
        .read_buffer_size(READ_BUFFER)
        .max_message_size(Some(MAX_REQUEST))
        .max_frame_size(Some(MAX_REQUEST));
    let socket =
        WebSocketStream::from_partially_read(stream, received, Role::Server, Some(config)).await;
    let (sink, source) = socket.split();
    converse(sink, source, visitor, signals).await;
}

async fn converse(
    mut sink: SplitSink<WebSocketStream<TcpStream>, Message>,
    mut source: SplitStream<WebSocketStream<TcpStream>>,
    mut visitor: Box<dyn Visitor>,
    mut signals: watch::Receiver<Signal>,
) {
    loop {
        let ends = signals.borrow_and_update().ends;
        // A closed page is detected here at the latest.
        let Ok(Ok(())) = timeout(PAGE_TIMEOUT, send_all(&mut sink, visitor.messages())).await
        else {
            return;
        };
        if ends {
            let _ = timeout(HANDSHAKE_TIMEOUT, sink.close()).await;
            return;
        }
        tokio::select! {
            changed = signals.changed() => if changed.is_err() { return },
            message = source.next() => match message {
                Some(Ok(Message::Text(text))) => visitor.receive(text.as_bytes()),
                Some(Ok(Message::Binary(bytes))) => visitor.receive(&bytes),
                Some(Ok(Message::Close(_)) | Err(_)) | None => return,
                // Pings are answered by the library.
                Some(Ok(_)) => {}
            },
        }
    }
}

async fn send_all(
    sink: &mut SplitSink<WebSocketStream<TcpStream>, Message>,
    messages: Vec<SiteMessage>,
) -> Result<(), tokio_tungstenite::tungstenite::Error> {
    for message in messages {
        sink.feed(match message {
            SiteMessage::Text(text) => Message::Text(Utf8Bytes::from(text)),
            SiteMessage::Binary(bytes) => Message::Binary(bytes.into()),
        })
        .await?;
    }
    sink.flush().await
}

#[cfg(test)]
mod tests;
