//! Buffers: tables that stand for byte strings. `Buffer.lua` is their class.

use std::ffi::c_int;

use super::stand_ins::go_on;
use crate::binding::data::{
    BUFFER_FIELD, BUFFER_FIELD_NAME, BUFFER_METATABLE, is_buffer, push_buffer,
};
use crate::lua::{Outcome, Stack, Type, accept_buffers, push_plain};

/// Makes the metatable of all buffers and the functions for them, and lets Lua's functions take them for strings.
pub(super) fn install(stack: Stack<'_>) {
    accept_buffers(stack, unwrap);
    push_plain(stack, is_buffer_function);
    stack.set_global("isbuffer");
    push_plain(stack, to_buffer);
    stack.set_global("tobuffer");
    stack.new_table(0, 6);
    stack.push_global("string");
    stack.raw_set_field(-2, "__index");
    set_field(stack, "__len", length);
    set_field(stack, "__eq", are_equal);
    set_field(stack, "__concat", concatenate);
    set_field(stack, "__tostring", to_string);
    set_field(stack, "__isbuffer", |stack| {
        stack.push_bool(true);
        Outcome::Results(1)
    });
    stack.set_registry(BUFFER_METATABLE);
    stack.push_bytes(BUFFER_FIELD.as_bytes());
    stack.set_registry(BUFFER_FIELD_NAME);
}

/// Sets a field of the table on top.
fn set_field(
    stack: Stack<'_>,
    name: &str,
    function: impl Fn(Stack<'_>) -> Outcome + Copy + 'static,
) {
    push_plain(stack, function);
    stack.raw_set_field(-2, name);
}

/// Replaces the value at `index`, a positive one, by its bytes if it is a buffer.
fn unwrap(stack: Stack<'_>, index: c_int) {
    if is_buffer(stack, index) {
        stack.push_registry(BUFFER_FIELD_NAME);
        stack.raw_get(index);
        stack.insert(index);
        stack.remove(index + 1);
    }
}

fn is_buffer_function(stack: Stack<'_>) -> Outcome {
    stack.push_bool(is_buffer(stack, 1));
    Outcome::Results(1)
}

fn to_buffer(stack: Stack<'_>) -> Outcome {
    if is_buffer(stack, 1) {
        stack.set_top(1);
    } else if let Some(bytes) = stack.bytes(1) {
        push_buffer(stack, &bytes);
    } else {
        return go_on(stack, "swanilda.extensions", "tobuffer");
    }
    Outcome::Results(1)
}

fn length(stack: Stack<'_>) -> Outcome {
    unwrap(stack, 1);
    if stack.kind(1) != Type::String {
        return Outcome::Raise(format!(
            "{}attempt to get length of what is no string",
            stack.place_of_call()
        ));
    }
    stack.push_int(numbers::count(stack.raw_len(1)));
    Outcome::Results(1)
}

fn are_equal(stack: Stack<'_>) -> Outcome {
    unwrap_two(stack);
    stack.push_bool(stack.same(1, 2));
    Outcome::Results(1)
}

fn concatenate(stack: Stack<'_>) -> Outcome {
    unwrap_two(stack);
    let (Some(first), Some(second)) = (stack.text(1), stack.text(2)) else {
        return Outcome::Raise(format!(
            "{}attempt to concatenate what is no string",
            stack.place_of_call()
        ));
    };
    push_buffer(stack, &[first, second].concat());
    Outcome::Results(1)
}

fn unwrap_two(stack: Stack<'_>) {
    while stack.top() < 2 {
        stack.push_nil();
    }
    unwrap(stack, 1);
    unwrap(stack, 2);
}

fn to_string(stack: Stack<'_>) -> Outcome {
    unwrap(stack, 1);
    stack.set_top(stack.top().min(1));
    Outcome::Results(stack.top())
}
