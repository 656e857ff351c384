//! Threads that work on parts of a list at the same time. Who works on what does not show in the results: the items do not know each other,
//! and come back in their order.

use std::cell::RefCell;
use std::num::NonZero;
use std::sync::mpsc::{Receiver, Sender, channel};

use heap::{Handle, SharedHandle, outside};

/// How often a thread polls its channel before it blocks: waking up takes as long as the work of some mechanisms.
const SPIN_ITERATIONS: usize = 4000;

type Job = Box<dyn FnOnce() + Send>;

thread_local! {
    /// The threads that work for this one: they are no part of a simulator, so that what it is does not depend on them.
    ///
    /// With their process: one that was forked off has none of them.
    static OTHERS: RefCell<(u32, Vec<Sender<Job>>)> = const { RefCell::new((0, Vec::new())) };
}

/// How many threads work, with the one that calls. They are started when they are needed first.
pub(crate) struct Workers {
    count: usize,
}

impl Default for Workers {
    fn default() -> Self {
        Self::new(NonZero::<usize>::MIN)
    }
}

impl Workers {
    pub(crate) fn new(count: NonZero<usize>) -> Self {
        Self { count: count.get() }
    }

    /// Calls `work` for each item.
    pub(super) fn for_each<T: Send + 'static>(
        &mut self,
        mut items: Vec<T>,
        work: fn(&mut T),
    ) -> Vec<T> {
        let share = items.len().div_ceil(self.count).max(1);
        let mut rest = items.split_off(share.min(items.len()));
        let heap = (!rest.is_empty()).then(Handle::current).flatten();
        let heap = heap.map(Handle::shared);
        let mut pending = Vec::new();
        while !rest.is_empty() {
            let next = rest.split_off(share.min(rest.len()));
            let next = std::mem::replace(&mut rest, next);
            let thread = pending.len();
            pending.push(outside(|| start(thread, next, work, heap)));
        }
        items.iter_mut().for_each(work);
        for results in pending {
            let more = outside(|| receive(&results).expect("a thread ends after its work"));
            outside(|| drop(results));
            items.extend(more);
        }
        items
    }
}

/// Lets another thread work, in the memory of the simulator that waits for it.
fn start<T: Send + 'static>(
    thread: usize,
    mut items: Vec<T>,
    work: fn(&mut T),
    heap: Option<SharedHandle>,
) -> Receiver<Vec<T>> {
    let (results, receiver) = channel();
    let job = move || {
        {
            let _entered = heap.map(SharedHandle::entered);
            items.iter_mut().for_each(work);
        }
        // Nobody waits for it after a panic of the calling thread.
        let _ = results.send(items);
    };
    OTHERS.with_borrow_mut(|(process, others)| {
        if *process != std::process::id() {
            *process = std::process::id();
            others.clear();
        }
        if thread == others.len() {
            let (jobs, received) = channel();
            std::thread::spawn(move || run(&received));
            others.push(jobs);
        }
        let sent = others[thread].send(Box::new(job));
        sent.expect("a thread ends with the one it works for");
    });
    receiver
}

/// Does what comes until nobody can send more.
fn run(jobs: &Receiver<Job>) {
    while let Some(job) = receive(jobs) {
        job();
    }
}

/// Waits for a message; None when nobody can send one any more.
fn receive<T>(messages: &Receiver<T>) -> Option<T> {
    let ready = (0..SPIN_ITERATIONS).find_map(|_| {
        messages
            .try_recv()
            .inspect_err(|_| std::thread::yield_now())
            .ok()
    });
    ready.or_else(|| messages.recv().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_come_back_in_their_order() {
        for count in 1..6 {
            let mut workers = Workers::new(NonZero::new(count).expect("from one"));
            for length in 0..20 {
                let doubled =
                    workers.for_each((0..length).collect(), |item: &mut usize| *item *= 2);
                assert_eq!(
                    doubled,
                    (0..length).map(|item| item * 2).collect::<Vec<_>>()
                );
            }
        }
    }
}
