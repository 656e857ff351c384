//! How long a call may take.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Ends what scripts and tools do when the time is over, by a flag that both look at.
pub(crate) struct Deadline {
    stop: Arc<AtomicBool>,
    end: Sender<()>,
    /// Whether the time was over; None where there is no thread.
    guard: Option<JoinHandle<bool>>,
}

impl Deadline {
    pub(crate) fn start(stop: &Arc<AtomicBool>, after: Duration) -> Self {
        let (end, ended) = channel();
        let flag = Arc::clone(stop);
        let watch = move || {
            let is_late = ended.recv_timeout(after) == Err(RecvTimeoutError::Timeout);
            if is_late {
                flag.store(true, Ordering::Relaxed);
            }
            is_late
        };
        let guard = std::thread::Builder::new()
            .name("deadline".into())
            .spawn(watch);
        Self {
            stop: Arc::clone(stop),
            end,
            guard: guard.ok(),
        }
    }

    /// The call is over: nothing is ended any more. Whether it was too late.
    pub(crate) fn end(self) -> bool {
        drop(self.end);
        let is_late = self
            .guard
            .and_then(|guard| guard.join().ok())
            .unwrap_or_default();
        self.stop.store(false, Ordering::Relaxed);
        is_late
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_flag_is_set_when_the_time_is_over_and_taken_back_at_the_end() {
        let stop = Arc::<AtomicBool>::default();
        let deadline = Deadline::start(&stop, Duration::ZERO);
        while !stop.load(Ordering::Relaxed) {
            std::thread::yield_now();
        }
        assert!(deadline.end());
        assert!(!stop.load(Ordering::Relaxed));
        assert!(!Deadline::start(&stop, Duration::from_secs(3600)).end());
    }
}
