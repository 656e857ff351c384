//! Messages that wait: the newest stay.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::limits;

/// Messages between two threads.
pub(crate) struct Inbox<M> {
    waiting: Mutex<Waiting<M>>,
    changed: Condvar,
}

struct Waiting<M> {
    messages: VecDeque<M>,
    bytes: usize,
    capacity: usize,
    is_closed: bool,
    /// Why nothing comes from someone, until it is asked for.
    problem: Option<String>,
}

/// What a wait ends with.
pub(crate) enum Arrival<M> {
    Message(M),
    /// Nothing in time.
    Nothing,
    /// Nothing any more.
    Closed,
}

impl<M: AsRef<[u8]>> Inbox<M> {
    /// For that many messages; 0 is as many as there may be at all.
    pub(crate) fn new(capacity: usize) -> Self {
        let waiting = Waiting {
            messages: VecDeque::new(),
            bytes: 0,
            capacity: bounded(capacity),
            is_closed: false,
            problem: None,
        };
        Self {
            waiting: Mutex::new(waiting),
            changed: Condvar::new(),
        }
    }

    fn waiting(&self) -> MutexGuard<'_, Waiting<M>> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds a message. The oldest leave if there are too many.
    pub(crate) fn push(&self, message: M) {
        let mut waiting = self.waiting();
        if waiting.is_closed {
            return;
        }
        waiting.bytes += message.as_ref().len();
        waiting.messages.push_back(message);
        while waiting.messages.len() > waiting.capacity
            || (waiting.bytes > limits::WAITING && waiting.messages.len() > 1)
        {
            let _oldest = waiting.pop();
        }
        self.changed.notify_one();
    }

    /// The oldest message.
    pub(crate) fn take(&self) -> Option<M> {
        self.waiting().pop()
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.waiting().messages.len()
    }

    /// The oldest message, as soon as there is one.
    pub(crate) fn wait(&self, timeout: Duration) -> Arrival<M> {
        let is_idle = |waiting: &mut Waiting<M>| waiting.messages.is_empty() && !waiting.is_closed;
        let waited = self
            .changed
            .wait_timeout_while(self.waiting(), timeout, is_idle);
        let (mut waiting, _) = waited.unwrap_or_else(PoisonError::into_inner);
        match waiting.pop() {
            Some(message) => Arrival::Message(message),
            None if waiting.is_closed => Arrival::Closed,
            None => Arrival::Nothing,
        }
    }

    /// At least for that many messages.
    pub(crate) fn widen(&self, capacity: usize) {
        let mut waiting = self.waiting();
        waiting.capacity = waiting.capacity.max(bounded(capacity));
    }

    /// Ends waits, and takes nothing more.
    pub(crate) fn close(&self) {
        let mut waiting = self.waiting();
        waiting.is_closed = true;
        waiting.messages.clear();
        waiting.bytes = 0;
        self.changed.notify_all();
    }

    pub(crate) fn note_problem(&self, problem: String) {
        self.waiting().problem = Some(problem);
    }

    pub(crate) fn take_problem(&self) -> Option<String> {
        self.waiting().problem.take()
    }
}

impl<M: AsRef<[u8]>> Waiting<M> {
    fn pop(&mut self) -> Option<M> {
        let message = self.messages.pop_front()?;
        self.bytes -= message.as_ref().len();
        Some(message)
    }
}

fn bounded(capacity: usize) -> usize {
    if capacity == 0 {
        limits::QUEUE
    } else {
        capacity.min(limits::QUEUE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_stay() {
        let inbox = Inbox::new(2);
        (0..5_u8).for_each(|n| inbox.push(vec![n]));
        assert_eq!(
            (inbox.len(), inbox.take(), inbox.take(), inbox.take()),
            (2, Some(vec![3]), Some(vec![4]), None)
        );
        let large = Inbox::new(0);
        (0..3).for_each(|n: u8| large.push(vec![n; limits::WAITING / 2 + 1]));
        assert_eq!(large.len(), 1);
        large.push(vec![9; limits::WAITING + 1]);
        assert_eq!(large.take().map(|message| message[0]), Some(9));
    }

    #[test]
    fn a_closed_inbox_ends_waits() {
        let inbox = Inbox::new(1);
        assert!(matches!(
            inbox.wait(Duration::from_millis(1)),
            Arrival::Nothing
        ));
        inbox.push(vec![1]);
        assert!(matches!(
            inbox.wait(Duration::from_secs(1)),
            Arrival::Message(_)
        ));
        inbox.close();
        inbox.push(vec![1]);
        assert!(matches!(
            inbox.wait(Duration::from_secs(100)),
            Arrival::Closed
        ));
    }
}
