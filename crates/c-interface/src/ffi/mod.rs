//! The edge to C: shared libraries, their functions, and what lies behind the addresses that plugins pass.
//!
//! All `unsafe` code for plugins is in this folder. What it can check it checks: null pointers, counts, sizes, and addresses of memory
//! that the simulator has made. What C cannot tell, it has to believe: that an address leads to as many values as the function's row or
//! the plugin's count says, and that the entry points have the types of the interface.

mod library;
mod memory;

pub(super) use library::{Callback, Caller, Library, Message, connect};
pub(super) use memory::{Plain, Value};

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::dispatch;

/// Where every call of a plugin arrives. A panic must not go on into C: it is a failed call.
pub(super) extern "C" fn enter(row: u32, values: *mut Value, count: u32) -> i64 {
    let values = Value::of_call(values, count);
    catch_unwind(AssertUnwindSafe(|| dispatch::perform(row, values)))
        .unwrap_or_else(|_| dispatch::failure(row))
}
