//! The simulator as a shared library: what is behind `libcoppeliaSim.so`.
//!
//! That library is generated from a table of symbols (`c-interface`). It lies beside this one and calls [`swanilda_library_call`] for
//! each function. A program starts a simulator on a thread of its own choice ([`launch`]); from then on that thread's calls reach it
//! ([`session`]). Calls by other threads are errors.

mod add_ons;
mod launch;
mod session;
mod unattached;

use c_interface::{Interface, Value, interface_41};
use heap::Lazy;

#[global_allocator]
static ALLOCATOR: heap::Allocator = heap::Allocator;

/// CoppeliaSim 4.1, as the generated library numbers it.
const VERSION_41: u32 = 0;

static INTERFACE_41: Lazy<Interface> = Lazy::new(|| interface_41(launch::FUNCTIONS));

/// A call of a function: the version of the interface, the row in its table of symbols, the parameters and their number. The result is
/// what C returns, but numbers that are no integers: those are the last value.
///
/// # Safety
/// Only the generated library calls this.
#[expect(unsafe_code, reason = "an edge to C")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn swanilda_library_call(
    version: u32,
    row: u32,
    values: *mut Value,
    count: u32,
) -> i64 {
    unattached::attach_thread();
    if version != VERSION_41 {
        return -1;
    }
    // SAFETY: the generated library has made the values for this row.
    unsafe { INTERFACE_41.call_from_c(row, values, count) }
}
