//! Work on several threads.

use std::sync::Mutex;

/// Calls `work` once for each item, on up to `threads` threads. Who does which item is not determined; the items hold the results, in
/// their order.
pub fn for_each<T: Send>(threads: usize, items: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
    let threads = threads.min(items.len());
    if threads <= 1 {
        return items
            .iter_mut()
            .enumerate()
            .for_each(|(at, item)| work(at, item));
    }
    let queue = Mutex::new(items.iter_mut().enumerate());
    let run = || {
        while let Some((at, item)) = next(&queue) {
            work(at, item);
        }
    };
    std::thread::scope(|scope| {
        (1..threads).for_each(|_| drop(scope.spawn(run)));
        run();
    });
}

fn next<T>(queue: &Mutex<impl Iterator<Item = T>>) -> Option<T> {
    queue
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
        .next()
}
