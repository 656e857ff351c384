//! Streamable HTTP as clients meet it: sessions, what is refused, calls that are cancelled, and clients that behave badly.

mod serving;

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use mcp::{Answer, HttpServer, Progress, Running, Secret};
use serde_json::{Value, json};
use serving::{Serving, call_with_progress, check_progress, say_twice};

const SECRET: &str = "0123456789abcdef";

/// A server that ends with the test.
struct Server {
    address: SocketAddr,
    is_over: Arc<AtomicBool>,
    has_begun: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Server {
    /// Its tool waits until it is stopped.
    fn start() -> Self {
        Self::with_tool(false)
    }

    /// Its tool waits, or says how far it is.
    fn with_tool(says: bool) -> Self {
        let secret = Secret::given(SECRET).expect("it is long enough");
        let server = HttpServer::bind(0, secret).expect("a port");
        let address = server.address().expect("an address");
        let (is_over, has_begun) = (Arc::<AtomicBool>::default(), Arc::<AtomicBool>::default());
        let (over, begun) = (Arc::clone(&is_over), Arc::clone(&has_begun));
        let thread = std::thread::spawn(move || {
            let stop = Arc::<AtomicBool>::default();
            let flag = Arc::clone(&stop);
            let wait = move |progress: &Progress| {
                if says {
                    return say_twice(progress);
                }
                begun.store(true, Ordering::Relaxed);
                while !flag.load(Ordering::Relaxed) {
                    std::thread::yield_now();
                }
                Answer::text("stopped")
            };
            let mut service = Serving::new("wait", wait);
            let ended = server.serve(&mut service, &Running::new(stop), || {
                over.load(Ordering::Relaxed)
            });
            ended.expect("it serves");
        });
        Self {
            address,
            is_over,
            has_begun,
            thread: Some(thread),
        }
    }

    fn connect(&self) -> Client {
        let stream = TcpStream::connect(self.address).expect("it listens");
        Client {
            input: BufReader::new(stream.try_clone().expect("a handle")),
            stream,
            session: String::new(),
        }
    }

    /// A client whose session has begun.
    fn client(&self) -> Client {
        let mut client = self.connect();
        let hello = json!({"jsonrpc": "2.0", "id": 0, "method": "initialize", "params": {"protocolVersion": "2025-06-18"}});
        let reply = client.post(&hello);
        assert_eq!(reply.status, 200);
        client.session = format!("Mcp-Session-Id: {}\r\n", reply.session);
        client
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        let ended = self.thread.take().map(JoinHandle::join);
        assert!(ended.is_some_and(|ended| ended.is_ok()) || std::thread::panicking());
    }
}

struct Client {
    stream: TcpStream,
    input: BufReader<TcpStream>,
    session: String,
}

struct Reply {
    status: u16,
    session: String,
    body: Value,
}

impl Client {
    fn post(&mut self, message: &Value) -> Reply {
        self.send_post(message);
        self.receive()
    }

    fn send_post(&mut self, message: &Value) {
        let (body, session) = (message.to_string(), &self.session);
        let head = format!(
            "POST /mcp HTTP/1.1\r\nAuthorization: Bearer {SECRET}\r\n{session}Content-Length: {}\r\n\r\n",
            body.len()
        );
        self.send(&(head + &body));
    }

    fn send(&mut self, text: &str) {
        self.stream
            .write_all(text.as_bytes())
            .expect("the server reads");
    }

    fn receive(&mut self) -> Reply {
        let (mut status, mut session, mut length) = (0, String::new(), 0);
        loop {
            let mut line = String::new();
            self.input.read_line(&mut line).expect("the server writes");
            let line = line.trim_end();
            if let Some(rest) = line.strip_prefix("HTTP/1.1 ") {
                status = rest[..3].parse().expect("a status");
            } else if let Some(id) = line.strip_prefix("Mcp-Session-Id: ") {
                session = id.to_owned();
            } else if let Some(text) = line.strip_prefix("Content-Length: ") {
                length = text.parse().expect("a length");
            } else if line.is_empty() {
                break;
            }
        }
        let mut body = vec![0; length];
        self.input.read_exact(&mut body).expect("the body");
        let body = serde_json::from_slice(&body).unwrap_or_default();
        Reply {
            status,
            session,
            body,
        }
    }
}

fn request(id: u64, method: &str) -> Value {
    json!({"jsonrpc": "2.0", "id": id, "method": method, "params": {"name": "wait"}})
}

#[test]
fn sessions_begin_are_apart_and_end() {
    let server = Server::start();
    let (mut first, mut second) = (server.client(), server.client());
    assert_ne!(first.session, second.session);
    assert_eq!(
        first.post(&request(1, "tools/list")).body["result"]["tools"][0]["name"],
        "wait"
    );
    let note = json!({"jsonrpc": "2.0", "method": "notifications/initialized"});
    assert_eq!(first.post(&note).status, 202);
    let end = format!(
        "DELETE /mcp HTTP/1.1\r\nAuthorization: Bearer {SECRET}\r\n{}\r\n",
        first.session
    );
    first.send(&end);
    assert_eq!(first.receive().status, 204);
    assert_eq!(first.post(&request(2, "tools/list")).status, 404);
    assert_eq!(second.post(&request(1, "ping")).status, 200);
    second.session.clear();
    assert_eq!(second.post(&request(1, "tools/list")).status, 400);
}

#[test]
fn old_sessions_end_when_there_are_too_many() {
    let server = Server::start();
    let mut first = server.client();
    assert_eq!(first.post(&request(1, "ping")).status, 200);
    for _ in 0..64 {
        server.client();
    }
    assert_eq!(first.post(&request(2, "ping")).status, 404);
}

#[test]
fn a_call_is_cancelled_by_its_own_session_only() {
    let server = Server::start();
    let (mut client, mut other) = (server.client(), server.client());
    client.send_post(&request(7, "tools/call"));
    while !server.has_begun.load(Ordering::Relaxed) {
        std::thread::yield_now();
    }
    let cancel =
        json!({"jsonrpc": "2.0", "method": "notifications/cancelled", "params": {"requestId": 7}});
    other.send_post(&cancel);
    let mut canceller = server.connect();
    canceller.session.clone_from(&client.session);
    canceller.send_post(&cancel);
    // Somebody may still wait at the other end of this connection, so there is an answer.
    assert_eq!(
        client.receive().body["result"]["content"][0]["text"],
        "stopped"
    );
    assert_eq!(other.receive().status, 202);
    assert_eq!(canceller.receive().status, 202);
    assert_eq!(client.post(&request(8, "ping")).status, 200);
}

#[test]
fn a_call_says_how_far_it_is_in_a_stream_of_events() {
    let server = Server::with_tool(true);
    let mut client = server.client();
    let call = call_with_progress(7, "wait");
    let quiet = client.post(&call);
    assert_eq!(quiet.body["id"], 7, "without events there is one answer");
    client.session += "Accept: application/json, text/event-stream\r\n";
    client.send_post(&call);
    let mut stream = String::new();
    client
        .input
        .read_to_string(&mut stream)
        .expect("the stream ends with the connection");
    assert!(stream.contains("\r\nContent-Type: text/event-stream\r\n"));
    let events = stream
        .lines()
        .filter_map(|line| line.strip_prefix("data: "));
    let events: Vec<Value> = events
        .map(|event| serde_json::from_str(event).expect("JSON"))
        .collect();
    check_progress(&events, 7);
}

#[test]
fn bad_clients_hurt_nobody_else() {
    let server = Server::start();
    let mut good = server.client();
    for text in [
        "",
        "\r\n\r\n",
        "GET",
        "POST /mcp HTTP/1.1\r\nContent-Length: 5\r\n\r\nab",
        "\0\0\0\0\r\n\r\n",
    ] {
        let mut bad = server.connect();
        bad.send(text);
    }
    let mut silent: Vec<Client> = (0..30).map(|_| server.connect()).collect();
    assert_eq!(good.post(&request(1, "ping")).status, 200);
    let half = "POST /mcp HTTP/1.1\r\n";
    silent.iter_mut().for_each(|client| client.send(half));
    assert_eq!(good.post(&request(2, "ping")).status, 200);
    let mut wrong = server.connect();
    wrong.send("POST /mcp HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n");
    assert_eq!(wrong.receive().status, 413);
}
