//! Expressions in the midst of running code: names are variables of a function, then global ones.

use std::ffi::c_int;

use super::{Debugged, frames};
use crate::host::FrameId;
use crate::lua::{LuaError, Stack, Type, push_callback};
use crate::lua_runtime::startup::load_module;

/// The name of the code in messages.
const NAME: &str = "=(expression)";
/// Begins the list of calls below a message.
const TRACEBACK: &str = "\nstack traceback:";

/// Evaluates an expression or statements, and calls `read` with the value on top of the stack. Nothing stops meanwhile.
pub(super) fn with_value<T>(
    main: Stack<'_>,
    frame: Option<FrameId>,
    code: &str,
    read: impl FnOnce(Stack<'_>) -> Result<T, String>,
) -> Result<T, String> {
    let debugged = Debugged::of(main).ok_or("the script is not debugged")?;
    let stack = frames::innermost(main);
    let top = stack.top();
    if !stack.reserve(20) {
        return Err("stack overflow".into());
    }
    let before = debugged.is_evaluating.replace(true);
    debugged.frame.set(frame);
    let outcome = evaluate(stack, main, frame, code).map_err(message);
    let result = outcome.and_then(|()| read(stack));
    debugged.is_evaluating.set(before);
    stack.set_top(top);
    result
}

fn message(error: LuaError) -> String {
    let end = error.text.find(TRACEBACK).unwrap_or(error.text.len());
    error.text[..end].to_owned()
}

/// Leaves the value on top.
fn evaluate(
    stack: Stack<'_>,
    main: Stack<'_>,
    frame: Option<FrameId>,
    code: &str,
) -> Result<(), LuaError> {
    let expression = format!("return {code}");
    stack
        .load_text(expression.as_bytes(), NAME)
        .or_else(|_| stack.load_text(code.as_bytes(), NAME))?;
    if let Some(frame) = frame {
        push_names(stack, main, frame)?;
        stack.set_environment();
    }
    stack.protected_call(0, 1)
}

/// Pushes the table of all names that a function sees.
fn push_names(stack: Stack<'_>, main: Stack<'_>, frame: FrameId) -> Result<(), LuaError> {
    let gone = || LuaError {
        text: "the simulator is gone.".into(),
    };
    let sim = stack.env().sim.upgrade().ok_or_else(gone)?;
    load_module(stack, &sim, "debug_names")?;
    push_callback(stack, get, 0);
    push_callback(stack, set, 0);
    push_environment(stack, main, frame);
    stack.protected_call(3, 1)
}

/// Pushes the global variables as a function sees them.
fn push_environment(stack: Stack<'_>, main: Stack<'_>, frame: FrameId) {
    if let Some(coroutine) = frames::coroutine(main, frame.coroutine)
        && stack.push_running_function(coroutine, frame.below)
    {
        let names = stack.upvalue_names(-1);
        let number = names.iter().find(|(name, _)| name == "_ENV");
        if let Some((_, number)) = number
            && stack.push_upvalue_of(-1, *number)
        {
            stack.remove(-2);
            if stack.kind(-1) != Type::Nil {
                return;
            }
        }
        stack.pop(1);
    }
    stack.push_globals();
}

/// The main coroutine of the state of a running function.
fn main_of(stack: Stack<'_>) -> Option<Stack<'_>> {
    stack.push_main_coroutine();
    let main = stack.coroutine_at(-1);
    stack.pop(1);
    main
}

/// A variable of the function in which an expression is evaluated.
enum Found<'a> {
    Local(Stack<'a>, i32, c_int),
    /// Of the function on top of the stack.
    Upvalue(c_int),
}

/// Looks for the variable whose name is the first argument.
fn find(stack: Stack<'_>) -> Option<Found<'_>> {
    let name = String::from_utf8(stack.text(1)?).ok()?;
    let frame = Debugged::of(stack)?.frame.get()?;
    let coroutine = frames::coroutine(main_of(stack)?, frame.coroutine)?;
    let is_named = |(found, _): &(String, c_int)| *found == name;
    // Inner variables hide outer ones of the same name.
    let locals = coroutine.local_variables(frame.below);
    if let Some((_, number)) = locals.into_iter().rev().find(is_named) {
        return Some(Found::Local(coroutine, frame.below, number));
    }
    if !stack.push_running_function(coroutine, frame.below) {
        return None;
    }
    let upvalues = stack.upvalue_names(-1);
    upvalues
        .into_iter()
        .find(is_named)
        .map(|(_, number)| Found::Upvalue(number))
}

/// Whether the function has a variable of that name, and its value.
fn get(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let found = find(stack);
    let is_there = match found {
        Some(Found::Local(coroutine, below, number)) => stack.push_local(coroutine, below, number),
        Some(Found::Upvalue(number)) => stack.push_upvalue_of(-1, number),
        None => false,
    };
    if !is_there {
        stack.push_bool(false);
        return Ok(1);
    }
    stack.push_bool(true);
    stack.insert(-2);
    Ok(2)
}

/// Sets the variable of that name, if the function has one; whether it has.
fn set(stack: Stack<'_>, _: usize) -> Result<c_int, String> {
    let found = find(stack);
    let is_there = found.is_some();
    match found {
        Some(Found::Local(coroutine, below, number)) => {
            stack.push_value(2);
            stack.set_local_of(coroutine, below, number);
        }
        Some(Found::Upvalue(number)) => {
            stack.push_value(2);
            stack.set_upvalue_of(-2, number);
        }
        None => {}
    }
    stack.push_bool(is_there);
    Ok(1)
}
