//! The wall clock, for the few functions whose job it is: `sim.getSystemTime`, real-time mode, the time of events, waiting.

/// Now.
#[allow(clippy::disallowed_methods, reason = "reading the wall clock is this function's job")]
pub(crate) fn now() -> std::time::Instant {
    std::time::Instant::now()
}

/// Unix time, milliseconds.
pub(crate) fn unix_milliseconds() -> i64 {
    unix_time().as_millis() as i64
}

/// Unix time, seconds.
pub(crate) fn unix_seconds() -> f64 {
    unix_time().as_secs_f64()
}

#[allow(clippy::disallowed_methods, reason = "reading the wall clock is this function's job")]
fn unix_time() -> std::time::Duration {
    std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default()
}

/// Lets some time pass.
#[allow(clippy::disallowed_methods, reason = "a script that waits for the world outside has asked for it")]
pub(crate) fn pause(time: std::time::Duration) {
    std::thread::sleep(time);
}
