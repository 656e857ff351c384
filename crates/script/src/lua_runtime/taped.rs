//! What `captured.lua` needs, which puts Lua's own libraries on the tape of the simulator.

use std::ffi::{CStr, c_int};

use super::debugging;
use crate::binding::data::{push_data, read_data};
use crate::lua::{Stack, push_callback};
use crate::tape::Taped;
use permissions::c_path;

/// Where Lua's own `io.tmpfile` is kept while permissions stand in front of it.
const TMPFILE: &CStr = c"swanilda.tmpfile";

/// Keeps what is needed of a fresh state, before permissions are put in front of its functions.
pub(super) fn prepare(stack: Stack<'_>) {
    stack.push_global("io");
    stack.raw_get_field(-1, "tmpfile");
    stack.set_registry(TMPFILE);
    stack.pop(1);
}

/// Pushes the native functions.
pub(super) fn push_functions(stack: Stack<'_>) {
    macro_rules! table {
        ($($name:literal: $function:ident),* $(,)?) => { $(
            push_callback(stack, $function, 0);
            stack.raw_set_field(-2, $name);
        )* };
    }
    stack.new_table(0, 10);
    table! {
        "replaying": replaying,
        "enter": enter,
        "leave": leave,
        "put": put,
        "take": take,
        "content": content,
        "code": code,
        "isRegular": is_regular,
        "lacks": lacks,
    }
    stack.push_registry(TMPFILE);
    stack.raw_set_field(-2, "tmpfile");
}

/// Whether the run is a replay.
fn replaying(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    stack.push_bool(stack.tape().is_replaying());
    Ok(1)
}

/// A call of the system begins: what is asked for until `leave` is part of it.
fn enter(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    stack.tape().begin_input();
    Ok(0)
}

fn leave(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    stack.tape().end_input();
    Ok(0)
}

/// Adds the values after the kind.
fn put(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let values = (2..=stack.top()).map(|index| read_data(stack, index).map(Taped));
    let values = values
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| error.to_string())?;
    stack.tape().add(&text(stack), &values);
    Ok(0)
}

/// The values that were added with that kind.
fn take(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let who = || stack.env().script_name();
    let values = stack.tape().input_for(&text(stack), who, Vec::<Taped>::new);
    let values = values.map_err(|lost| lost.to_string())?;
    stack.set_top(0);
    values.iter().for_each(|value| push_data(stack, &value.0));
    Ok(stack.top())
}

/// The bytes of a file that a script has opened.
fn content(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let path = stack.text(1).unwrap_or_default();
    let permissions = &stack.owner().permissions;
    let bytes = permissions.read_checked(&c_path(&path));
    // It was opened, so that hardly anything can be wrong; then the file is empty.
    stack.push_bytes(&bytes.unwrap_or_default());
    Ok(1)
}

/// The bytes of a file with code, or nil and why there are none, in the words of `loadfile`.
fn code(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let path = stack.text(1).unwrap_or_default();
    let permissions = &stack.owner().permissions;
    let path_of_c = c_path(&path);
    let read = match permissions.check_read(&path_of_c) {
        Err(denied) => Err(denied.to_string()),
        Ok(()) => permissions.read_checked(&path_of_c).map_err(|error| {
            let reason = error.to_string();
            let reason = reason.split(" (os error").next().unwrap_or_default();
            format!("cannot open {}: {reason}", String::from_utf8_lossy(&path))
        }),
    };
    match read {
        Ok(bytes) => {
            debugging::note_file(stack, &path, &bytes);
            stack.push_bytes(&bytes);
            Ok(1)
        }
        Err(reason) => {
            stack.push_nil();
            stack.push_bytes(reason.as_bytes());
            Ok(2)
        }
    }
}

/// Whether a name is that of a file whose bytes are all there.
fn is_regular(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let path = stack.text(1).unwrap_or_default();
    stack.push_bool(c_path(&path).is_file());
    Ok(1)
}

/// Notes what the capture lacks.
fn lacks(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    stack.tape().lacks(&text(stack));
    Ok(0)
}

/// The first argument.
fn text(stack: Stack<'_>) -> String {
    let text = stack.text(1).unwrap_or_default();
    String::from_utf8_lossy(&text).into_owned()
}
