//! The native part of `simZMQ`: messages.

use api_macro::api;
use scene::numbers;

use super::int;
use super::objects::objects;
use crate::{ApiFn, Cx, Result, functions};
use io::zmq::{Message, ZmqResult};
use script::{Number, Text};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    msg_new,
    msg_init,
    msg_init_size,
    msg_close,
    msg_destroy,
    msg_data,
    msg_size,
    msg_more,
    msg_get,
    msg_set,
    msg_gets,
    msg_copy,
    msg_move,
    msg_send,
    msg_recv,
];

/// Makes a message that must be initialised before it is used.
///
/// @return msg
#[api("simZMQ.msg_new")]
fn msg_new(cx: &Cx) -> Result<String> {
    Ok(objects(cx).add_message(cx))
}

/// Makes it an empty message.
///
/// @param msg the message
/// @return result 0
#[api("simZMQ.msg_init")]
fn msg_init(cx: &Cx, msg: String) -> Result<i64> {
    objects(cx).with_message(&msg, Message::open)?;
    Ok(0)
}

/// Makes it a message of zeros.
///
/// @param msg the message
/// @param size how many
/// @return result 0 or -1
#[api("simZMQ.msg_init_size")]
fn msg_init_size(cx: &Cx, msg: String, size: Number) -> Result<i64> {
    let objects = objects(cx);
    Ok(objects.done(objects.with_message(&msg, |message| message.open_with_size(size.0))?))
}

/// Releases the content; the handle stays.
///
/// @param msg the message
/// @return result 0 or -1
#[api("simZMQ.msg_close")]
fn msg_close(cx: &Cx, msg: String) -> Result<i64> {
    let objects = objects(cx);
    Ok(objects.done(objects.with_message(&msg, Message::close)?))
}

/// Destroys the message.
///
/// @param msg the message
#[api("simZMQ.msg_destroy")]
fn msg_destroy(cx: &Cx, msg: String) -> Result<()> {
    objects(cx).remove_message(&msg)
}

/// The content.
///
/// @param msg the message
/// @return data its bytes
#[api("simZMQ.msg_data")]
fn msg_data(cx: &Cx, msg: String) -> Result<Text> {
    objects(cx).with_message(&msg, |message| Text(message.bytes().to_vec()))
}

/// The length of the content.
///
/// @param msg the message
/// @return result bytes
#[api("simZMQ.msg_size")]
fn msg_size(cx: &Cx, msg: String) -> Result<i64> {
    objects(cx).with_message(&msg, |message| numbers::count(message.size()))
}

/// Whether more parts of the same message follow.
///
/// @param msg the message
/// @return result 1 or 0
#[api("simZMQ.msg_more")]
fn msg_more(cx: &Cx, msg: String) -> Result<i64> {
    objects(cx).with_message(&msg, |message| message.has_more().into())
}

/// A property.
///
/// @param msg the message
/// @param property one of simZMQ's constants
/// @return result the value, or -1
#[api("simZMQ.msg_get")]
fn msg_get(cx: &Cx, msg: String, property: Number) -> Result<i64> {
    let objects = objects(cx);
    Ok(objects.result_code(objects.with_message(&msg, |message| message.get(int(property)))?))
}

/// Sets a property.
///
/// @param msg the message
/// @param property one of simZMQ's constants
/// @param value its value
/// @return result 0 or -1
#[api("simZMQ.msg_set")]
fn msg_set(cx: &Cx, msg: String, property: Number, value: Number) -> Result<i64> {
    let objects = objects(cx);
    Ok(objects.done(objects.with_message(&msg, |message| message.set(int(property), int(value)))?))
}

/// Metadata of the sender.
///
/// @param msg the message
/// @param property its name
/// @return result 0 or -1
/// @return value empty on failure
#[api("simZMQ.msg_gets")]
fn msg_gets(cx: &Cx, msg: String, property: String) -> Result<(i64, Text)> {
    let objects = objects(cx);
    Ok(
        match objects.with_message(&msg, |message| message.property(&property))? {
            Ok(value) => (0, Text(value)),
            Err(errno) => (objects.failed(errno), Text(Vec::new())),
        },
    )
}

/// Copies the content of a message to another.
///
/// @param dest gets it
/// @param src keeps it
/// @return result 0 or -1
#[api("simZMQ.msg_copy")]
fn msg_copy(cx: &Cx, dest: String, src: String) -> Result<i64> {
    put(cx, &dest, &src, Message::copy)
}

/// Moves the content of a message to another; the source becomes empty.
///
/// @param dest gets it
/// @param src loses it
/// @return result 0 or -1
#[api("simZMQ.msg_move")]
fn msg_move(cx: &Cx, dest: String, src: String) -> Result<i64> {
    put(cx, &dest, &src, Message::take)
}

/// Puts what `content` makes of the source into the destination, which must be initialised.
fn put(
    cx: &Cx,
    dest: &str,
    src: &str,
    content: impl Fn(&mut Message) -> ZmqResult<Message>,
) -> Result<i64> {
    let objects = objects(cx);
    let outcome = match objects.with_message(dest, |message| message.require_open())? {
        Ok(()) => objects.with_message(src, content)?,
        Err(errno) => Err(errno),
    };
    Ok(match outcome {
        Ok(content) => {
            objects.done(objects.with_message(dest, |message| message.replace(content))?)
        }
        Err(errno) => objects.failed(errno),
    })
}

/// Hands the content to a socket without waiting.
///
/// @param msg the message, empty afterwards
/// @param socket the socket
/// @param flags simZMQ.SNDMORE when more parts follow
/// @return result bytes sent, or -1
#[api("simZMQ.msg_send")]
fn msg_send(cx: &Cx, msg: String, socket: String, flags: Number) -> Result<i64> {
    let objects = objects(cx);
    let socket = objects.socket(cx, &socket)?;
    Ok(objects
        .result_code(objects.with_message(&msg, |message| message.send(&socket, int(flags)))?))
}

/// Receives into a message without waiting.
///
/// @param msg the message
/// @param socket the socket
/// @param flags none has an effect
/// @return result its length, or -1
#[api("simZMQ.msg_recv")]
fn msg_recv(cx: &Cx, msg: String, socket: String, flags: Number) -> Result<i64> {
    let objects = objects(cx);
    let socket = objects.socket(cx, &socket)?;
    Ok(objects
        .result_code(objects.with_message(&msg, |message| message.receive(&socket, int(flags)))?))
}
