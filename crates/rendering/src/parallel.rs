//! Work on several threads.

use std::sync::Mutex;

use rayon_core::{ThreadPool, ThreadPoolBuilder};

/// Threads that wait for work, besides the one that has it: to begin threads for each picture takes longer than a small picture does.
#[derive(Debug, Default)]
pub struct Workers {
    /// None where there is no other thread than the caller's, or where the system has no more.
    others: Option<ThreadPool>,
}

impl Workers {
    /// Up to `threads` threads, the caller's among them.
    pub fn new(threads: usize) -> Self {
        let others = || ThreadPoolBuilder::new().num_threads(threads - 1).build();
        Self {
            others: (threads > 1).then(others).and_then(Result::ok),
        }
    }

    /// How many threads there are.
    pub fn count(&self) -> usize {
        1 + self
            .others
            .as_ref()
            .map_or(0, ThreadPool::current_num_threads)
    }

    /// Calls `work` once for each item. Who does which item is not determined; the items hold the results, in their order.
    pub fn for_each<T: Send>(&self, items: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
        let helpers = items.len().min(self.count()).saturating_sub(1);
        let queue = Mutex::new(items.iter_mut().enumerate());
        let run = || {
            while let Some((at, item)) = next(&queue) {
                work(at, item);
            }
        };
        let Some(others) = self.others.as_ref().filter(|_| helpers > 0) else {
            return run();
        };
        others.in_place_scope(|scope| {
            (0..helpers).for_each(|_| scope.spawn(|_| run()));
            run();
        });
    }
}

fn next<T>(queue: &Mutex<impl Iterator<Item = T>>) -> Option<T> {
    queue
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
        .next()
}
