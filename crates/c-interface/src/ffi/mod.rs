//! The edge to C: shared libraries, their functions, and what lies behind the addresses that plugins pass.
//!
//! All `unsafe` code for plugins is in this folder. What it can check it checks: null pointers, counts, sizes, and addresses of memory
//! that the simulator has made. What C cannot tell, it has to believe: that an address leads to as many values as the function's row or
//! the plugin's count says, and that the entry points have the types of the interface.

mod library;
mod memory;

pub use library::Callback;
pub(super) use library::{Caller, Library, Message, connect};
pub use memory::Value;
pub(crate) use memory::{Address, Plain};

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::dispatch::{Interface, plugin_interface};

/// Where every call of a plugin arrives.
pub(super) extern "C" fn enter(row: u32, values: *mut Value, count: u32) -> i64 {
    perform(plugin_interface(), row, values, count)
}

/// A call that has come from the generated C code. A panic must not go on into C: it is a failed call.
fn perform(interface: &Interface, row: u32, values: *mut Value, count: u32) -> i64 {
    let values = Value::of_call(values, count);
    catch_unwind(AssertUnwindSafe(|| interface.perform(row, values)))
        .unwrap_or_else(|_| interface.failure(row))
}

impl Interface {
    /// A call of symbol `row` with `count` values; its result as C returns it. A panic is a failed call.
    ///
    /// # Safety
    /// The call comes from the C code that the build script made for this interface, so that the values are what the row says.
    pub unsafe fn call_from_c(&self, row: u32, values: *mut Value, count: u32) -> i64 {
        perform(self, row, values, count)
    }
}
