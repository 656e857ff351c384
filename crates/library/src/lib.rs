//! The simulator as a shared library: what is behind `libcoppeliaSim.so`.

use c_session::Value;

#[global_allocator]
static ALLOCATOR: heap::Allocator = heap::Allocator;

/// A call of a function: see [`c_session::call`].
///
/// # Safety
/// Only the generated library calls this.
#[expect(unsafe_code, reason = "an edge to C")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn swanilda_library_call(
    interface: u32,
    row: u32,
    values: *mut Value,
    count: u32,
) -> i64 {
    // SAFETY: the generated library has made the values for this row.
    unsafe { c_session::call(interface, row, values, count) }
}
