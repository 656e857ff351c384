//! Output of scripts and the simulator: levels, consoles, error count.

pub(crate) mod auxiliary_consoles;
pub(crate) mod console;
mod located;
pub(crate) mod missed;
mod recent;
pub mod status;
pub(crate) mod suggestion;
pub mod verbosity;

use std::cell::{Cell, RefCell};
use std::collections::HashSet;

use heap::Outer;

use console::{Console, LogLine, OutputStream};
use located::ScriptFiles;
use missed::Missed;
use recent::Recent;
pub use recent::RecentLine;
use twox_hash::XxHash3_64;

/// The way to the console of one simulator.
pub struct Log {
    console: RefCell<Outer<Box<dyn Console>>>,
    verbosity: Cell<i64>,
    /// Origin, level and text of the lines that are to be logged only once.
    logged_once: RefCell<HashSet<(String, i64, String)>>,
    /// Uncaught script errors.
    errors: Cell<u64>,
    pub(super) files: RefCell<ScriptFiles>,
    /// The path that the last look-up of an object did not find.
    missed: RefCell<Option<Missed>>,
    recent: RefCell<Recent>,
    /// The hash of all lines so far; None where nobody compares it.
    hash: Cell<Option<u64>>,
}

impl Log {
    pub(super) fn new(console: Box<dyn Console>, verbosity: i64) -> Self {
        Self {
            console: RefCell::new(Outer::new(console)),
            verbosity: Cell::new(verbosity),
            logged_once: RefCell::default(),
            errors: Cell::new(0),
            files: RefCell::default(),
            missed: RefCell::default(),
            recent: RefCell::default(),
            hash: Cell::new(None),
        }
    }

    /// Keeps a hash of all lines from now on.
    pub(crate) fn keep_hash(&self) {
        self.hash.set(Some(0));
    }

    /// The hash of all lines since then; 0 without one.
    pub(crate) fn hash(&self) -> u64 {
        self.hash.get().unwrap_or_default()
    }

    fn add_to_hash(&self, line: &[u8]) {
        let hash = self.hash.get();
        let next = hash.map(|hash| XxHash3_64::oneshot_with_seed(hash, line));
        self.hash.set(next);
    }

    /// Lines above this level are not shown.
    pub(crate) fn verbosity(&self) -> i64 {
        self.verbosity.get()
    }

    pub(super) fn set_verbosity(&self, level: i64) {
        self.verbosity.set(level);
    }

    /// Number of uncaught script errors.
    pub fn errors(&self) -> u64 {
        self.errors.get()
    }

    pub(super) fn count_error(&self) {
        self.errors.set(self.errors.get() + 1);
    }

    /// Remembers a path that leads to no object, for the error that may come of it.
    pub(super) fn note_missing_path(&self, path: &str) {
        self.missed.replace(Some(Missed::Object(path.to_owned())));
    }

    /// Remembers the name of a scene or model of which there is no file.
    pub(super) fn note_missing_file(&self, name: &str) {
        self.missed.replace(Some(Missed::File(name.to_owned())));
    }

    /// Remembers which argument of a call is nil, missing or no table.
    pub(super) fn note_wrong_argument(&self, function: &str, wrong: String) {
        let function = function.to_owned();
        self.missed
            .replace(Some(Missed::Argument { function, wrong }));
    }

    /// What the last look-up did not find; it is forgotten.
    pub(super) fn take_missed(&self) -> Option<Missed> {
        self.missed.take()
    }

    /// Whether this is the first such line; it is remembered.
    pub(super) fn is_first(&self, origin: &str, level: i64, text: &str) -> bool {
        self.logged_once
            .borrow_mut()
            .insert((origin.to_owned(), level, text.to_owned()))
    }

    /// Shows a line, unless the verbosity is below its level; `script` is the handle of the script it comes from.
    pub(super) fn show(&self, line: &LogLine<'_>, script: Option<i64>) {
        if verbosity::plain(line.level) <= self.verbosity() {
            self.add_to_hash(line.text.as_bytes());
            self.recent
                .borrow_mut()
                .push(|| RecentLine::of_log(line, script));
            self.console
                .borrow_mut()
                .with_mut(|console| console.log(line));
        }
    }

    /// One call of a script's `print` at that simulated time, seconds. `origin` names the script if that is asked for.
    pub(crate) fn print(
        &self,
        line: &[u8],
        time: f64,
        script: i64,
        origin: impl FnOnce() -> String,
    ) {
        self.add_to_hash(line);
        self.recent.borrow_mut().push(|| RecentLine {
            time,
            level: None,
            origin: origin(),
            script: Some(script),
            text: String::from_utf8_lossy(line).into_owned(),
            located: None,
        });
        self.console
            .borrow_mut()
            .with_mut(|console| console.print(line, time));
    }

    /// Keeps lines from now on, for [`take_recent`](Self::take_recent).
    pub fn keep_recent(&self) {
        self.recent.borrow_mut().begin();
    }

    /// The lines after the first `seen` of all, which become all.
    pub(crate) fn recent_since(&self, seen: &mut u64) -> Vec<RecentLine> {
        self.recent.borrow().since(seen)
    }

    /// The lines since the last call, with the scripts they come from.
    pub fn take_recent(&self) -> Vec<RecentLine> {
        self.recent.borrow_mut().take()
    }

    /// A script could not write, since nobody reads the pipe.
    pub(super) fn pipe_closed(&self) {
        self.console
            .borrow_mut()
            .with_mut(|console| console.pipe_closed());
    }

    /// Output of a script to a stream of the process.
    pub(super) fn write(&self, text: &[u8], stream: OutputStream, time: f64) {
        self.add_to_hash(text);
        self.console
            .borrow_mut()
            .with_mut(|console| console.write(text, stream, time));
    }
}
