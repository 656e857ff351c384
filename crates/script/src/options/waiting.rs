//! Waiting for another program or a device. Every wait ends when the program is stopped.

use std::sync::atomic::Ordering;
use std::time::Duration;

use super::Options;
use crate::error::{ApiError, ApiResult};
use crate::wall_clock;

/// The first interval between two polls; each one is twice as long as the one before.
const FIRST_POLL_INTERVAL: Duration = Duration::from_micros(50);
const MAX_POLL_INTERVAL: Duration = Duration::from_millis(5);

impl Options {
    /// Whether the program is being stopped.
    pub fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Asks again and again until there is an answer; None when there is none within `limit`.
    ///
    /// # Errors
    /// When the program is being stopped.
    pub(crate) fn wait_for<T>(
        &self,
        limit: Option<Duration>,
        mut answer: impl FnMut() -> Option<T>,
    ) -> ApiResult<Option<T>> {
        let begun = wall_clock::now();
        let mut pause = FIRST_POLL_INTERVAL;
        loop {
            if let Some(answer) = answer() {
                return Ok(Some(answer));
            }
            let left = limit.map_or(MAX_POLL_INTERVAL, |limit| {
                limit.saturating_sub(begun.elapsed())
            });
            let tape = self.permissions.tape();
            let end = tape.input("the end of a wait", || {
                (left.is_zero(), self.is_interrupted())
            });
            let (is_late, is_interrupted) = end.unwrap_or((false, true));
            if is_late {
                return Ok(None);
            }
            if is_interrupted {
                return Err(ApiError::Interrupted);
            }
            if !tape.is_replaying() {
                wall_clock::pause(pause.min(left));
            }
            pause = MAX_POLL_INTERVAL.min(pause * 2);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::Ordering;
    use std::time::Duration;

    use crate::error::ApiError;
    use crate::options::Options;

    #[test]
    fn a_wait_ends_with_the_program() {
        let options = Options::default();
        let stop = options.stop.clone();
        let waiting = std::thread::spawn(move || options.wait_for(None, || None::<()>));
        assert!(!waiting.is_finished());
        stop.store(true, Ordering::Relaxed);
        assert_eq!(
            waiting.join().expect("it does not panic"),
            Err(ApiError::Interrupted)
        );
    }

    #[test]
    fn a_wait_with_a_limit_ends() {
        let options = Options::default();
        assert_eq!(
            options.wait_for(Some(Duration::from_millis(2)), || None::<()>),
            Ok(None)
        );
        assert_eq!(
            options.wait_for(Some(Duration::ZERO), || Some(1)),
            Ok(Some(1)),
            "the condition is checked first"
        );
    }
}
