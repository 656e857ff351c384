//! The wall clock, for the few functions that need it: `sim.getSystemTime`, real-time mode, event times, waiting.

/// Now.
#[allow(
    clippy::disallowed_methods,
    reason = "reading the wall clock is this function's job"
)]
pub fn now() -> std::time::Instant {
    std::time::Instant::now()
}

/// Unix time, milliseconds.
pub(crate) fn unix_milliseconds() -> i64 {
    i64::try_from(unix_time().as_millis()).unwrap_or(i64::MAX)
}

/// Unix time, seconds.
pub fn unix_seconds() -> f64 {
    unix_time().as_secs_f64()
}

/// Now, in the format of logs: `2026-01-31 12:00:00`, UTC.
pub fn utc_date_and_time() -> String {
    date_and_time(unix_time().as_secs())
}

/// The same for a Unix time, by the calendar of 400 years, which begin in March so that a leap day is the last one of its year.
fn date_and_time(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400 + 719_468, seconds % 86_400);
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1_460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 {
        from_march + 3
    } else {
        from_march - 9
    };
    let year = era * 400 + year_of_era + u64::from(month <= 2);
    format!(
        "{year:04}-{month:02}-{day:02} {:02}:{:02}:{:02}",
        second / 3600,
        second / 60 % 60,
        second % 60
    )
}

#[allow(
    clippy::disallowed_methods,
    reason = "reading the wall clock is this function's job"
)]
fn unix_time() -> std::time::Duration {
    std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .unwrap_or_default()
}

/// Lets some time pass.
#[allow(
    clippy::disallowed_methods,
    reason = "a script that waits for the world outside has asked for it"
)]
pub(crate) fn pause(time: std::time::Duration) {
    std::thread::sleep(time);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates() {
        assert_eq!(date_and_time(0), "1970-01-01 00:00:00");
        assert_eq!(date_and_time(951_782_400), "2000-02-29 00:00:00");
        assert_eq!(date_and_time(1_767_225_599), "2025-12-31 23:59:59");
        assert_eq!(date_and_time(4_107_542_400), "2100-03-01 00:00:00");
    }
}
