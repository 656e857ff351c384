//! One connection of a client, which may carry many requests.

use std::io::{BufReader, Result, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::mpsc::SyncSender;
use std::time::Duration;

use serde_json::Value;

use super::guard::{Guard, Refusal};
use super::request::{Received, Request, receive};
use super::{Ask, Job, ask};
use crate::message::{Fault, Message, code, parse};
use crate::running::Running;
use crate::session::VERSIONS;

/// A connection that says nothing for so long is closed.
const IDLE: Duration = Duration::from_secs(120);
/// Where messages are posted.
const PATH: &str = "/mcp";

pub(super) struct Connection {
    stream: TcpStream,
    guard: Arc<Guard>,
    jobs: SyncSender<Job>,
    running: Running,
}

/// What is written back.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Reply {
    status: u16,
    /// JSON, if there is something to say.
    body: Option<Value>,
    /// The id of a session that begins.
    session: Option<String>,
    /// Whether it is the end of a stream of events.
    is_event: bool,
}

impl Reply {
    /// An answer; without one the messages were accepted.
    pub(super) fn of(body: Option<Value>) -> Self {
        Self {
            status: if body.is_some() { 200 } else { 202 },
            body,
            ..Self::default()
        }
    }

    /// The answer that begins a session.
    pub(super) fn begins(session: &str, answer: Option<Value>) -> Self {
        Self {
            session: Some(session.to_owned()),
            ..Self::of(answer)
        }
    }

    /// The session is over.
    pub(super) fn ended() -> Self {
        Self {
            status: 204,
            ..Self::default()
        }
    }

    pub(super) fn failure() -> Self {
        Self::refused(500, "the system has no random numbers")
    }

    pub(super) fn unknown_session() -> Self {
        Self::refused(404, "there is no such session: initialize another one")
    }

    /// The answer to a client that has no session and begins none.
    pub(super) fn without_session(answer: Option<Value>) -> Self {
        Self {
            status: 400,
            ..Self::of(answer)
        }
    }

    fn refused(status: u16, text: &str) -> Self {
        let fault = Fault::new(code::INVALID_REQUEST, text);
        Self {
            status,
            body: Some(fault.answer()),
            ..Self::default()
        }
    }

    fn bytes(&self) -> Vec<u8> {
        if self.is_event {
            return self.body.as_ref().map(event).unwrap_or_default();
        }
        let body = self.body.as_ref().map(Value::to_string).unwrap_or_default();
        let mut head = format!("HTTP/1.1 {} {}\r\n", self.status, reason(self.status));
        if !body.is_empty() {
            head += "Content-Type: application/json\r\n";
        }
        if let Some(session) = &self.session {
            head += &format!("Mcp-Session-Id: {session}\r\n");
        }
        if self.status == 401 {
            head += "WWW-Authenticate: Bearer\r\n";
        }
        if self.status == 405 {
            head += "Allow: POST, DELETE\r\n";
        }
        format!("{head}Content-Length: {}\r\n\r\n{body}", body.len()).into_bytes()
    }
}

/// The head of a stream of events, which ends with the connection.
const EVENTS: &str = "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-cache\r\nConnection: close\r\n\r\n";

/// A message as an event; JSON has no line ends.
fn event(message: &Value) -> Vec<u8> {
    format!("event: message\ndata: {message}\n\n").into_bytes()
}

fn reason(status: u16) -> &'static str {
    match status {
        200 => "OK",
        202 => "Accepted",
        204 => "No Content",
        400 => "Bad Request",
        401 => "Unauthorized",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        406 => "Not Acceptable",
        411 => "Length Required",
        413 => "Content Too Large",
        431 => "Request Header Fields Too Large",
        _ => "Internal Server Error",
    }
}

impl Connection {
    pub(super) fn new(
        stream: TcpStream,
        guard: Arc<Guard>,
        jobs: SyncSender<Job>,
        running: Running,
    ) -> Self {
        Self {
            stream,
            guard,
            jobs,
            running,
        }
    }

    /// Answers requests until the client goes.
    pub(super) fn serve(&self) {
        // A client that is gone needs no answer.
        let _ = self.serve_all();
    }

    fn serve_all(&self) -> Result<()> {
        self.stream.set_read_timeout(Some(IDLE))?;
        self.stream.set_write_timeout(Some(IDLE))?;
        self.stream.set_nodelay(true)?;
        let mut input = BufReader::new(&self.stream);
        loop {
            let (reply, goes_on) = match receive(&mut input)? {
                Received::Closed => return Ok(()),
                Received::Bad(status) => (Reply::refused(status, reason(status)), false),
                Received::Request(request) => {
                    let Some(reply) = self.reply(&request) else {
                        return Ok(());
                    };
                    let goes_on = !reply.is_event && keeps(&request);
                    (reply, goes_on)
                }
            };
            (&self.stream).write_all(&reply.bytes())?;
            if !goes_on {
                return Ok(());
            }
        }
    }

    /// None when the server ends.
    fn reply(&self, request: &Request) -> Option<Reply> {
        if let Err(refusal) = self.guard.check(request) {
            return Some(match refusal {
                Refusal::Origin => {
                    Reply::refused(403, "only programs and pages of this machine are served")
                }
                Refusal::Secret => {
                    Reply::refused(401, "the secret is needed: Authorization: Bearer SECRET")
                }
            });
        }
        if request.path != PATH {
            return Some(Reply::refused(404, "messages are posted to /mcp"));
        }
        let known = |version| VERSIONS.contains(&version);
        if !request.header("mcp-protocol-version").is_none_or(known) {
            return Some(Reply::refused(
                400,
                &format!("the versions of the protocol are {}", VERSIONS.join(", ")),
            ));
        }
        let session = request.header("mcp-session-id").map(str::to_owned);
        match request.method.as_str() {
            "POST" => self.post(request, session),
            "DELETE" => ask(&self.jobs, session, Ask::End, |_| ()),
            _ => Some(Reply::refused(
                405,
                "messages are posted; there is no stream of events",
            )),
        }
    }

    fn post(&self, request: &Request, session: Option<String>) -> Option<Reply> {
        if !request.header("accept").is_none_or(takes_json) {
            return Some(Reply::refused(406, "answers are application/json"));
        }
        let messages = match parse(&request.body) {
            Ok(messages) => messages,
            Err(fault) => {
                return Some(Reply {
                    status: 400,
                    body: Some(fault.answer()),
                    ..Reply::default()
                });
            }
        };
        if let Some(id) = &session {
            self.running.handle_cancellations(id, &messages);
        } else if !begins(&messages) {
            return Some(Reply::refused(
                400,
                "the header Mcp-Session-Id is missing: the answer to initialize has it",
            ));
        }
        let may_stream = request.header("accept").is_some_and(takes_events);
        let mut is_event = false;
        let note = |note: &Value| {
            if may_stream {
                let head = if is_event { "" } else { EVENTS };
                is_event = true;
                // A client that is gone is noticed at the reply.
                let _ = (&self.stream).write_all(&[head.as_bytes(), &event(note)].concat());
            }
        };
        let reply = ask(&self.jobs, session, Ask::Messages(messages), note)?;
        Some(Reply { is_event, ..reply })
    }
}

/// Whether the client goes on with this connection.
fn keeps(request: &Request) -> bool {
    !request
        .header("connection")
        .is_some_and(|value| value.eq_ignore_ascii_case("close"))
}

fn takes_json(accept: &str) -> bool {
    ["application/json", "application/*", "*/*"]
        .iter()
        .any(|kind| accept.contains(kind))
}

fn takes_events(accept: &str) -> bool {
    accept.contains("text/event-stream")
}

fn begins(messages: &[std::result::Result<Message, Fault>]) -> bool {
    matches!(messages, [Ok(Message::Request { method, .. })] if method == "initialize")
}
