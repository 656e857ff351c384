//! The simulator of a process that calls CoppeliaSim's C functions.
//!
//! A program starts a simulator on a thread of its own choice ([`launch`]); from then on that thread's calls reach it ([`session`]).
//! Calls by other threads are errors. Shared libraries that contain this export [`call`] as `swanilda_library_call`: the generated
//! `libcoppeliaSim.so` (`c-interface`) lies beside them and calls it for each function.

mod add_ons;
mod launch;
mod session;
mod unattached;

use std::sync::Once;

pub use c_interface::Value;
use c_interface::{INTERFACE_41, INTERFACE_410, Interface, interface_41, interface_410};
use heap::Lazy;

static OF_41: Lazy<Interface> = Lazy::new(|| interface_41(launch::FUNCTIONS));
static OF_410: Lazy<Interface> = Lazy::new(|| interface_410(launch::FUNCTIONS));

/// A call of a function: the number of the interface, the row in its table of symbols, the parameters and their number. The result is
/// what C returns, but numbers that are no integers: those are the last value.
///
/// # Safety
/// `values` are `count` values as the generated library makes them for that row.
#[expect(unsafe_code, reason = "an edge to C")]
pub unsafe fn call(interface: u32, row: u32, values: *mut Value, count: u32) -> i64 {
    unattached::attach_thread();
    let interface = match interface {
        INTERFACE_41 => &*OF_41,
        INTERFACE_410 => &*OF_410,
        _ => return foreign(),
    };
    // SAFETY: as the caller says.
    unsafe { interface.call_from_c(row, values, count) }
}

/// A call by a library of another build, whose rows may be others.
fn foreign() -> i64 {
    static SAID: Once = Once::new();
    SAID.call_once(|| {
        eprintln!(
            "swanilda: libcoppeliaSim.so and libswanilda_library.so are of different builds: write the folder again."
        );
    });
    -1
}
