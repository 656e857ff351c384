//! Waiting for another program or a device. Every wait ends when the user wants the program to end.

use std::sync::atomic::Ordering;
use std::time::Duration;

use super::wall_clock;
use crate::script::error::{ApiError, ApiResult};
use crate::script::sim::Sim;

/// The first pause between two looks; each is twice as long as the one before.
const FIRST_PAUSE: Duration = Duration::from_micros(50);
const LONGEST_PAUSE: Duration = Duration::from_millis(5);

impl Sim {
    /// Whether the user wants the program to end.
    pub(crate) fn is_interrupted(&self) -> bool {
        self.options.stop.load(Ordering::Relaxed)
    }

    /// Asks again and again until there is an answer; None when there is none within `limit`.
    ///
    /// # Errors
    /// When the user wants the program to end.
    pub(crate) fn wait_for<T>(
        &self,
        limit: Option<Duration>,
        mut answer: impl FnMut() -> Option<T>,
    ) -> ApiResult<Option<T>> {
        let begun = wall_clock::now();
        let mut pause = FIRST_PAUSE;
        loop {
            if let Some(answer) = answer() {
                return Ok(Some(answer));
            }
            let left = limit.map_or(LONGEST_PAUSE, |limit| limit.saturating_sub(begun.elapsed()));
            if left.is_zero() {
                return Ok(None);
            }
            if self.is_interrupted() {
                return Err(ApiError::Interrupted);
            }
            wall_clock::pause(pause.min(left));
            pause = LONGEST_PAUSE.min(pause * 2);
        }
    }
}
