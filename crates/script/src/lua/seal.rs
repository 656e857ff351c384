//! Errors of the Rust functions that an embedding program has added, as scripts catch them: strings with the caller's line.
//!
//! mlua raises userdata, on which `..` and `:find` fail. They become strings where scripts catch errors (`seal.lua`: in `pcall`, `xpcall`,
//! `coroutine.resume` and `coroutine.close`), and in the host's own calls. So a call that succeeds costs nothing more.

use std::ffi::c_int;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use mlua::{Error, FromLua, Value};

use super::calls::callback::panic_text;
use super::{Stack, Type};
use crate::budget::Budget;

/// Name of the registry value by which values are exchanged with mlua.
const EXCHANGE: &str = "swanilda.exchange";

/// A callback that returns its argument, as a string if it is an error of a Rust function.
pub(crate) fn seal_argument(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    stack.set_top(stack.top().min(1));
    if stack.top() == 1 {
        seal_top(stack);
    }
    Ok(stack.top())
}

/// Replaces the value on top by a string, if it is an error of a Rust function.
pub(super) fn seal_top(stack: Stack<'_>) {
    if stack.kind(-1) != Type::UserData {
        return;
    }
    let budget = stack.budget();
    let before = budget.enter(true);
    if let Some(text) = failure(stack) {
        stack.pop(1);
        stack.push_bytes(text.as_bytes());
    }
    budget.leave(before);
}

fn failure(stack: Stack<'_>) -> Option<String> {
    // A panic that mlua caught goes on when its userdata is looked at.
    match catch_unwind(AssertUnwindSafe(|| stack.to_mlua::<Value>(-1))) {
        Ok(Ok(Value::Error(error))) => Some(text_of(&error, stack.budget())),
        Ok(_) => None,
        Err(panic) => Some(format!("a Rust function panicked: {}", panic_text(&*panic))),
    }
}

impl Stack<'_> {
    /// The value at `index`, for mlua's functions.
    pub(super) fn to_mlua<T: FromLua>(self, index: c_int) -> mlua::Result<T> {
        self.push_value(index);
        self.set_named_registry(EXCHANGE);
        let value = catch_unwind(AssertUnwindSafe(|| {
            self.lua().named_registry_value(EXCHANGE)
        }));
        self.push_nil();
        self.set_named_registry(EXCHANGE);
        value.unwrap_or_else(|panic| resume_unwind(panic))
    }
}

/// The line of the call, the function and the reason, as all functions of the simulator say it.
fn text_of(error: &Error, budget: &Budget) -> String {
    let Error::CallbackError { traceback, .. } = error else {
        return reason(error);
    };
    let mut entries = traceback
        .lines()
        .filter_map(|line| line.trim_start().split_once(": in "));
    // Where memory may be refused, mlua begins with the caller.
    let function = if budget.is_limited() {
        None
    } else {
        entries.next()
    };
    let line: Option<i64> = entries
        .next()
        .and_then(|(place, _)| place.rsplit_once(':')?.1.parse().ok());
    let line = line.unwrap_or(-1);
    match function.and_then(|(_, name)| name.split('\'').nth(1)) {
        Some(name) => format!("{line}: in {name}: {}", reason(error)),
        None => format!("{line}: {}", reason(error)),
    }
}

/// The message of a Rust function, without its caller.
fn reason(error: &Error) -> String {
    match error {
        Error::CallbackError { cause, .. } => reason(cause),
        // The error of a Lua function comes with its traceback.
        Error::RuntimeError(text) => text
            .split("\nstack traceback:")
            .next()
            .unwrap_or_default()
            .to_owned(),
        other => other.to_string(),
    }
}
