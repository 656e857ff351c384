//! Functions of Lua's libraries that call the operating system, with the simulator's permissions in front of them.
//!
//! They look at the arguments and continue in Lua's function, or refuse: functions that return failures return nil, the reason and a
//! number, others raise. Nothing is installed where everything is allowed.

mod files;
mod loading;

use std::ffi::c_int;
use std::path::PathBuf;

use super::calls::guard::Next;
use super::{Stack, Type};
use permissions::{Denied, Permissions, c_path};

/// Puts the guards into a fresh state, before any Lua code could keep Lua's functions. `restricted.lua` does what builds on them.
pub(crate) fn restrict_libraries(stack: Stack<'_>) {
    files::install(stack);
    loading::install(stack);
}

/// Only finds files by permissions, and so by the tape of the simulator.
pub(crate) fn search_by_permissions(stack: Stack<'_>) {
    loading::install_search(stack);
}

fn permissions(stack: Stack<'_>) -> &Permissions {
    &stack.owner().permissions
}

/// Continues where it is allowed; else returns nil, the reason and the system's number for it.
fn unless_denied(stack: Stack<'_>, checked: Result<(), Denied>) -> Next {
    let Err(denied) = checked else {
        return Next::Original;
    };
    stack.push_nil();
    stack.push_bytes(denied.to_string().as_bytes());
    stack.push_int(Denied::ERRNO.into());
    Next::Return(3)
}

/// Continues where it is allowed, else raises an error of the caller's line.
fn or_raise(stack: Stack<'_>, checked: Result<(), Denied>) -> Next {
    let Err(denied) = checked else {
        return Next::Original;
    };
    stack.push_bytes(format!("{}{denied}", stack.place_of_call()).as_bytes());
    Next::Raise
}

/// A text argument as C reads it: up to a NUL. None for what is neither string nor number.
fn c_text(stack: Stack<'_>, index: c_int) -> Option<Vec<u8>> {
    if !matches!(stack.kind(index), Type::String | Type::Number) {
        return None;
    }
    let mut text = stack.text(index)?;
    let end = text
        .iter()
        .position(|&byte| byte == 0)
        .unwrap_or(text.len());
    text.truncate(end);
    Some(text)
}

/// The same as the name of a file.
fn path(stack: Stack<'_>, index: c_int) -> Option<PathBuf> {
    c_text(stack, index).map(|name| c_path(&name))
}
