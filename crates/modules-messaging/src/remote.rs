//! The native part of the remote APIs (`lua/library/remote`): messages of programs outside.

use std::cell::RefCell;
use std::net::TcpListener;
use std::rc::Rc;
use std::time::Duration;

use api_macro::api;

use super::{ApiFn, Cx, Module, Result, functions, sim_ws};
use io::{Incoming, ZmqServer};
use script::{Bytes, Outside, States, Text};

/// The module `remote.zmq`.
pub static ZMQ: Module = Module {
    inner: &[FUNCTIONS, TYPES, NAMES],
    outside: Outside::Only(&[
        "remote.zmq.receive",
        "remote.zmq.reply",
        "remote.zmq.closed",
        "remote.zmq.others",
    ]),
    ..Module::new("remote.zmq")
};
/// What the library of scripts in Python needs.
pub static PYTHON: Module = Module {
    inner: &[TYPES, NAMES],
    ..Module::new("swanilda.python")
};
/// The module `remote.ws`.
pub static WS: Module = Module {
    inner: &[sim_ws::REMOTE, NAMES],
    ..Module::new("remote.ws")
};
/// The module `remote.visualization`.
pub static VISUALIZATION: Module = Module {
    inner: &[sim_ws::STREAM],
    ..Module::new("remote.visualization")
};

const FUNCTIONS: &[ApiFn] = functions![receive, reply, closed, others];
/// Types of results.
const TYPES: &[ApiFn] = functions![returns];
/// Functions that every remote API needs.
const NAMES: &[ApiFn] = functions![members];

/// Where programs outside reach a simulator.
#[derive(Default)]
struct Listeners {
    zmq_server: RefCell<Option<Rc<ZmqServer>>>,
    web_socket_listener: RefCell<Option<TcpListener>>,
    visualization_listener: RefCell<Option<TcpListener>>,
}

/// Lets programs outside call functions by ZeroMQ.
pub fn set_zmq_server(states: &States, server: ZmqServer) {
    states
        .get::<Listeners>()
        .zmq_server
        .replace(Some(Rc::new(server)));
}

/// Where the WebSocket remote API is to listen.
pub fn set_web_socket_listener(states: &States, listener: TcpListener) {
    states
        .get::<Listeners>()
        .web_socket_listener
        .replace(Some(listener));
}

/// Where the visualization stream is to listen.
pub fn set_visualization_listener(states: &States, listener: TcpListener) {
    states
        .get::<Listeners>()
        .visualization_listener
        .replace(Some(listener));
}

fn zmq_server(cx: &Cx) -> Option<Rc<ZmqServer>> {
    cx.module_state::<Listeners>().zmq_server.borrow().clone()
}

/// The listener of the WebSocket remote API, if there is one.
pub(super) fn listener(cx: &Cx) -> Option<std::io::Result<TcpListener>> {
    cx.module_state::<Listeners>()
        .web_socket_listener
        .borrow()
        .as_ref()
        .map(TcpListener::try_clone)
}

/// The listener of the visualization stream, if there is one.
pub(super) fn visualization_listener(cx: &Cx) -> Option<std::io::Result<TcpListener>> {
    cx.module_state::<Listeners>()
        .visualization_listener
        .borrow()
        .as_ref()
        .map(TcpListener::try_clone)
}

/// Longest wait, seconds: the simulator must look after itself from time to time.
const MAX_WAIT: f64 = 1.0;

/// The next message, or news that a connection is gone.
///
/// @param timeout seconds to wait for one
/// @return peer, message nothing when none came; no message when the connection is gone
#[api("remote.zmq.receive")]
fn receive(cx: &mut Cx, timeout: f64) -> Result<Option<(i64, Option<Text>)>> {
    let timeout = Duration::from_secs_f64(timeout.clamp(0.0, MAX_WAIT));
    let server = zmq_server(cx);
    Ok(server
        .and_then(|server| server.receive(timeout))
        .map(|incoming| match incoming {
            Incoming::Request(peer, message) => (peer.cast_signed(), Some(Text(message))),
            Incoming::Gone(peer) => (peer.cast_signed(), None),
        }))
}

/// Answers a connection.
///
/// @param peer the connection
/// @param message the answer
#[api("remote.zmq.reply")]
fn reply(cx: &mut Cx, peer: i64, message: Bytes) -> Result<()> {
    if let Some(server) = zmq_server(cx) {
        server.reply(peer.cast_unsigned(), &message.0);
    }
    Ok(())
}

/// Whether the program is about to end, so that waits must end.
///
/// @return closed
#[api("remote.zmq.closed")]
fn closed(cx: &Cx) -> Result<bool> {
    Ok(zmq_server(cx).is_none_or(|server| server.is_closed()))
}

/// Whether something has come in by other sockets of the simulator, which are served when this function's caller returns.
///
/// @return waiting
#[api("remote.zmq.others")]
fn others(cx: &Cx) -> Result<bool> {
    Ok(zmq_server(cx).is_some_and(|server| server.others_wait()))
}

/// The types a function is declared to return.
///
/// @param name of the function, with its module
/// @return types nothing when the function declares none
#[api("remote.zmq.returns")]
fn returns(cx: &Cx, name: String) -> Result<Option<Vec<String>>> {
    let types = cx.env().registry.result_types(&name);
    Ok(types.map(|types| types.iter().map(|&ty| ty.to_owned()).collect()))
}

/// The names `sim` has, in alphabetical order; the table itself fills at first use.
///
/// @return names
#[api("remote.zmq.members")]
fn members(cx: &Cx) -> Result<Vec<String>> {
    Ok(cx
        .env()
        .registry
        .members_of_sim()
        .names()
        .into_iter()
        .map(str::to_owned)
        .collect())
}
