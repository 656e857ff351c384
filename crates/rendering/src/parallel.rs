//! Work on several threads.

use std::collections::BTreeMap;
use std::sync::Mutex;

use heap::{Handle, SharedHandle, outside};
use rayon_core::{ThreadPool, ThreadPoolBuilder};

/// Threads that wait for work, besides the one that has it: to begin threads for each picture takes longer than a small picture does.
#[derive(Debug, Default)]
pub struct Workers {
    /// None where there is no other thread than the caller's, or where the system has no more.
    others: Option<&'static ThreadPool>,
}

impl Workers {
    /// Up to `threads` threads, the caller's among them.
    pub fn new(threads: usize) -> Self {
        Self {
            others: (threads > 1).then(|| pool(threads - 1)).flatten(),
        }
    }

    /// How many threads there are.
    pub fn count(&self) -> usize {
        1 + self
            .others
            .as_ref()
            .map_or(0, |others| others.current_num_threads())
    }

    /// Calls `work` once for each item. Who does which item is not determined; the items hold the results, in their order. A thread
    /// that would have less than `least` of them is not woken: to wake it takes longer than that work.
    pub fn for_each<T: Send>(
        &self,
        items: &mut [T],
        least: usize,
        work: impl Fn(usize, &mut T) + Sync,
    ) {
        let threads = (items.len() / least).min(self.count());
        let helpers = threads.saturating_sub(1);
        let queue = Mutex::new(items.iter_mut().enumerate());
        let run = || {
            while let Some((at, item)) = next(&queue) {
                work(at, item);
            }
        };
        let Some(others) = self.others.filter(|_| helpers > 0) else {
            return run();
        };
        let heap = Handle::current();
        let shared = heap.map(Handle::shared);
        let run_inside = || {
            let _entered = shared.map(SharedHandle::entered);
            run();
        };
        outside(|| {
            others.in_place_scope(|scope| {
                (0..helpers).for_each(|_| scope.spawn(|_| run_inside()));
                run_inside();
            });
        });
    }
}

/// The threads of the process that draw, so many: they are no part of a simulator.
fn pool(threads: usize) -> Option<&'static ThreadPool> {
    static POOLS: Mutex<BTreeMap<(u32, usize), &'static ThreadPool>> = Mutex::new(BTreeMap::new());
    outside(|| {
        // A process that was forked off has none of the threads.
        let place = (std::process::id(), threads);
        let mut pools = POOLS.lock().ok()?;
        if let Some(pool) = pools.get(&place) {
            return Some(*pool);
        }
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().ok()?;
        let pool: &'static ThreadPool = Box::leak(Box::new(pool));
        pools.insert(place, pool);
        Some(pool)
    })
}

fn next<T>(queue: &Mutex<impl Iterator<Item = T>>) -> Option<T> {
    queue
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
        .next()
}
