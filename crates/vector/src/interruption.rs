//! The end of work that takes too long, such as by ctrl-c: between two steps of a world, or in the middle of its scripts.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::time::Duration;

use crate::worker::Worker;

/// Asked while worlds are made, begin or step, twenty times a second, whether they are to stop. Then those that are not ready fail.
pub type WantsEnd = Box<dyn FnMut() -> bool + Send>;

/// Time between two questions.
const INTERVAL: Duration = Duration::from_millis(50);
/// Questions until scripts that go on are interrupted in the middle of what they do: a step that ends by itself is let end.
const GRACE_INTERVALS: u32 = 5;

/// Whether the worlds of all threads are to stop. Cheap to clone.
#[derive(Clone, Default)]
pub(crate) struct StopSign(Arc<AtomicBool>);

impl StopSign {
    /// # Errors
    /// When the world is to stop.
    pub(crate) fn check(&self) -> Result<(), String> {
        match self.0.load(Relaxed) {
            true => Err("it was interrupted.".to_owned()),
            false => Ok(()),
        }
    }
}

/// Waits for the answers of all workers, which `receive` waits for a while for. Where somebody wants an end, they stop before.
pub(crate) fn gather<T>(
    workers: &[Worker],
    stop: &StopSign,
    wants_end: &mut WantsEnd,
    receive: impl Fn(&Worker, Duration) -> Option<T>,
) -> Vec<T> {
    let mut intervals = 0;
    let mut answer = |worker: &Worker| loop {
        if let Some(answer) = receive(worker, INTERVAL) {
            return answer;
        }
        if intervals > 0 || wants_end() {
            stop.0.store(true, Relaxed);
            intervals += 1;
        }
        if intervals > GRACE_INTERVALS {
            workers.iter().for_each(Worker::interrupt_script);
        }
    };
    let answers = workers.iter().map(&mut answer).collect();
    stop.0.store(false, Relaxed);
    answers
}
