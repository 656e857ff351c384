//! Functions of Lua's own libraries that take buffers wherever they take a string to look into.

use std::ffi::c_int;

use super::calls::guard::{Guard, Next, guarded, install};
use super::{Stack, Type};

/// Replaces a table on the stack by the string it stands for, if it is a buffer; not a closure with values.
pub(crate) trait Unwrap: Fn(Stack<'_>, c_int) + Copy + 'static {}

impl<F: Fn(Stack<'_>, c_int) + Copy + 'static> Unwrap for F {}

/// Puts `unwrap` in front of the functions.
pub(crate) fn accept_buffers(stack: Stack<'_>, unwrap: impl Unwrap) {
    stack.push_global("string");
    install::<{ guarded::FIND }, _>(stack, "find", subject::<1>(unwrap));
    install::<{ guarded::GMATCH }, _>(stack, "gmatch", subject::<1>(unwrap));
    install::<{ guarded::GSUB }, _>(stack, "gsub", subject::<1>(unwrap));
    install::<{ guarded::MATCH }, _>(stack, "match", subject::<1>(unwrap));
    install::<{ guarded::REP }, _>(stack, "rep", subject::<1>(unwrap));
    install::<{ guarded::LOWER }, _>(stack, "lower", subject::<1>(unwrap));
    install::<{ guarded::UPPER }, _>(stack, "upper", subject::<1>(unwrap));
    install::<{ guarded::REVERSE }, _>(stack, "reverse", subject::<1>(unwrap));
    install::<{ guarded::LEN }, _>(stack, "len", subject::<1>(unwrap));
    install::<{ guarded::SUB }, _>(stack, "sub", subject::<1>(unwrap));
    install::<{ guarded::BYTE }, _>(stack, "byte", subject::<1>(unwrap));
    install::<{ guarded::UNPACK }, _>(stack, "unpack", subject::<2>(unwrap));
    stack.pop(1);
    stack.push_globals();
    install::<{ guarded::TO_NUMBER }, _>(stack, "tonumber", number(unwrap));
    stack.pop(1);
}

/// Looks at argument number `AT`.
fn subject<const AT: c_int>(unwrap: impl Unwrap) -> impl Guard {
    move |stack: Stack<'_>| {
        if stack.kind(AT) == Type::Table {
            unwrap(stack, AT);
        }
        Next::Original
    }
}

/// The wrapper of the original drops the base, and converts no value to nil.
fn number(unwrap: impl Unwrap) -> impl Guard {
    move |stack: Stack<'_>| {
        if stack.top() == 0 {
            stack.push_nil();
        }
        stack.set_top(1);
        if stack.kind(1) == Type::Table {
            unwrap(stack, 1);
        }
        Next::Original
    }
}
