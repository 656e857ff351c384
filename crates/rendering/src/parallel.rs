//! Work on several threads.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use heap::{Handle, SharedHandle, outside};
use rayon_core::{ThreadPool, ThreadPoolBuilder};

/// Most often threads are not woken one after the other, since they came too late before.
const MAX_PAUSE: u32 = 63;

/// Threads that wait for work, besides the one that has it: to begin threads for each picture takes longer than a small picture does.
#[derive(Debug, Default)]
pub struct Workers {
    /// None where there is no other thread than the caller's, or where the system has no more.
    others: Option<&'static Helpers>,
}

/// Threads that help, and whether they come in time. On a busy machine the caller would wait for a processor for them when all is done already, which takes
/// longer than a picture: after a time in which none did anything it works alone for a while, longer each time.
#[derive(Debug)]
struct Helpers {
    pool: ThreadPool,
    /// How often the caller works alone from now on.
    left: AtomicU32,
    /// How often it did after they came too late last.
    pause: AtomicU32,
}

impl Helpers {
    /// Whether to wake them.
    fn are_wanted(&self) -> bool {
        let less = |left: u32| left.checked_sub(1);
        let (set, read) = (Ordering::Relaxed, Ordering::Relaxed);
        self.left.fetch_update(set, read, less).is_err()
    }

    /// Notes whether they did anything.
    fn note(&self, have_helped: bool) {
        let before = self.pause.load(Ordering::Relaxed);
        let pause = if have_helped {
            0
        } else {
            (2 * before + 1).min(MAX_PAUSE)
        };
        self.pause.store(pause, Ordering::Relaxed);
        self.left.store(pause, Ordering::Relaxed);
    }
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
            .map_or(0, |others| others.pool.current_num_threads())
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
            let mut has_worked = false;
            while let Some((at, item)) = next(&queue) {
                work(at, item);
                has_worked = true;
            }
            has_worked
        };
        let are_wanted = |others: &&Helpers| helpers > 0 && others.are_wanted();
        let Some(others) = self.others.filter(are_wanted) else {
            run();
            return;
        };
        let heap = Handle::current();
        let shared = heap.map(Handle::shared);
        let run_inside = || {
            let _entered = shared.map(SharedHandle::entered);
            run()
        };
        let have_helped = AtomicBool::new(false);
        let help = || have_helped.fetch_or(run_inside(), Ordering::Relaxed);
        outside(|| {
            others.pool.in_place_scope(|scope| {
                (0..helpers).for_each(|_| {
                    scope.spawn(|_| {
                        help();
                    });
                });
                run_inside();
            });
        });
        others.note(have_helped.into_inner());
    }
}

/// The threads of the process that draw, so many: they are no part of a simulator.
fn pool(threads: usize) -> Option<&'static Helpers> {
    static POOLS: Mutex<BTreeMap<(u32, usize), &'static Helpers>> = Mutex::new(BTreeMap::new());
    outside(|| {
        // A process that was forked off has none of the threads.
        let place = (std::process::id(), threads);
        let mut pools = POOLS.lock().ok()?;
        if let Some(pool) = pools.get(&place) {
            return Some(*pool);
        }
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().ok()?;
        let helpers: &'static Helpers = Box::leak(Box::new(Helpers {
            pool,
            left: AtomicU32::new(0),
            pause: AtomicU32::new(0),
        }));
        pools.insert(place, helpers);
        Some(helpers)
    })
}

fn next<T>(queue: &Mutex<impl Iterator<Item = T>>) -> Option<T> {
    queue
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
        .next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_that_come_too_late_are_left_alone_for_a_while() {
        let helpers = Helpers {
            pool: ThreadPoolBuilder::new()
                .num_threads(1)
                .build()
                .expect("a thread"),
            left: AtomicU32::new(0),
            pause: AtomicU32::new(0),
        };
        let mut pauses = Vec::new();
        for _ in 0..8 {
            helpers.note(false);
            pauses.push((0..).take_while(|_| !helpers.are_wanted()).count());
        }
        assert_eq!(pauses, [1, 3, 7, 15, 31, 63, 63, 63]);
        helpers.note(true);
        assert!(helpers.are_wanted() && helpers.are_wanted());
    }

    #[test]
    fn each_item_is_done_once() {
        for threads in 1..4 {
            let workers = Workers::new(threads);
            for _ in 0..50 {
                let mut items = [0; 40];
                workers.for_each(&mut items, 1, |at, item| *item += at + 1);
                assert!(items.iter().enumerate().all(|(at, item)| *item == at + 1));
            }
        }
    }
}
