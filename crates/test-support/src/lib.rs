//! What the tests of several packages need: commands that run with a bound on time, outputs that are compared with recordings, a client of the debugger, work on
//! all processors, and numbers drawn at random. No package that is published depends on it outside of its tests.

#![allow(
    clippy::disallowed_methods,
    reason = "every wait of a test is bounded by the clock"
)]

pub mod compare;
pub mod debug_client;
pub mod parallel;
pub mod process;
pub mod random;

use std::io::Write;

/// Shows on the terminal why the running test checks less than it could, or nothing. Standard error is written to directly, since the
/// output of tests that pass is hidden.
pub fn skipped(reason: &str) {
    let thread = std::thread::current();
    let _ = writeln!(
        std::io::stderr(),
        "{}: skipped: {reason}",
        thread.name().unwrap_or("a test")
    );
}

/// The same for what build machines must have.
///
/// # Panics
/// With `CI` set.
pub fn skipped_outside_of_ci(reason: &str) {
    assert!(
        std::env::var_os("CI").is_none(),
        "with CI set nothing is skipped: {reason}"
    );
    skipped(reason);
}
