//! The native part of `simZMQ`: contexts.

use std::rc::Rc;
use std::time::Duration;

use api_macro::api;

use super::objects::{forbid_singleton, no_socket, objects, singleton_handle};
use crate::{ApiFn, Cx, Result, functions};
use io::zmq::{Context, Socket};
use script::Number;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    ctx_new,
    ctx_singleton,
    ctx_get,
    ctx_set,
    ctx_shutdown,
    socket
];

/// Behind functions of the Lua part.
pub(crate) const INNER: &[ApiFn] = functions![ctx_term];

/// Longest wait for the end of a context, milliseconds.
const MAX_WAIT: i64 = 10_000;

/// Makes a context.
///
/// @return context
#[api("simZMQ.ctx_new")]
fn ctx_new(cx: &Cx) -> Result<String> {
    let objects = objects(cx);
    match Context::new() {
        Ok(context) => objects.add_context(cx, context),
        Err(errno) => {
            objects.failed(errno);
            Ok(String::new())
        }
    }
}

/// The context that all scripts share.
///
/// @return context
#[api("simZMQ.ctx_singleton")]
fn ctx_singleton(_cx: &Cx) -> Result<String> {
    Ok(singleton_handle())
}

/// An option of a context.
///
/// @param context the context
/// @param option_name one of simZMQ's constants
/// @return result the value, or -1
#[api("simZMQ.ctx_get", snake_case)]
fn ctx_get(cx: &Cx, context: String, option_name: Number) -> Result<i64> {
    let objects = objects(cx);
    let context = objects.context(cx, &context)?;
    Ok(objects.result_code(context.get(super::int(option_name))))
}

/// Sets an option of a context.
///
/// @param context the context
/// @param option_name one of simZMQ's constants
/// @param option_value its value
/// @return result 0 or -1
#[api("simZMQ.ctx_set", snake_case)]
fn ctx_set(cx: &Cx, context: String, option_name: Number, option_value: Number) -> Result<i64> {
    let objects = objects(cx);
    let context = objects.context(cx, &context)?;
    Ok(objects.done(context.set(super::int(option_name), super::int(option_value))))
}

/// Makes every further call on the sockets of a context fail with ETERM.
///
/// @param context the context
/// @return result 0 or -1
#[api("simZMQ.ctx_shutdown")]
fn ctx_shutdown(cx: &Cx, context: String) -> Result<i64> {
    forbid_singleton(&context, "shutdown")?;
    let objects = objects(cx);
    let context = objects.context(cx, &context)?;
    Ok(objects.done(objects.shut_down(&context)))
}

/// Ends a context.
///
/// @param context the context
/// @param timeout milliseconds to wait for messages on their way
/// @return result 0, or -1 with EINTR: it has not ended yet
#[api("simZMQ.ctx_term")]
fn ctx_term(cx: &Cx, context: String, timeout: Number) -> Result<i64> {
    forbid_singleton(&context, "terminated")?;
    let objects = objects(cx);
    let timeout = Duration::from_millis(timeout.0.clamp(0, MAX_WAIT).unsigned_abs());
    let outcome = objects.end_context(&context, |termination| termination.wait(timeout))?;
    Ok(objects.done(outcome))
}

/// Makes a socket.
///
/// @param context the context
/// @param type one of simZMQ's constants
/// @return socket
#[api("simZMQ.socket")]
fn socket(cx: &Cx, context: String, r#type: Number) -> Result<String> {
    let objects = objects(cx);
    let context: Rc<Context> = objects.context(cx, &context)?;
    match Socket::new(&context, super::int(r#type)) {
        Ok(socket) => Ok(objects.add_socket(cx, socket)),
        Err(errno) => {
            objects.failed(errno);
            Ok(no_socket())
        }
    }
}
