//! Functions of ours in front of functions of Lua's own libraries.
//!
//! They run in the frame of the call and continue in Lua's function, so that levels, arguments and messages are those scripts know. Where
//! Lua's function is, is nothing a script can change.

use std::ffi::{CStr, c_int};
use std::sync::OnceLock;

use super::entry::{Exit, Original, push_function};
use crate::lua::Stack;

/// Functions of Lua's with a guard.
pub(in crate::lua) mod guarded {
    pub const COROUTINE_CREATE: usize = 0;
    pub const COROUTINE_WRAP: usize = 1;
    pub const GET_LOCAL: usize = 2;
    pub const SET_LOCAL: usize = 3;
    pub const GET_METATABLE: usize = 4;
    pub const SET_METATABLE: usize = 5;
    pub const GET_UPVALUE: usize = 6;
    pub const SET_UPVALUE: usize = 7;
    pub const LOAD: usize = 8;
    pub const LOAD_FILE: usize = 9;
    pub const LOAD_LIBRARY: usize = 10;
    pub const IO_OPEN: usize = 11;
    pub const IO_LINES: usize = 12;
    pub const IO_INPUT: usize = 13;
    pub const IO_OUTPUT: usize = 14;
    pub const IO_POPEN: usize = 15;
    pub const IO_TMPFILE: usize = 16;
    pub const OS_EXECUTE: usize = 17;
    pub const OS_GETENV: usize = 18;
    pub const OS_REMOVE: usize = 19;
    pub const OS_RENAME: usize = 20;
    pub const OS_TMPNAME: usize = 21;
    pub const IO_WRITE: usize = 22;
    pub const FILE_WRITE: usize = 23;
    pub const SET_HOOK: usize = 24;
    pub const GET_HOOK: usize = 25;
    pub const FIND: usize = 26;
    pub const GMATCH: usize = 27;
    pub const GSUB: usize = 28;
    pub const MATCH: usize = 29;
    pub const REP: usize = 30;
    pub const LOWER: usize = 31;
    pub const UPPER: usize = 32;
    pub const REVERSE: usize = 33;
    pub const LEN: usize = 34;
    pub const SUB: usize = 35;
    pub const BYTE: usize = 36;
    pub const UNPACK: usize = 37;
    pub const TO_NUMBER: usize = 38;
    pub const COROUTINE_RESUME: usize = 39;
    pub const PCALL: usize = 40;
    pub const COUNT: usize = 41;
}

/// The action after a guard.
pub(in crate::lua) enum Next {
    /// Lua's function continues.
    Original,
    /// The same, then the function sees its results.
    OriginalThen(fn(Stack<'_>)),
    /// This number of values on top are the results.
    Return(c_int),
    /// Argument 1 is bad for this reason.
    Refuse(&'static CStr),
    /// The value on top is raised.
    Raise,
}

/// A function that looks at the arguments of a call before Lua's function does; not a closure with values.
pub(in crate::lua) trait Guard: Fn(Stack<'_>) -> Next + Copy + 'static {}

impl<F: Fn(Stack<'_>) -> Next + Copy + 'static> Guard for F {}

/// Lua's functions, the same ones in every state of the process.
static ORIGINALS: [OnceLock<Original>; guarded::COUNT] = [const { OnceLock::new() }; _];

/// Puts a guard in front of the function `name` of the table on top.
pub(in crate::lua) fn install<const FUNCTION: usize, F: Guard>(
    stack: Stack<'_>,
    name: &str,
    guard: F,
) {
    install_with::<FUNCTION, F>(stack, name, name, guard);
}

/// The same where another function of the table continues, with what the guard has made of the arguments.
pub(in crate::lua) fn install_with<const FUNCTION: usize, F: Guard>(
    stack: Stack<'_>,
    name: &str,
    original: &str,
    guard: F,
) {
    stack.raw_get_field(-1, original);
    let original = Original::at(stack, -1);
    stack.pop(1);
    if let Some(original) = original {
        ORIGINALS[FUNCTION].get_or_init(|| original);
    }
    push_function(stack, None, move |stack| {
        match (guard(stack), ORIGINALS[FUNCTION].get()) {
            (Next::Return(results), _) => Exit::Results(results),
            (Next::Refuse(reason), _) => Exit::Refuse(reason),
            (Next::Raise, _) => Exit::Raise,
            (Next::Original, Some(&original)) => Exit::Original(original, None),
            (Next::OriginalThen(then), Some(&original)) => Exit::Original(original, Some(then)),
            (_, None) => Exit::Results(0),
        }
    });
    stack.raw_set_field(-2, name);
}
