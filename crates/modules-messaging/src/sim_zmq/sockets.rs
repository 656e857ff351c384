//! The native part of `simZMQ`: sockets. Nothing here waits but `poll`.

use std::rc::Rc;

use api_macro::api;

use super::access::{check_endpoint, check_option};
use super::int;
use super::objects::objects;
use crate::{ApiError, ApiFn, Cx, Result, functions};
use io::zmq::{self, Errno, Message, Socket};
use scene::Data;
use scene::numbers;
use script::{Args, Bytes, FromScript, Number, Source, Table, Text};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    close,
    bind,
    unbind,
    connect,
    disconnect,
    setsockopt,
    getsockopt,
    socket_monitor,
    send,
    recv,
    poll,
];

/// Longest wait between checks for the end of the program, milliseconds.
const SLICE: i64 = 50;
/// The time left of a wait without a limit.
const FOREVER: i64 = -1;

/// Closes a socket.
///
/// @param socket the socket
/// @return result 0 or -1
#[api("simZMQ.close")]
fn close(cx: &Cx, socket: String) -> Result<i64> {
    objects(cx).take_socket(cx, &socket)?.close();
    Ok(0)
}

/// Accepts connections at an address.
///
/// @param socket the socket
/// @param endpoint such as tcp://127.0.0.1:5555
/// @return result 0 or -1
#[api("simZMQ.bind")]
fn bind(cx: &Cx, socket: String, endpoint: String) -> Result<i64> {
    let objects = objects(cx);
    check_endpoint(cx, &endpoint)?;
    Ok(objects.done(objects.socket(cx, &socket)?.bind(&endpoint)))
}

/// Accepts no more connections at an address.
///
/// @param socket the socket
/// @param endpoint the address
/// @return result 0 or -1
#[api("simZMQ.unbind")]
fn unbind(cx: &Cx, socket: String, endpoint: String) -> Result<i64> {
    let objects = objects(cx);
    Ok(objects.done(objects.socket(cx, &socket)?.unbind(&endpoint)))
}

/// Connects to an address, now or as soon as a peer binds it.
///
/// @param socket the socket
/// @param endpoint such as tcp://127.0.0.1:5555
/// @return result 0 or -1
#[api("simZMQ.connect")]
fn connect(cx: &Cx, socket: String, endpoint: String) -> Result<i64> {
    let objects = objects(cx);
    check_endpoint(cx, &endpoint)?;
    Ok(objects.done(objects.socket(cx, &socket)?.connect(&endpoint)))
}

/// Ends a connection.
///
/// @param socket the socket
/// @param endpoint the address
/// @return result 0 or -1
#[api("simZMQ.disconnect")]
fn disconnect(cx: &Cx, socket: String, endpoint: String) -> Result<i64> {
    let objects = objects(cx);
    Ok(objects.done(objects.socket(cx, &socket)?.disconnect(&endpoint)))
}

/// Sets an option of a socket.
///
/// @param socket the socket
/// @param option_name one of simZMQ's constants
/// @param option_value its bytes
/// @return result 0 or -1
#[api("simZMQ.setsockopt", snake_case)]
fn setsockopt(cx: &Cx, socket: String, option_name: Number, option_value: Bytes) -> Result<i64> {
    let objects = objects(cx);
    check_option(cx, int(option_name), &option_value.0)?;
    Ok(objects.done(
        objects
            .socket(cx, &socket)?
            .set(int(option_name), &option_value.0),
    ))
}

/// An option of a socket.
///
/// @param socket the socket
/// @param option_name one of simZMQ's constants
/// @param option_len most bytes
/// @return result 0 or -1
/// @return value its bytes
#[api("simZMQ.getsockopt", snake_case)]
fn getsockopt(
    cx: &Cx,
    socket: String,
    option_name: Number,
    option_len: Number,
) -> Result<(i64, Text)> {
    let objects = objects(cx);
    let room = usize::try_from(option_len.0).unwrap_or(0);
    Ok(
        match objects.socket(cx, &socket)?.get(int(option_name), room) {
            Ok(value) => (0, Text(value)),
            Err(errno) => (objects.failed(errno), Text(Vec::new())),
        },
    )
}

/// Reports connection events of a socket.
///
/// @param socket the socket
/// @param endpoint the inproc address that reports them
/// @param events which
/// @return result 0 or -1
#[api("simZMQ.socket_monitor")]
fn socket_monitor(cx: &Cx, socket: String, endpoint: String, events: Number) -> Result<i64> {
    let objects = objects(cx);
    Ok(objects.done(objects.socket(cx, &socket)?.monitor(&endpoint, int(events))))
}

/// Sends a part of a message, or all of it, without waiting.
///
/// @param socket the socket
/// @param data its bytes
/// @param flags simZMQ.SNDMORE when more parts follow
/// @return result bytes sent, or -1
#[api("simZMQ.send")]
fn send(cx: &Cx, socket: String, data: Bytes, flags: Number) -> Result<i64> {
    let objects = objects(cx);
    Ok(objects.result_code(objects.socket(cx, &socket)?.send(&data.0, int(flags))))
}

/// Receives a part of a message without waiting.
///
/// @param socket the socket
/// @param flags none has an effect
/// @param max_buf_size most bytes to return
/// @return result length of the message, or -1
/// @return data its bytes, nil on failure
#[api("simZMQ.recv", snake_case)]
fn recv(
    cx: &Cx,
    socket: String,
    flags: Number,
    max_buf_size: Option<Number>,
) -> Result<(i64, Data)> {
    let objects = objects(cx);
    let socket = objects.socket(cx, &socket)?;
    let mut message = Message::closed();
    message.open();
    Ok(match message.receive(&socket, int(flags)) {
        Ok(length) => {
            let most = max_buf_size.map_or(usize::MAX, |most| usize::try_from(most.0).unwrap_or(0));
            (
                length.into(),
                Data::Text(message.bytes()[..message.size().min(most)].to_vec()),
            )
        }
        Err(errno) => (objects.failed(errno), Data::Nil),
    })
}

/// Waits until a socket is ready; an error when the program is about to end.
///
/// @param sockets the sockets
/// @param events what each is waited for
/// @param timeout milliseconds, -1 without limit
/// @return result how many are ready, or -1
/// @return revents what each is ready for
#[api("simZMQ.poll")]
fn poll(
    cx: &Cx,
    sockets: Handles,
    events: Vec<i64>,
    #[default(Number(0))] timeout: Number,
) -> Result<(i64, Vec<i64>)> {
    let objects = objects(cx);
    let sockets = sockets
        .0
        .iter()
        .map(|handle| objects.socket(cx, handle))
        .collect::<Result<Vec<_>>>()?;
    let items: Vec<_> = sockets
        .into_iter()
        .zip(events.iter().map(|events| {
            let [low, high, ..] = events.to_le_bytes();
            i16::from_le_bytes([low, high])
        }))
        .collect();
    Ok(match wait(cx, &items, timeout.0)? {
        Ok(ready) => {
            let count = ready.iter().filter(|&&events| events != 0).count();
            (
                numbers::count(count),
                ready.into_iter().map(i64::from).collect(),
            )
        }
        Err(errno) => (objects.failed(errno), vec![0; items.len()]),
    })
}

/// A list of handles.
struct Handles(Vec<String>);

impl FromScript for Handles {
    const TYPE: &'static str = "string[]";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let Data::Array(items) = Table::from_script(args)?.0 else {
            return Err(ApiError::ArgumentType);
        };
        let text = |item| match item {
            Data::Text(bytes) => String::from_utf8(bytes).map_err(|_| ApiError::ArgumentType),
            _ => Err(ApiError::ArgumentType),
        };
        items.into_iter().map(text).collect::<Result<_>>().map(Self)
    }
}

/// Polls for a bounded time again and again.
fn wait(cx: &Cx, items: &[(Rc<Socket>, i16)], timeout: i64) -> Result<zmq::ZmqResult<Vec<i16>>> {
    let mut left = if items.is_empty() {
        timeout.max(0)
    } else {
        timeout
    };
    loop {
        let slice = if left < 0 { SLICE } else { left.min(SLICE) };
        let ready = match zmq::poll(items, slice as _) {
            // Interrupted by a signal: whether the simulator is to end is checked below.
            Err(Errno::INTERRUPTED) => vec![0; items.len()],
            Err(errno) => return Ok(Err(errno)),
            Ok(ready) => ready,
        };
        left = if left < 0 { FOREVER } else { left - slice };
        if left == 0 || ready.iter().any(|&events| events != 0) {
            return Ok(Ok(ready));
        }
        if cx.is_interrupted() {
            return Err(ApiError::Interrupted);
        }
    }
}
