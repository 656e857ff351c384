//! Rust functions callable from Lua.

use std::any::Any;
use std::ffi::c_int;

use super::entry::{Exit, push_function};
use crate::script::lua::Stack;

/// A Rust function Lua can call: gets the stack with its arguments and the number given to [`push_callback`], returns how many
/// results it pushed, or the text of the error to raise. It is a function, not a closure with values.
pub(crate) trait Callback: Fn(Stack<'_>, usize) -> Result<c_int, String> + Copy + 'static {}

impl<F: Fn(Stack<'_>, usize) -> Result<c_int, String> + Copy + 'static> Callback for F {}

/// Pushes `callback` as a Lua function. Each call gets `number` and looks it up.
pub(crate) fn push_callback<F: Callback>(stack: Stack<'_>, callback: F, number: usize) {
    push_function(stack, Some(number as i64), move |stack| {
        match callback(stack, stack.number_of_function() as usize) {
            Ok(results) => {
                debug_assert!((0..=stack.top()).contains(&results), "results are on the stack");
                Exit::Results(results)
            }
            Err(text) => {
                stack.push_bytes(text.as_bytes());
                Exit::Raise
            }
        }
    });
}

/// The error a script gets for a mistake of ours.
pub(in crate::script::lua) fn panic_message(panic: &(dyn Any + Send)) -> String {
    format!("internal error in Swanilda, please report it: {}", panic_text(panic))
}

/// The message of a panic.
pub(in crate::script::lua) fn panic_text(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("panic")
}
