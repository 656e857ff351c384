//! The wall clock, for the few functions whose job it is: `sim.getSystemTime`, real-time mode, the time of events, waiting.

/// Now.
#[allow(clippy::disallowed_methods, reason = "reading the wall clock is this function's job")]
pub(crate) fn now() -> std::time::Instant {
    std::time::Instant::now()
}

/// Unix time, milliseconds.
#[allow(clippy::disallowed_methods, reason = "reading the wall clock is this function's job")]
pub(crate) fn unix_milliseconds() -> i64 {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    since.map_or(0, |elapsed| elapsed.as_millis() as i64)
}

/// Lets some time pass.
#[allow(clippy::disallowed_methods, reason = "a script that waits for the world outside has asked for it")]
pub(crate) fn pause(time: std::time::Duration) {
    std::thread::sleep(time);
}
