//! Waiting: the two timeouts of a socket, and many sockets at once.
//!
//! Waits go in slices, so that a script that waits without a limit does not hold up the end of the program.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;

use super::{Failure, Socket};

/// Interval between checks whether the program is being stopped.
pub(super) const SLICE: Duration = Duration::from_millis(100);

/// Limits in seconds; negative ones are none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timeout {
    /// Of each wait.
    pub block: f64,
    /// Of a whole operation.
    pub total: f64,
}

impl Default for Timeout {
    fn default() -> Self {
        Self {
            block: -1.0,
            total: -1.0,
        }
    }
}

/// The waits of one operation.
pub struct Wait<'a> {
    timeout: Timeout,
    /// Looked up only where it matters.
    began: Option<Instant>,
    stop: &'a AtomicBool,
}

impl<'a> Wait<'a> {
    /// An operation begins. Once `stop` is set, it waits no longer.
    pub fn begin(timeout: Timeout, stop: &'a AtomicBool) -> Self {
        Self {
            timeout,
            began: (timeout.total >= 0.0).then(now),
            stop,
        }
    }

    /// Whether the operation may not wait at all.
    pub(super) fn is_zero(&self) -> bool {
        self.limit().is_some_and(|limit| limit.is_zero())
    }

    fn limit(&self) -> Option<Duration> {
        let block = duration(self.timeout.block);
        let elapsed = self.began.map(|began| began.elapsed()).unwrap_or_default();
        let total = duration(self.timeout.total).map(|total| total.saturating_sub(elapsed));
        match (block, total) {
            (Some(block), Some(total)) => Some(block.min(total)),
            (block, total) => block.or(total),
        }
    }

    pub(super) fn readable(&self, socket: &Socket) -> Result<(), Failure> {
        self.until(socket, PollFlags::IN)
    }

    pub(super) fn writable(&self, socket: &Socket) -> Result<(), Failure> {
        self.until(socket, PollFlags::OUT)
    }

    fn until(&self, socket: &Socket, events: PollFlags) -> Result<(), Failure> {
        let mut waiting = [PollFd::new(socket, events)];
        if wait_for(&mut waiting, self.limit(), self.stop)? {
            Ok(())
        } else {
            Err(Failure::Timeout)
        }
    }
}

/// Waits until one of `readers` can be read or one of `writers` written, at most `limit` seconds. Returns those that are ready.
pub fn select(
    readers: &[Socket],
    writers: &[Socket],
    limit: f64,
    stop: &AtomicBool,
) -> Result<(Vec<bool>, Vec<bool>), Failure> {
    let readers = readers
        .iter()
        .map(|socket| PollFd::new(socket, PollFlags::IN));
    let count = readers.len();
    let mut waiting: Vec<_> = readers
        .chain(
            writers
                .iter()
                .map(|socket| PollFd::new(socket, PollFlags::OUT)),
        )
        .collect();
    wait_for(&mut waiting, duration(limit), stop)?;
    let mut ready: Vec<bool> = waiting
        .iter()
        .map(|one| !one.revents().is_empty())
        .collect();
    let writable = ready.split_off(count);
    Ok((ready, writable))
}

/// Does nothing for that many seconds.
pub fn sleep(seconds: f64, stop: &AtomicBool) -> Result<(), Failure> {
    let limit = duration(seconds).unwrap_or_default();
    if limit.is_zero() {
        Ok(())
    } else {
        wait_for(&mut [], Some(limit), stop).map(drop)
    }
}

/// Whether one of them got ready in time.
fn wait_for(
    waiting: &mut [PollFd<'_>],
    limit: Option<Duration>,
    stop: &AtomicBool,
) -> Result<bool, Failure> {
    let began = now();
    loop {
        let left = limit.map(|limit| limit.saturating_sub(began.elapsed()));
        let stopping = stop.load(Ordering::Relaxed);
        let slice = if stopping {
            Duration::ZERO
        } else {
            left.unwrap_or(SLICE).min(SLICE)
        };
        match poll(waiting, Some(&timespec(slice))) {
            Ok(0) if left.is_some_and(|left| left <= slice) => return Ok(false),
            Ok(0) if stopping => return Err(Failure::Interrupted),
            Ok(0) | Err(Errno::INTR) => {}
            Ok(_) => return Ok(true),
            Err(error) => return Err(error.into()),
        }
    }
}

fn timespec(duration: Duration) -> Timespec {
    Timespec {
        tv_sec: duration.as_secs().cast_signed(),
        tv_nsec: duration.subsec_nanos().into(),
    }
}

/// None: without limit.
fn duration(seconds: f64) -> Option<Duration> {
    (seconds >= 0.0).then(|| Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX))
}

/// Timeouts are what scripts bring into a simulation from outside, like all that comes through a socket.
#[allow(
    clippy::disallowed_methods,
    reason = "timeouts of sockets are times of the wall clock"
)]
pub(super) fn now() -> Instant {
    Instant::now()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nobody_waits_for_a_simulator_that_is_being_stopped() {
        let stop = AtomicBool::new(true);
        assert_eq!(sleep(1e9, &stop), Err(Failure::Interrupted));
        assert_eq!(sleep(0.0, &stop), Ok(()));
        assert_eq!(select(&[], &[], 0.0, &stop), Ok((vec![], vec![])));
    }

    #[test]
    fn odd_limits_are_limits_or_none() {
        assert_eq!(duration(-1.0), None);
        assert_eq!(duration(f64::NAN), None);
        assert_eq!(duration(f64::INFINITY), Some(Duration::MAX));
    }
}
