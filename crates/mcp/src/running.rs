//! The call that runs, which a client may cancel.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::Value;

use super::message::{Fault, Message};

/// Requests that are remembered as cancelled before their turn.
const MAX_CANCELLED: usize = 1000;

/// Says which request is being answered, and ends it on request. Shared by the threads of a server.
#[derive(Debug, Clone, Default)]
pub struct Running {
    state: Arc<Mutex<State>>,
    stop: Arc<AtomicBool>,
}

#[derive(Debug, Default)]
struct State {
    now: Option<String>,
    cancelled: BTreeSet<String>,
}

impl Running {
    /// Cancelling sets `stop`, which ends what the service does.
    pub fn new(stop: Arc<AtomicBool>) -> Self {
        Self {
            stop,
            ..Self::default()
        }
    }

    fn with<T>(&self, work: impl FnOnce(&mut State) -> T) -> T {
        work(&mut self.state.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Notices a cancellation among messages of the client `from`, as soon as they are there.
    pub(crate) fn handle_cancellations(&self, from: &str, messages: &[Result<Message, Fault>]) {
        for message in messages.iter().flatten() {
            if let Message::Notification { method, params } = message
                && method == "notifications/cancelled"
            {
                self.cancel(key(from, &params["requestId"]));
            }
        }
    }

    fn cancel(&self, key: String) {
        self.with(|state| {
            if state.now.as_ref() == Some(&key) {
                self.stop.store(true, Ordering::Relaxed);
            }
            // Most of them were answered long ago.
            if state.cancelled.len() >= MAX_CANCELLED {
                state.cancelled.clear();
            }
            state.cancelled.insert(key);
        });
    }

    /// Whether a request is to be answered now; it can be cancelled from here on.
    pub(crate) fn begin(&self, from: &str, messages: &[Result<Message, Fault>]) -> bool {
        let [Ok(Message::Request { id, .. })] = messages else {
            return true;
        };
        let key = key(from, id);
        self.with(|state| {
            self.stop.store(false, Ordering::Relaxed);
            let is_wanted = !state.cancelled.remove(&key);
            state.now = is_wanted.then_some(key);
            is_wanted
        })
    }

    /// The request was answered; whether somebody still waits for the answer.
    pub(crate) fn end(&self) -> bool {
        self.with(|state| {
            let now = state.now.take();
            !now.is_some_and(|key| state.cancelled.remove(&key))
        })
    }
}

fn key(from: &str, id: &Value) -> String {
    format!("{from} {id}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::message::parse;

    fn messages(text: &str) -> Vec<Result<Message, Fault>> {
        parse(text.as_bytes()).expect("a message")
    }

    fn cancel(id: &str) -> Vec<Result<Message, Fault>> {
        messages(&format!(
            r#"{{"jsonrpc":"2.0","method":"notifications/cancelled","params":{{"requestId":{id}}}}}"#
        ))
    }

    const CALL: &str = r#"{"jsonrpc":"2.0","id":7,"method":"tools/call"}"#;

    #[test]
    fn a_running_call_is_stopped_and_nobody_waits_for_it() {
        let stop = Arc::<AtomicBool>::default();
        let running = Running::new(Arc::clone(&stop));
        assert!(running.begin("", &messages(CALL)));
        running.handle_cancellations("", &cancel("8"));
        running.handle_cancellations("another", &cancel("7"));
        assert!(!stop.load(Ordering::Relaxed));
        running.handle_cancellations("", &cancel("7"));
        assert!(stop.load(Ordering::Relaxed));
        assert!(!running.end());
    }

    #[test]
    fn a_call_that_was_cancelled_before_its_turn_does_not_begin() {
        let running = Running::default();
        running.handle_cancellations("", &cancel("7"));
        assert!(!running.begin("", &messages(CALL)));
        assert!(running.end());
        assert!(running.begin("", &messages(CALL)), "ids may come again");
    }
}
