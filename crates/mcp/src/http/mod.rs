//! Streamable HTTP on the loopback: one address, `/mcp`, to which clients post messages.
//!
//! Each request is answered by one JSON text, or by a stream of events if a call says how far it is. There are no other streams: the server
//! has nothing to say without being asked, which the protocol allows. A secret as bearer token keeps other users and web pages out; pages of other origins are refused even with it.

mod connection;
mod guard;
mod request;

use std::collections::VecDeque;
use std::io::Result;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::rc::Rc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, SyncSender, channel, sync_channel};
use std::sync::{Arc, mpsc::Receiver};
use std::time::Duration;

use super::message::{Fault, Message};
use super::progress::Notify;
use super::running::Running;
use super::service::Service;
use super::session::Session;
use connection::{Connection, Reply};
pub use guard::Secret;
use serde_json::Value;

/// Connections at a time; more are closed at once.
const MAX_CONNECTIONS: usize = 64;
/// Sessions at a time; the oldest one ends for another.
const MAX_SESSIONS: usize = 64;
/// How often the end of the program is looked for.
const POLL_INTERVAL: Duration = Duration::from_millis(100);

/// A server that listens.
pub struct HttpServer {
    listener: TcpListener,
    guard: Arc<guard::Guard>,
}

/// Messages for the thread of the service.
struct Job {
    session: Option<String>,
    ask: Ask,
    answer: Sender<Part>,
}

/// What a connection gets for its messages: any number of notes, then a reply.
enum Part {
    Note(Value),
    Reply(Reply),
}

enum Ask {
    Messages(Vec<std::result::Result<Message, Fault>>),
    /// The session is over.
    End,
}

impl HttpServer {
    /// Listens on 127.0.0.1; at any port if that is 0.
    ///
    /// # Errors
    /// When the port is not free.
    pub fn bind(port: u16, secret: Secret) -> Result<Self> {
        Ok(Self {
            listener: TcpListener::bind((Ipv4Addr::LOCALHOST, port))?,
            guard: Arc::new(guard::Guard::new(secret)),
        })
    }

    /// Where it listens.
    ///
    /// # Errors
    /// When the system does not say.
    pub fn address(&self) -> Result<SocketAddr> {
        self.listener.local_addr()
    }

    /// Serves until `is_over`.
    ///
    /// # Errors
    /// When there are no threads.
    pub fn serve(
        self,
        service: &mut dyn Service,
        running: &Running,
        is_over: impl Fn() -> bool,
    ) -> Result<()> {
        let (jobs, incoming) = sync_channel(MAX_CONNECTIONS);
        let reading = running.clone();
        std::thread::Builder::new()
            .name("connections".into())
            .spawn(move || self.accept(&jobs, &reading))?;
        Sessions::default().run(service, running, &incoming, is_over);
        Ok(())
    }

    fn accept(self, jobs: &SyncSender<Job>, running: &Running) {
        let open = Arc::new(AtomicUsize::new(0));
        for stream in self.listener.incoming().flatten() {
            if open.fetch_add(1, Ordering::Relaxed) >= MAX_CONNECTIONS {
                open.fetch_sub(1, Ordering::Relaxed);
                continue;
            }
            let (count, guard) = (Arc::clone(&open), Arc::clone(&self.guard));
            let connection = Connection::new(stream, guard, jobs.clone(), running.clone());
            let served = std::thread::Builder::new().spawn(move || {
                connection.serve();
                count.fetch_sub(1, Ordering::Relaxed);
            });
            if served.is_err() {
                open.fetch_sub(1, Ordering::Relaxed);
            }
        }
    }
}

/// The sessions by their ids, the oldest first.
#[derive(Default)]
struct Sessions(VecDeque<(String, Session)>);

impl Sessions {
    fn run(
        &mut self,
        service: &mut dyn Service,
        running: &Running,
        jobs: &Receiver<Job>,
        is_over: impl Fn() -> bool,
    ) {
        while !is_over() {
            if let Ok(job) = jobs.recv_timeout(POLL_INTERVAL) {
                let notes = job.answer.clone();
                // The client may be gone.
                let notify: Notify = Rc::new(move |note| drop(notes.send(Part::Note(note))));
                let reply = self.reply(service, running, job.session, job.ask, &notify);
                let _ = job.answer.send(Part::Reply(reply));
            }
        }
    }

    fn reply(
        &mut self,
        service: &mut dyn Service,
        running: &Running,
        session: Option<String>,
        ask: Ask,
        notify: &Notify,
    ) -> Reply {
        let messages = match ask {
            Ask::Messages(messages) => messages,
            Ask::End => return self.end(session.as_deref()),
        };
        let Some(id) = session else {
            return self.begin(service, messages, notify);
        };
        let Some((_, session)) = self.0.iter_mut().find(|(other, _)| *other == id) else {
            return Reply::unknown_session();
        };
        let is_wanted = running.begin(&id, &messages);
        let answer = is_wanted
            .then(|| session.answer(service, Ok(messages), notify))
            .flatten();
        running.end();
        Reply::of(answer)
    }

    /// The first request of a client.
    fn begin(
        &mut self,
        service: &mut dyn Service,
        messages: Vec<std::result::Result<Message, Fault>>,
        notify: &Notify,
    ) -> Reply {
        let mut session = Session::default();
        let answer = session.answer(service, Ok(messages), notify);
        if session.version().is_none() {
            return Reply::without_session(answer);
        }
        let Ok(id) = Secret::random() else {
            return Reply::failure();
        };
        if self.0.len() >= MAX_SESSIONS {
            self.0.pop_front();
        }
        self.0.push_back((id.text().to_owned(), session));
        Reply::begins(id.text(), answer)
    }

    fn end(&mut self, id: Option<&str>) -> Reply {
        let count = self.0.len();
        self.0.retain(|(other, _)| Some(other.as_str()) != id);
        if self.0.len() == count {
            Reply::unknown_session()
        } else {
            Reply::ended()
        }
    }
}

/// Asks the thread of the service, and waits for the reply; None when there is none any more.
fn ask(
    jobs: &SyncSender<Job>,
    session: Option<String>,
    ask: Ask,
    mut note: impl FnMut(&Value),
) -> Option<Reply> {
    let (answer, parts) = channel();
    let job = Job {
        session,
        ask,
        answer,
    };
    jobs.send(job).ok()?;
    loop {
        match parts.recv().ok()? {
            Part::Note(value) => note(&value),
            Part::Reply(reply) => return Some(reply),
        }
    }
}
