//! The wall clock, for the few functions whose job it is: `sim.getSystemTime` and real-time mode.

/// Now.
#[allow(clippy::disallowed_methods, reason = "reading the wall clock is this function's job")]
pub(crate) fn now() -> std::time::Instant {
    std::time::Instant::now()
}
