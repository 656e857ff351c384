//! `swanilda test --watch`: tests run again when a file changes.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use notify::{Event, RecommendedWatcher, RecursiveMode, Watcher};

use super::super::interrupt::Interrupt;

/// Editors write a file in several steps; they are over after this time.
const DEBOUNCE: Duration = Duration::from_millis(100);
/// How often ctrl-c is looked at.
const TICK: Duration = Duration::from_millis(100);

/// Watches the folders of tests.
pub(super) struct Watch {
    events: Receiver<PathBuf>,
    _watcher: RecommendedWatcher,
}

impl Watch {
    /// Watches `paths`: of a file, the folder it is in.
    ///
    /// # Errors
    /// When the system cannot watch one.
    pub(super) fn new(paths: &[PathBuf]) -> notify::Result<Self> {
        let (sender, events) = mpsc::channel();
        let mut watcher = notify::recommended_watcher(move |event: notify::Result<Event>| {
            let Ok(event) = event else { return };
            let changes = !event.kind.is_access();
            event
                .paths
                .into_iter()
                .filter(|path| changes && matters(path))
                .for_each(|path| drop(sender.send(path)));
        })?;
        for path in paths {
            let folder = if path.is_dir() {
                path
            } else {
                path.parent().unwrap_or(path)
            };
            let folder = if folder == Path::new("") {
                Path::new(".")
            } else {
                folder
            };
            watcher.watch(folder, RecursiveMode::Recursive)?;
        }
        Ok(Self {
            events,
            _watcher: watcher,
        })
    }

    /// Waits for the next change and until all is quiet; None when the user wants an end.
    pub(super) fn next(&self, interrupt: &Interrupt) -> Option<PathBuf> {
        let changed = loop {
            if interrupt.is_requested() {
                return None;
            }
            match self.events.recv_timeout(TICK) {
                Ok(path) => break path,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return None,
            }
        };
        while self.events.recv_timeout(DEBOUNCE).is_ok() {}
        Some(changed)
    }
}

/// Whether a file is a source of tests, not an output of theirs.
fn matters(path: &Path) -> bool {
    path.extension().is_some_and(|extension| {
        ["lua", "ttt", "ttm", "xml"]
            .iter()
            .any(|known| extension == *known)
    })
}
