//! A page without a browser: HTTP requests by hand, and the stream.

use std::collections::VecDeque;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::Duration;

use futures::{SinkExt, StreamExt};
use serde_json::Value;
use tokio::runtime::Runtime;
use tokio::time::timeout;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::http::HeaderValue;
use tokio_tungstenite::tungstenite::http::header::HeaderName;
use tokio_tungstenite::{WebSocketStream, client_async};

use super::served::Served;

/// Longest wait for a message.
const TIMEOUT: Duration = Duration::from_secs(60);

pub struct Reply {
    pub status: u16,
    pub head: String,
    pub body: Vec<u8>,
}

/// Gets what is at an address below the secret.
pub fn get(served: &Served, path: &str, headers: &[(&str, &str)]) -> Reply {
    let mut request = format!(
        "GET /{}/{path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n",
        served.token, served.port
    );
    headers
        .iter()
        .for_each(|(name, value)| request.push_str(&format!("{name}: {value}\r\n")));
    request_at(served.port, &(request + "\r\n"))
}

/// The answer to a whole request, after which the connection ends.
pub fn request_at(port: u16, request: &str) -> Reply {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("the server is there");
    stream.write_all(request.as_bytes()).expect("it listens");
    let mut reply = Vec::new();
    stream.read_to_end(&mut reply).expect("it answers");
    let end = reply
        .windows(4)
        .position(|four| four == b"\r\n\r\n")
        .expect("a head");
    let head = String::from_utf8(reply[..end].to_vec()).expect("it is text");
    Reply {
        status: status(&head),
        head,
        body: reply[end + 4..].to_vec(),
    }
}

/// A connection that has sent some bytes.
pub fn send(port: u16, bytes: &str) -> TcpStream {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("the server is there");
    stream.write_all(bytes.as_bytes()).expect("it listens");
    stream
}

/// The status of the answer to bytes that end like a request.
pub fn raw(port: u16, request: &str) -> u16 {
    let mut stream = send(port, request);
    stream
        .set_read_timeout(Some(TIMEOUT))
        .expect("a time limit");
    let mut head = [0; 12];
    stream.read_exact(&mut head).expect("it answers in time");
    status(std::str::from_utf8(&head).expect("it is text"))
}

fn status(head: &str) -> u16 {
    head[9..12].parse().expect("a status")
}

/// An open stream.
pub struct Page {
    runtime: Runtime,
    socket: WebSocketStream<tokio::net::TcpStream>,
    asked: u64,
    /// Messages that came while another one was waited for.
    texts: VecDeque<Value>,
    poses: Vec<Vec<(i64, [f32; 7])>>,
}

impl Page {
    pub fn open(served: &Served) -> Self {
        Self::try_open(served, "stream", &[]).expect("the stream opens")
    }

    pub fn try_open(served: &Served, path: &str, headers: &[(&str, &str)]) -> Result<Self, String> {
        Self::connect(served.port, &format!("{}/{path}", served.token), headers)
    }

    /// The same at any port.
    pub fn open_at(port: u16, path: &str) -> Self {
        Self::connect(port, path, &[]).expect("the stream opens")
    }

    fn connect(port: u16, path: &str, headers: &[(&str, &str)]) -> Result<Self, String> {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()
            .expect("a runtime");
        let mut request = format!("ws://127.0.0.1:{port}/{path}")
            .into_client_request()
            .expect("a request");
        for (name, value) in headers {
            let name: HeaderName = name.parse().expect("a name");
            request
                .headers_mut()
                .insert(name, HeaderValue::from_str(value).expect("a value"));
        }
        let socket = runtime.block_on(async {
            let stream = tokio::net::TcpStream::connect(("127.0.0.1", port))
                .await
                .map_err(|error| error.to_string())?;
            client_async(request, stream)
                .await
                .map_err(|error| error.to_string())
        })?;
        Ok(Self {
            runtime,
            socket: socket.0,
            asked: 0,
            texts: VecDeque::new(),
            poses: Vec::new(),
        })
    }

    /// The next message; None at the end.
    fn next(&mut self) -> Option<Message> {
        let next = async {
            timeout(TIMEOUT, self.socket.next())
                .await
                .expect("a message comes in time")
        };
        self.runtime
            .block_on(next)
            .and_then(Result::ok)
            .filter(|message| !message.is_close())
    }

    /// The next text; poses before it are kept.
    pub fn text(&mut self) -> Value {
        match self.texts.pop_front() {
            Some(text) => text,
            None => self.new_text(),
        }
    }

    fn new_text(&mut self) -> Value {
        loop {
            match self.next().expect("the stream goes on") {
                Message::Text(text) => return serde_json::from_str(&text).expect("it is JSON"),
                Message::Binary(bytes) => self.poses.push(read_poses(&bytes)),
                _ => {}
            }
        }
    }

    /// The next binary message.
    pub fn binary(&mut self) -> Vec<u8> {
        loop {
            if let Message::Binary(bytes) = self.next().expect("the stream goes on") {
                return bytes.to_vec();
            }
        }
    }

    /// The next poses.
    pub fn poses(&mut self) -> Vec<(i64, [f32; 7])> {
        while self.poses.is_empty() {
            if let Message::Binary(bytes) = self.next().expect("the stream goes on") {
                self.poses.push(read_poses(&bytes));
            }
        }
        self.poses.remove(0)
    }

    /// The next pose of that object.
    pub fn pose_of(&mut self, handle: i64) -> [f32; 7] {
        loop {
            if let Some((_, pose)) = self.poses().into_iter().find(|(moved, _)| *moved == handle) {
                return pose;
            }
        }
    }

    /// The first text for which that holds.
    pub fn wait_for(&mut self, holds: impl Fn(&Value) -> bool) -> Value {
        let begun = std::time::Instant::now();
        while begun.elapsed() < TIMEOUT {
            let text = self.text();
            if holds(&text) {
                return text;
            }
        }
        panic!("no such message in time");
    }

    /// The answer to a request; texts before it are kept.
    pub fn ask(&mut self, mut request: Value) -> Result<Value, String> {
        self.asked += 1;
        let id = self.asked;
        request["id"] = id.into();
        self.send_bytes(request.to_string().as_bytes());
        let begun = std::time::Instant::now();
        let mut reply = loop {
            assert!(begun.elapsed() < TIMEOUT, "no answer in time");
            let text = self.new_text();
            if text["type"] == "reply" && text["id"] == id {
                break text;
            }
            self.texts.push_back(text);
        };
        match reply["error"].as_str() {
            Some(error) => Err(error.to_owned()),
            None => Ok(reply["result"].take()),
        }
    }

    pub fn send_bytes(&mut self, bytes: &[u8]) {
        let message = match std::str::from_utf8(bytes) {
            Ok(text) => Message::text(text),
            Err(_) => Message::binary(bytes.to_vec()),
        };
        // A connection that is being closed may refuse it.
        let _ = self.runtime.block_on(self.socket.send(message));
    }

    /// Whether the stream ends, after what is still on its way.
    pub fn ends(&mut self) -> bool {
        while self.next().is_some() {}
        true
    }
}

fn read_poses(bytes: &[u8]) -> Vec<(i64, [f32; 7])> {
    assert_eq!(bytes[..4], [1, 0, 0, 0], "these tests ask for poses only");
    let number = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().expect("four bytes"));
    let row = |row: &[u8]| {
        let handle = i32::from_le_bytes(row[..4].try_into().expect("four bytes"));
        let mut pose = [0.0; 7];
        pose.iter_mut()
            .zip(row[4..].chunks_exact(4))
            .for_each(|(part, bytes)| *part = number(bytes));
        (i64::from(handle), pose)
    };
    bytes[16..].chunks_exact(32).map(row).collect()
}
