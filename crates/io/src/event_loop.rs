//! The event loop all sockets of a simulator live on.
//!
//! It runs on the simulator's own thread, only during calls of `turn` and `wait`. What has arrived is in
//! inboxes until it is fetched.

use std::future::Future;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use tokio::runtime::Runtime;
use tokio::sync::{Notify, mpsc};
use tokio::task::AbortHandle;

/// How many tasks run before the system's sockets are looked at again.
const TASKS_PER_POLL: u32 = 1024;

/// How often the sockets are looked at before the thread goes to sleep: a client that calls again and again sends its next request
/// within that time, and waking up takes longer than most requests.
const POLLS: usize = 40;

/// The event loop of one simulator.
pub struct EventLoop {
    /// None only while it is dropped.
    runtime: Option<Runtime>,
    waiting: Arc<Waiting>,
}

/// Data in all inboxes that has not been fetched yet.
#[derive(Default)]
struct Waiting {
    count: AtomicUsize,
    more: Notify,
}

impl EventLoop {
    /// # Errors
    /// When the system has no event queue.
    pub fn new() -> io::Result<Self> {
        let mut builder = tokio::runtime::Builder::new_current_thread();
        let runtime = builder
            .enable_io()
            .enable_time()
            .event_interval(TASKS_PER_POLL)
            .build()?;
        Ok(Self {
            runtime: Some(runtime),
            waiting: Arc::default(),
        })
    }

    fn runtime(&self) -> &Runtime {
        self.runtime
            .as_ref()
            .expect("it is there until it is dropped")
    }

    /// Moves the sockets without waiting for anything.
    pub fn turn(&self) {
        self.block_on(async {
            // First the system reports which sockets are ready, then their tasks run.
            tokio::task::yield_now().await;
            tokio::task::yield_now().await;
        });
    }

    /// Moves the sockets until there is something to fetch, at most that long.
    pub fn wait(&self, timeout: Duration) {
        let something = async {
            while self.waiting.count.load(Ordering::Relaxed) == 0 {
                self.waiting.more.notified().await;
            }
        };
        // After a timeout the caller continues with its other work.
        let _ = self.block_on(async { tokio::time::timeout(timeout, something).await });
    }

    /// The amount of data that has not been fetched yet.
    pub(super) fn arrivals(&self) -> usize {
        self.waiting.count.load(Ordering::Relaxed)
    }

    /// The next item of an inbox; waits for it up to a time limit.
    pub(super) fn fetch<T>(&self, inbox: &mut Inbox<T>, timeout: Duration) -> Option<T> {
        let there = inbox.fetch();
        if there.is_some() {
            return there;
        }
        // A timer would take up to a millisecond.
        let polls = if timeout.is_zero() { 1 } else { POLLS };
        for _ in 0..polls {
            self.turn();
            let there = inbox.fetch();
            if there.is_some() || timeout.is_zero() {
                return there;
            }
        }
        self.block_on(async {
            tokio::time::timeout(timeout, inbox.next())
                .await
                .ok()
                .flatten()
        })
    }

    /// Moves the sockets until `future` is done.
    pub(super) fn block_on<F: Future>(&self, future: F) -> F::Output {
        self.runtime().block_on(future)
    }

    /// A [`Waker`] for another thread, which ends waits.
    pub(super) fn waker(&self) -> Waker {
        Waker {
            waiting: self.waiting.clone(),
            is_set: AtomicBool::new(false),
        }
    }

    /// Runs a task until it ends or what is returned is dropped.
    pub(super) fn spawn(&self, task: impl Future<Output = ()> + Send + 'static) -> Task {
        Task(self.runtime().spawn(task).abort_handle())
    }

    /// An inbox for at most `capacity` arrivals. Who delivers more waits.
    pub(super) fn inbox<T>(&self, capacity: usize) -> (Deliver<T>, Inbox<T>) {
        let (sender, receiver) = mpsc::channel(capacity);
        (
            Deliver {
                sender,
                waiting: self.waiting.clone(),
            },
            Inbox {
                receiver,
                waiting: self.waiting.clone(),
            },
        )
    }
}

impl Drop for EventLoop {
    fn drop(&mut self) {
        if let Some(runtime) = self.runtime.take() {
            // A look-up of a name may be under way on another thread: it is not waited for.
            runtime.shutdown_background();
        }
    }
}

/// A running task; it ends when this is dropped.
pub(super) struct Task(AbortHandle);

impl Drop for Task {
    fn drop(&mut self) {
        self.0.abort();
    }
}

/// Ends waits of an event loop from another thread, until the simulator has looked at what there is.
pub(super) struct Waker {
    waiting: Arc<Waiting>,
    is_set: AtomicBool,
}

impl Waker {
    /// There is something to look at.
    pub(super) fn wake(&self) {
        if !self.is_set.swap(true, Ordering::AcqRel) {
            self.waiting.count.fetch_add(1, Ordering::Relaxed);
            self.waiting.more.notify_one();
        }
    }

    /// The simulator has looked at everything: the next [`wake`](Self::wake) ends a wait again.
    pub(super) fn reset(&self) {
        if self.is_set.swap(false, Ordering::AcqRel) {
            self.waiting.count.fetch_sub(1, Ordering::Relaxed);
        }
    }
}

impl Drop for Waker {
    fn drop(&mut self) {
        self.reset();
    }
}

/// The side of an inbox where things arrive.
pub(super) struct Deliver<T> {
    sender: mpsc::Sender<T>,
    waiting: Arc<Waiting>,
}

impl<T> Clone for Deliver<T> {
    fn clone(&self) -> Self {
        Self {
            sender: self.sender.clone(),
            waiting: self.waiting.clone(),
        }
    }
}

impl<T> Deliver<T> {
    /// Waits for room. Dropped when the receiver is gone.
    pub(super) async fn deliver(&self, arrival: T) {
        if let Ok(room) = self.sender.reserve().await {
            self.waiting.count.fetch_add(1, Ordering::Relaxed);
            room.send(arrival);
            self.waiting.more.notify_one();
        }
    }
}

/// The side of an inbox where the simulator fetches.
pub(super) struct Inbox<T> {
    receiver: mpsc::Receiver<T>,
    waiting: Arc<Waiting>,
}

impl<T> Inbox<T> {
    /// The next item, if there is one.
    pub(super) fn fetch(&mut self) -> Option<T> {
        let arrival = self.receiver.try_recv().ok()?;
        self.waiting.count.fetch_sub(1, Ordering::Relaxed);
        Some(arrival)
    }

    /// How many arrivals there are.
    pub(super) fn len(&self) -> usize {
        self.receiver.len()
    }

    async fn next(&mut self) -> Option<T> {
        let arrival = self.receiver.recv().await?;
        self.waiting.count.fetch_sub(1, Ordering::Relaxed);
        Some(arrival)
    }
}

impl<T> Drop for Inbox<T> {
    fn drop(&mut self) {
        self.receiver.close();
        while self.fetch().is_some() {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waits_for_what_arrives_and_not_for_what_was_fetched() {
        let event_loop = EventLoop::new().expect("an event loop");
        let (deliver, mut inbox) = event_loop.inbox(1);
        let _task = event_loop.spawn(async move {
            deliver.deliver(1).await;
            deliver.deliver(2).await;
        });
        event_loop.wait(Duration::from_secs(10));
        assert_eq!((inbox.fetch(), inbox.fetch()), (Some(1), None));
        event_loop.wait(Duration::from_secs(10));
        assert_eq!(event_loop.waiting.count.load(Ordering::Relaxed), 1);
        drop(inbox);
        assert_eq!(event_loop.waiting.count.load(Ordering::Relaxed), 0);
        event_loop.wait(Duration::from_millis(1));
    }

    #[test]
    fn a_waker_of_another_thread_ends_a_wait() {
        let event_loop = EventLoop::new().expect("an event loop");
        let waker = Arc::new(event_loop.waker());
        let waking = waker.clone();
        let thread = std::thread::spawn(move || waking.wake());
        event_loop.wait(Duration::from_secs(10));
        thread.join().expect("it does not panic");
        waker.wake();
        assert_eq!(event_loop.waiting.count.load(Ordering::Relaxed), 1);
        waker.reset();
        assert_eq!(event_loop.waiting.count.load(Ordering::Relaxed), 0);
    }

    #[test]
    fn a_task_ends_with_its_handle() {
        let event_loop = EventLoop::new().expect("an event loop");
        let alive = Arc::new(());
        let held = alive.clone();
        let task = event_loop.spawn(async move {
            std::future::pending::<()>().await;
            drop(held);
        });
        event_loop.turn();
        drop(task);
        event_loop.turn();
        assert_eq!(Arc::strong_count(&alive), 1);
    }
}
