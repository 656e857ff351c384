//! When something has to be done.

use std::time::{Duration, Instant};

/// A time by which all parts of something have to be done.
#[derive(Clone, Copy)]
pub(crate) struct Deadline(Instant);

#[allow(
    clippy::disallowed_methods,
    reason = "time limits of connections are times of the wall clock"
)]
impl Deadline {
    pub(crate) fn after(timeout: Duration) -> Self {
        Self(Instant::now() + timeout)
    }

    /// What is left. None if it is over.
    pub(crate) fn left(self) -> Option<Duration> {
        self.0
            .checked_duration_since(Instant::now())
            .filter(|left| !left.is_zero())
    }
}
