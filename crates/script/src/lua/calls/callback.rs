//! Rust functions callable from Lua.

use std::any::Any;
use std::ffi::c_int;

use super::entry::{Exit, push_function};
use crate::lua::Stack;

/// A Rust function Lua can call: gets the stack with its arguments and the number given to [`push_callback`], returns how many
/// results it pushed, or the text of the error to raise. It is a function, not a closure with values.
pub(crate) trait Callback:
    Fn(Stack<'_>, usize) -> Result<c_int, String> + Copy + 'static
{
}

impl<F: Fn(Stack<'_>, usize) -> Result<c_int, String> + Copy + 'static> Callback for F {}

/// Pushes `callback` as a Lua function. Each call gets `number` and looks it up. With 0 the function takes no memory of the state.
pub(crate) fn push_callback<F: Callback>(stack: Stack<'_>, callback: F, number: usize) {
    let number = (number != 0).then_some(numbers::count(number));
    push_function(stack, number, move |stack| {
        match callback(stack, numbers::place_of(stack.number_of_function())) {
            Ok(results) => {
                debug_assert!(
                    (0..=stack.top()).contains(&results),
                    "results are on the stack"
                );
                Exit::Results(results)
            }
            Err(text) => {
                stack.push_bytes(text.as_bytes());
                Exit::Raise
            }
        }
    });
}

/// How a function of [`push_plain`] ends.
pub(crate) enum Outcome {
    /// This number of values on top are its results.
    Results(c_int),
    /// This text is raised.
    Raise(String),
    /// The lowest value on the stack is called with those above it, and may yield; its results are those of this function.
    Call,
}

/// Pushes a Lua function that takes no memory of the state. It is a function, not a closure with values.
pub(crate) fn push_plain<F: Fn(Stack<'_>) -> Outcome + Copy + 'static>(
    stack: Stack<'_>,
    function: F,
) {
    push_function(stack, None, move |stack| match function(stack) {
        Outcome::Results(results) => Exit::Results(results),
        Outcome::Raise(text) => {
            stack.push_bytes(text.as_bytes());
            Exit::Raise
        }
        Outcome::Call => Exit::Call,
    });
}

/// The error a script gets for a mistake of ours.
pub(in crate::lua) fn panic_message(panic: &(dyn Any + Send)) -> String {
    format!(
        "internal error in Swanilda, please report it: {}",
        panic_text(panic)
    )
}

/// The message of a panic.
pub(in crate::lua) fn panic_text(panic: &(dyn Any + Send)) -> &str {
    let text = panic
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("panic")
}
