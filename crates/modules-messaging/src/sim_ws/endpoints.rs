//! WebSocket endpoints of scripts: who owns them, and the calls of their handlers once per loop iteration.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::{Rc, Weak};

use io::{HttpReply, IdCounter, SendError, WsEndpoint};
use scene::Data;
use script::{Cx, Handler, Host, Script};

use super::event::{Event, EventKind};
use super::log;

/// The endpoints of a simulator, in the order of their creation.
#[derive(Default)]
pub(super) struct WebSockets {
    /// The numbers of endpoints and connections.
    pub(super) numbers: IdCounter,
    endpoints: RefCell<BTreeMap<u64, Rc<Endpoint>>>,
}

impl WebSockets {
    pub(super) fn get(&self, number: u64) -> Option<Rc<Endpoint>> {
        self.endpoints.borrow().get(&number).cloned()
    }

    /// Closes an endpoint and all its connections at once.
    pub(super) fn stop(&self, number: u64) {
        let endpoint = self.endpoints.borrow_mut().remove(&number);
        // Nothing is borrowed while connections end and handlers are released.
        if let Some(endpoint) = endpoint {
            endpoint.stop();
        }
    }

    /// The endpoints in the order of their creation.
    fn all(&self) -> Vec<Rc<Endpoint>> {
        self.endpoints.borrow().values().cloned().collect()
    }
}

/// Role of an endpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Server,
    Client,
}

/// Kind of event that a handler receives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum HandlerKind {
    Open,
    Fail,
    Close,
    Message,
    Http,
}

/// An endpoint of a script.
pub(super) struct Endpoint {
    number: u64,
    pub(super) role: Role,
    /// Where handlers given by name are looked up.
    script: Rc<Script>,
    /// None once it is stopped, and in a replay.
    socket: RefCell<Option<WsEndpoint>>,
    handlers: RefCell<BTreeMap<HandlerKind, Rc<Handler>>>,
}

impl Endpoint {
    /// How scripts call it.
    pub(super) fn handle(&self) -> String {
        format!("{:x}:simWS.{:?}", self.number, self.role)
    }

    pub(super) fn set_handler(&self, kind: HandlerKind, handler: Handler) {
        self.handlers.borrow_mut().insert(kind, Rc::new(handler));
    }

    /// Where a server listens.
    pub(super) fn port(&self) -> Option<u16> {
        self.socket.borrow().as_ref()?.port()
    }

    /// # Errors
    /// The reason why the connection rejects it.
    pub(super) fn send(
        &self,
        connection: u64,
        data: Vec<u8>,
        opcode: i64,
    ) -> Result<(), SendError> {
        self.socket
            .borrow()
            .as_ref()
            .ok_or(SendError::Expired)?
            .send(connection, data, opcode)
    }

    /// Closes the connections and releases the handlers.
    pub(super) fn stop(&self) {
        drop(self.socket.take());
        drop(self.handlers.take());
    }

    fn arrived(&self) -> usize {
        self.socket.borrow().as_ref().map_or(0, WsEndpoint::arrived)
    }

    fn next(&self) -> Option<Event> {
        self.socket.borrow().as_ref()?.next().map(Event::from)
    }
}

/// How scripts call a connection.
pub(super) fn connection_handle(connection: u64) -> String {
    format!("{connection:x}:simWS.Connection")
}

/// The number in a handle of that kind.
pub(super) fn handle_number(handle: &str, kind: &str) -> Option<u64> {
    let digits = handle.strip_suffix(kind)?.strip_suffix(":simWS.")?;
    u64::from_str_radix(digits, 16)
        .ok()
        .filter(|number| format!("{number:x}") == digits)
}

/// The endpoints of a script: they are stopped when it ends.
#[derive(Default)]
struct Owned(RefCell<Vec<Ownership>>);

struct Ownership {
    sockets: Weak<WebSockets>,
    number: u64,
}

impl Drop for Ownership {
    fn drop(&mut self) {
        if let Some(sockets) = self.sockets.upgrade() {
            sockets.stop(self.number);
        }
    }
}

/// Adds an endpoint of the calling script; a replay has no sockets.
pub(super) fn add(cx: &mut Cx, role: Role, socket: Option<WsEndpoint>) -> Rc<Endpoint> {
    let sockets = cx.module_state::<WebSockets>();
    // Connections take numbers as well, whenever they come.
    let tape = cx.permissions().tape();
    let number = tape.input("a number of a WebSocket", || sockets.numbers.next());
    let number = number.unwrap_or_default();
    let script = cx.script().clone();
    let endpoint = Rc::new(Endpoint {
        number,
        role,
        script,
        socket: RefCell::new(socket),
        handlers: RefCell::default(),
    });
    sockets
        .endpoints
        .borrow_mut()
        .insert(number, endpoint.clone());
    let owned = cx.script_state::<Owned>();
    let mut owned = owned.0.borrow_mut();
    owned.retain(|other| sockets.get(other.number).is_some());
    owned.push(Ownership {
        sockets: Rc::downgrade(&sockets),
        number,
    });
    endpoint
}

/// Runs the sockets and calls the handlers for what arrived: endpoint by endpoint in the order of their creation, in the order of
/// arrival. What arrives in the meantime waits for the next iteration.
pub(super) fn start_of_iteration(host: &Host) {
    let endpoints = host
        .module_state::<WebSockets>()
        .map_or_else(Vec::new, |sockets| sockets.all());
    if endpoints.is_empty() {
        return;
    }
    let tape = host.options().permissions.tape();
    let arrived = tape.poll("arrivals of WebSockets", 0, || arrivals(host, &endpoints));
    let Some(arrived) = arrived else { return };
    for (endpoint, count) in endpoints.iter().zip(arrived) {
        let next = || tape.input("an event of a WebSocket", || endpoint.next());
        for event in (0..count).map_while(|_| next().ok().flatten()) {
            handle(host, endpoint, event);
        }
    }
    if !tape.is_replaying()
        && let Ok(event_loop) = host.event_loop()
    {
        // Answers leave in the same iteration.
        event_loop.turn();
    }
}

/// How many events of each endpoint have arrived, if any have.
fn arrivals(host: &Host, endpoints: &[Rc<Endpoint>]) -> Option<Vec<usize>> {
    host.event_loop().ok()?.turn();
    let counts = endpoints.iter().map(|endpoint| endpoint.arrived());
    let counts: Vec<usize> = counts.collect();
    counts.iter().any(|&count| count > 0).then_some(counts)
}

fn handle(host: &Host, endpoint: &Endpoint, event: Event) {
    log::log_event(host, endpoint, &event);
    let connection = event.connection;
    let call = |kind, more: &[Data]| {
        let handler = endpoint.handlers.borrow().get(&kind).cloned()?;
        let handles = [
            Data::text(&endpoint.handle()),
            Data::text(&connection_handle(connection)),
        ];
        let args = [&handles, more].concat();
        Some(host.call_handler(&endpoint.script, &handler, &args))
    };
    match event.kind {
        EventKind::Open => drop(call(HandlerKind::Open, &[])),
        EventKind::Fail(_) | EventKind::Unreachable(_) | EventKind::Refused(_) => {
            drop(call(HandlerKind::Fail, &[]));
        }
        EventKind::Close => drop(call(HandlerKind::Close, &[])),
        EventKind::Message(data) => drop(call(HandlerKind::Message, &[Data::Buffer(data)])),
        EventKind::Http {
            resource,
            body,
            answer,
        } => {
            let results = call(
                HandlerKind::Http,
                &[Data::text(&resource), Data::Buffer(body)],
            );
            let reply = results.map_or_else(|| HttpReply::status(404), http_reply);
            if let Some(answer) = answer {
                answer(reply);
            }
        }
    }
}

/// The answer a handler has given: status and data, both needed. What is none is the script's mistake.
fn http_reply(results: Option<Vec<Data>>) -> HttpReply {
    let answer = results.and_then(|results| {
        let mut results = results.into_iter();
        let status = match results.next()? {
            Data::Nil => 404,
            Data::Int(status) => u16::try_from(status)
                .ok()
                .filter(|status| (200..1000).contains(status))?,
            _ => return None,
        };
        match results.next()? {
            Data::Text(data) | Data::Buffer(data) => Some(HttpReply { status, data }),
            _ => None,
        }
    });
    answer.unwrap_or_else(|| HttpReply::status(500))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn handles() {
        assert_eq!(handle_number("1f:simWS.Server", "Server"), Some(31));
        for bad in [
            "",
            ":simWS.Server",
            "+1:simWS.Server",
            "01:simWS.Server",
            "1:simWS.Client",
            "1F:simWS.Server",
        ] {
            assert_eq!(handle_number(bad, "Server"), None, "{bad}");
        }
        assert_eq!(
            handle_number(&connection_handle(255), "Connection"),
            Some(255)
        );
    }

    #[test]
    fn answers_of_handlers() {
        let reply = |results: &[Data]| http_reply(Some(results.to_vec())).status;
        assert_eq!(reply(&[Data::Int(200), Data::text("1")]), 200);
        assert_eq!(reply(&[Data::Nil, Data::text("")]), 404);
        for bad in [
            vec![],
            vec![Data::Int(404)],
            vec![Data::Int(404), Data::Nil],
            vec![Data::text("200"), Data::text("")],
        ] {
            assert_eq!(reply(&bad), 500, "{bad:?}");
        }
        assert_eq!(
            (
                reply(&[Data::Int(99), Data::text("")]),
                http_reply(None).status
            ),
            (500, 500)
        );
    }
}
