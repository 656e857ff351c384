//! Loading text only: bytecode that somebody changed makes Lua write where it should not.

use std::ffi::c_int;

use super::guard::{Next, guarded, install};
use super::{Stack, Type};

/// Makes `load` and `loadfile` refuse bytecode; `no_unsafe.lua` does what builds on them.
pub(crate) fn refuse_bytecode(stack: Stack<'_>) {
    stack.push_globals();
    install::<{ guarded::LOAD }, _>(stack, "load", load);
    install::<{ guarded::LOAD_FILE }, _>(stack, "loadfile", load_file);
    stack.pop(1);
}

fn load(stack: Stack<'_>) -> Next {
    set_text_mode(stack, 3)
}

fn load_file(stack: Stack<'_>) -> Next {
    set_text_mode(stack, 2)
}

/// Lua's function is to see the mode for text, in that argument.
fn set_text_mode(stack: Stack<'_>, mode: c_int) -> Next {
    while stack.top() < mode {
        stack.push_nil();
    }
    match stack.kind(mode) {
        Type::Nil => {}
        Type::String if stack.with_bytes(mode, |mode| mode.contains(&b't')) == Some(true) => {}
        Type::String => {
            stack.push_nil();
            stack.push_bytes(b"bytecode is switched off (--no-unsafe).");
            return Next::Return(2);
        }
        // Lua's function says what is wrong with it.
        _ => return Next::Original,
    }
    stack.push_bytes(b"t");
    stack.insert(mode);
    stack.remove(mode + 1);
    Next::Original
}
