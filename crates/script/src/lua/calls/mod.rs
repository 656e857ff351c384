//! Calling Lua code, and inspecting the call stack.

pub(super) mod callback;
pub(super) mod entry;
pub(super) mod guard;

use std::ffi::c_int;

use mlua::{Error, ffi};

use super::api;
use super::hooks::listener;
use super::hooks::running::Running;
use super::seal::seal_top;
use super::stack::Stack;
use super::stack::frame::{Facts, Frame};
use entry::{Exit, push_function};

/// "All results", for [`Stack::protected_call`].
pub(crate) const MULTIPLE: c_int = ffi::LUA_MULTRET;

/// An error that ended a protected call.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LuaError {
    /// The error value as text with Lua's traceback, or `(error unknown)` when it was no string.
    pub text: String,
}

impl From<Error> for LuaError {
    fn from(error: Error) -> Self {
        Self {
            text: error.to_string(),
        }
    }
}

impl Stack<'_> {
    /// Calls the function below its `arguments` on the stack, replacing them by `results` values.
    pub(crate) fn protected_call(self, arguments: c_int, results: c_int) -> Result<(), LuaError> {
        let handler = self.top() - arguments;
        assert!(
            arguments >= 0 && handler > 0,
            "only what is there can be called"
        );
        self.push_message_handler();
        self.insert(handler);
        let outcome = self.call_above(handler, arguments, results);
        self.remove(handler);
        outcome
    }

    /// Pushes what adds the traceback to errors, for [`call_above`](Self::call_above); returns its index.
    pub(crate) fn push_message_handler(self) -> c_int {
        push_function(self, None, message_handler);
        self.top()
    }

    /// Like [`protected_call`](Self::protected_call), with a message handler that is on the stack already, anywhere below the function.
    pub(crate) fn call_above(
        self,
        handler: c_int,
        arguments: c_int,
        results: c_int,
    ) -> Result<(), LuaError> {
        let function = self.top() - arguments;
        assert!(
            arguments >= 0 && 0 < handler && handler < function,
            "only what is there can be called"
        );
        assert!(
            results <= 0 || api::lua_checkstack(self, results) != 0,
            "stack overflow"
        );
        let budget = self.budget();
        let before = budget.enter(false);
        let running = Running::begin(self);
        // SAFETY: the handler, the function and its arguments are on the stack, which has room for the results. Every error is caught.
        let status = unsafe { ffi::lua_pcall(self.raw(), arguments, results, handler) };
        drop(running);
        budget.leave(before);
        if status == ffi::LUA_OK {
            Ok(())
        } else {
            Err(self.pop_error())
        }
    }

    pub(super) fn pop_error(self) -> LuaError {
        let text = self.text(-1).map_or_else(
            || "(error unknown)".into(),
            |t| String::from_utf8_lossy(&t).into_owned(),
        );
        self.pop(1);
        LuaError { text }
    }

    /// The line being executed by the function that called the running callback, passing over functions of chunks that `is_library`
    /// names; -1 when that is not a Lua function.
    pub(crate) fn line_of_caller(self, is_library: impl Fn(&str) -> bool) -> c_int {
        let in_library = |frame: &Frame<'_>| frame.source().to_str().is_ok_and(&is_library);
        let Some(caller) = self.frame(1, Facts::LINE_AND_SOURCE) else {
            return -1;
        };
        if !in_library(&caller) {
            return caller.line();
        }
        let frames = (2..).map_while(|level| self.frame(level, Facts::LINE_AND_SOURCE));
        let script = frames
            .into_iter()
            .find(|frame| !frame.is_native() && !in_library(frame));
        script.unwrap_or(caller).line()
    }

    /// The text of Lua's own functions for an invalid argument, raised by the running callback.
    pub(crate) fn argument_error(self, position: i32, reason: &str) -> String {
        let (name, is_method) = self.called_as();
        let place = self.place_of_call();
        match (position, is_method) {
            (1, true) => format!("{place}calling '{name}' on bad self ({reason})"),
            (_, true) => format!(
                "{place}bad argument #{} to '{name}' ({reason})",
                position - 1
            ),
            (_, false) => format!("{place}bad argument #{position} to '{name}' ({reason})"),
        }
    }

    /// The name the running function was called by, and whether as a method.
    fn called_as(self) -> (String, bool) {
        let frame = self.frame(0, Facts::NAME);
        let called = frame.and_then(|frame| {
            Some((
                frame.name()?.to_string_lossy().into_owned(),
                frame.is_method(),
            ))
        });
        called.unwrap_or_else(|| ("?".into(), false))
    }

    /// `chunk:line: ` of the Lua function that called; nothing when that is none.
    pub(crate) fn place_of_call(self) -> String {
        api::luaL_where(self.large_room(), 1);
        let place = self.text(-1).unwrap_or_default();
        self.pop(1);
        String::from_utf8_lossy(&place).into_owned()
    }

    /// Lua's traceback of this coroutine, without the running function, which is a callback.
    pub(crate) fn traceback(self) -> String {
        self.traceback_from(1)
    }

    /// The same from a level on: 0 is the running function.
    pub(crate) fn traceback_from(self, level: c_int) -> String {
        api::luaL_traceback(self.large_room(), self, None, level);
        let text = self.text(-1).unwrap_or_default();
        self.pop(1);
        String::from_utf8_lossy(&text).into_owned()
    }

    pub(crate) fn is_main_coroutine(self) -> bool {
        let is_main = api::lua_pushthread(self.room()) != 0;
        self.pop(1);
        is_main
    }

    /// Pushes the coroutine of this stack.
    pub(crate) fn push_running_coroutine(self) {
        api::lua_pushthread(self.room());
    }
}

/// Adds the traceback to string errors, and to those of Rust functions, and leaves other values alone, as `debug.traceback` does.
fn message_handler(stack: Stack<'_>) -> Exit {
    seal_top(stack);
    listener::of_error(stack, listener::Catcher::Host);
    if let Some(mut message) = stack.text(-1) {
        // Up to the first NUL, as in Lua.
        message.truncate(
            message
                .iter()
                .position(|&byte| byte == 0)
                .unwrap_or(message.len()),
        );
        message.push(b'\n');
        message.extend(stack.traceback_from(1).into_bytes());
        stack.push_bytes(&message);
    }
    Exit::Results(1)
}
