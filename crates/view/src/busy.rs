//! Pages are told of a script that does not end, by a thread that watches the simulation's.

use std::sync::Arc;

use super::server::Shared;
use io::SiteWaker;

/// Tells pages that the simulation's thread is busy, and whether one of them asks for the end of that. For other threads.
#[derive(Clone)]
pub struct BusySign {
    pub(super) shared: Arc<Shared>,
    pub(super) waker: SiteWaker,
}

impl BusySign {
    /// Shows a sentence about what runs, or nothing any more.
    pub fn show(&self, sentence: Option<String>) {
        if self.shared.set_busy(sentence) {
            self.waker.wake();
        }
    }

    /// Whether a page has asked for a stop since the simulation's thread answered last.
    pub fn stop_is_requested(&self) -> bool {
        self.shared.stop_is_requested()
    }

    /// Whether a page has a request to the debugger, for which code that runs has to be asked.
    pub fn wants_attention(&self) -> bool {
        self.shared.has_debug_requests()
    }

    /// Whether the thread waits for a person who answers a dialog.
    pub fn is_asking(&self) -> bool {
        self.shared.is_asking()
    }
}
