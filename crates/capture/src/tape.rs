//! The tape of a simulator: off, capturing or replaying.

use std::fmt;
use std::io;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use heap::outside;

use crate::reader::{CaptureError, Reader};
use crate::record::{Header, Record};
use crate::state::{Capturing, Replaying};
use crate::value::Recorded;

/// Through which everything comes from outside. Cheap to clone; all clones are the same tape. One that is off costs a branch.
///
/// What is asked for within an input (a file that a function reads, whose result is the input) is part of it and not an input of its own.
#[derive(Clone, Default)]
pub struct Tape(
    #[expect(clippy::redundant_allocation, reason = "see `counted_apart`")]
    Option<Arc<Arc<Mutex<State>>>>,
);

struct State {
    mode: Mode,
    /// Inputs that are being read.
    depth: usize,
    /// Code runs that is not part of the run: the capture has nothing for it.
    is_suspended: bool,
    on_end: Option<OnEnd>,
    on_lack: Option<OnLack>,
}

enum Mode {
    Capturing(Capturing),
    Replaying(Replaying),
    /// What was replayed has gone on live.
    Off,
}

/// Called when a replay cannot go on.
type OnEnd = Box<dyn FnMut(&Verdict) + Send>;

/// Called when a capture lacks something, in words.
type OnLack = Box<dyn FnMut(&str) + Send>;

/// The capture has no such input: the replay is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the run differs from its capture")]
pub struct Lost;

impl From<Lost> for io::Error {
    fn from(lost: Lost) -> Self {
        Self::other(lost)
    }
}

/// How a replay has ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// As the capture says, to the end.
    Same {
        /// Steps that were compared.
        steps: u64,
    },
    /// The same until the capture ended, whose process did not end by itself.
    Cut {
        /// Steps that were compared.
        steps: u64,
    },
    /// Something else happened than in the capture.
    Differs {
        /// During this step, counted from 1 since the start of the program.
        step: u64,
        /// What, in words.
        what: String,
    },
    /// The file is damaged.
    Unreadable(String),
}

impl fmt::Debug for Tape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match () {
            () if self.is_capturing() => "Tape(capturing)",
            () if self.is_replaying() => "Tape(replaying)",
            () => "Tape(off)",
        })
    }
}

/// The same tape, or both off.
impl PartialEq for Tape {
    fn eq(&self, other: &Self) -> bool {
        let place = |tape: &Self| tape.0.as_deref().map(Arc::as_ptr);
        place(self) == place(other)
    }
}

impl Eq for Tape {}

impl Tape {
    /// A tape that writes a capture.
    ///
    /// # Errors
    /// When the file cannot be made.
    pub fn capturing(path: &Path, header: &Header) -> io::Result<Self> {
        Ok(Self::new(Mode::Capturing(Capturing::create(path, header)?)))
    }

    /// A tape that replays a capture.
    ///
    /// # Errors
    /// When the file cannot be read, or is no capture.
    pub fn replaying(path: &Path) -> Result<(Self, Header), CaptureError> {
        let reader = Reader::open(path)?;
        let header = reader.header().clone();
        Ok((Self::new(Mode::Replaying(Replaying::new(reader))), header))
    }

    fn new(mode: Mode) -> Self {
        Self(Some(Arc::new(Arc::new(Mutex::new(State {
            mode,
            depth: 0,
            is_suspended: false,
            on_end: None,
            on_lack: None,
        })))))
    }

    /// The same tape, counted apart: for the memory of a simulator, which is brought back with its counts.
    pub fn counted_apart(&self) -> Self {
        Self(self.0.as_deref().map(|state| Arc::new(Arc::clone(state))))
    }

    /// Calls `on_end` at once when a replay cannot go on: the run differs, or the capture ends.
    pub fn on_end(&self, on_end: impl FnMut(&Verdict) + Send + 'static) {
        if let Some(mut state) = self.lock() {
            state.on_end = Some(Box::new(on_end));
        }
    }

    /// Calls `on_lack` when something is not captured.
    pub fn on_lack(&self, on_lack: impl FnMut(&str) + Send + 'static) {
        if let Some(mut state) = self.lock() {
            state.on_lack = Some(Box::new(on_lack));
        }
    }

    /// Whether it captures or replays.
    pub fn is_on(&self) -> bool {
        self.0.is_some()
    }

    /// Whether it captures.
    pub fn is_capturing(&self) -> bool {
        self.lock()
            .is_some_and(|state| matches!(state.mode, Mode::Capturing(_)))
    }

    /// Whether it replays: nothing outside is to be opened, changed or waited for.
    pub fn is_replaying(&self) -> bool {
        self.lock()
            .is_some_and(|state| matches!(state.mode, Mode::Replaying(_)))
    }

    fn lock(&self) -> Option<MutexGuard<'_, State>> {
        let state = self.0.as_ref()?;
        Some(state.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// A value from outside, which `read` gets.
    ///
    /// # Errors
    /// When the capture has something else in this place.
    #[inline]
    pub fn input<T: Recorded>(&self, kind: &str, read: impl FnOnce() -> T) -> Result<T, Lost> {
        self.input_for(kind, String::new, read)
    }

    /// The same; `who` asks for it, in the words of the difference.
    ///
    /// # Errors
    /// When the capture has something else in this place.
    #[inline]
    pub fn input_for<T: Recorded>(
        &self,
        kind: &str,
        who: impl Fn() -> String,
        read: impl FnOnce() -> T,
    ) -> Result<T, Lost> {
        if self.0.is_none() {
            return Ok(read());
        }
        self.taped(kind, &who, read)
    }

    #[inline(never)]
    fn taped<T: Recorded>(
        &self,
        kind: &str,
        who: &dyn Fn() -> String,
        read: impl FnOnce() -> T,
    ) -> Result<T, Lost> {
        match self.replayed(|replaying| replaying.take(kind, who)) {
            Some(value) => value.ok_or(Lost),
            None => {
                let value = self.within(read);
                self.captured(|capturing| capturing.add_input(kind, &value));
                Ok(value)
            }
        }
    }

    /// Something that may have come since the last time: it is in the capture only if it has. `key` is the one of several askers. Each of them
    /// asks at most once at a place of the run, such as the start of an iteration.
    pub fn poll<T: Recorded>(
        &self,
        kind: &str,
        key: u64,
        check: impl FnOnce() -> Option<T>,
    ) -> Option<T> {
        if self.0.is_none() {
            return check();
        }
        match self.replayed(|replaying| Some(replaying.take_if(kind, key))) {
            Some(found) => found.flatten(),
            None => {
                let found = self.within(check)?;
                let keyed = (key, found);
                self.captured(|capturing| capturing.add_input(kind, &keyed));
                Some(keyed.1)
            }
        }
    }

    /// Whether something has happened, such as a request to end: it is in the capture only if it has.
    pub fn signal(&self, kind: &str, has_happened: impl FnOnce() -> bool) -> bool {
        self.poll(kind, 0, || has_happened().then_some(()))
            .is_some()
    }

    /// Whether the next thing of a replay is an input of that kind.
    pub fn next_is(&self, kind: &str) -> bool {
        self.replayed(|replaying| Some(replaying.next_is(kind)))
            .flatten()
            .unwrap_or(false)
    }

    /// Adds an input that was read before, where it cannot be read by [`input`](Self::input). Nothing while replaying.
    pub fn add<T: Recorded>(&self, kind: &str, value: &T) {
        self.captured(|capturing| capturing.add_input(kind, value));
    }

    /// An input begins that cannot be read by [`input`](Self::input): what is asked for until [`end_input`](Self::end_input) is part of it.
    pub fn begin_input(&self) {
        if let Some(mut state) = self.lock() {
            state.depth += 1;
        }
    }

    /// Ends what [`begin_input`](Self::begin_input) began.
    pub fn end_input(&self) {
        if let Some(mut state) = self.lock() {
            state.depth = state.depth.saturating_sub(1);
        }
    }

    /// The bytes of a file, which `read` gets. Equal contents are written once.
    ///
    /// # Errors
    /// Those of `read`, and when the capture has something else in this place.
    pub fn content(
        &self,
        kind: &str,
        read: impl FnOnce() -> io::Result<Vec<u8>>,
    ) -> io::Result<Vec<u8>> {
        if self.0.is_none() {
            return read();
        }
        let who = String::new;
        let number = self.replayed(|replaying| replaying.take::<io::Result<u64>>(kind, &who));
        if let Some(number) = number {
            let number = number.ok_or(Lost)??;
            let content = self.replayed(|replaying| replaying.content(number));
            return Ok(content.flatten().ok_or(Lost)?);
        }
        let mut content = self.within(read);
        self.captured(|capturing| match &mut content {
            Ok(content) => {
                let number = capturing.number_of_content(content);
                capturing.add_input(kind, &Ok::<_, io::Error>(number));
            }
            Err(error) => capturing.add_input(kind, &Err::<u64, _>(copy_of(error))),
        });
        content
    }

    /// An iteration of the loop begins.
    #[inline]
    pub fn turn(&self) {
        if self.0.is_some() && self.replayed(Replaying::turn).is_none() {
            self.captured(|capturing| capturing.add(&Record::Turn));
        }
    }

    /// A step has ended with a state of that hash, which is only computed for a tape that is on.
    #[inline]
    pub fn step(&self, hash: impl FnOnce() -> u64) {
        if self.0.is_none() {
            return;
        }
        let hash = hash();
        if self.replayed(|replaying| replaying.step(hash)).is_none() {
            self.captured(|capturing| {
                capturing.steps += 1;
                let step = capturing.steps;
                capturing.add(&Record::Step { step, hash });
            });
        }
    }

    /// Notes something that is not captured, so that a replay will differ.
    pub fn lacks(&self, what: &str) {
        self.captured(|capturing| capturing.add(&Record::Lacks(what.to_owned())));
        if self.is_capturing()
            && let Some(mut state) = self.lock()
            && let Some(on_lack) = &mut state.on_lack
        {
            on_lack(what);
        }
    }

    /// The run differs, for a reason that the tape does not know.
    pub fn differs(&self, what: &str) {
        self.replayed(|replaying| {
            replaying.differs(what.to_owned());
            None::<()>
        });
    }

    /// The run has ended: the last thing that is written. Of a replay, how it has ended; `None` for other tapes.
    ///
    /// # Errors
    /// When something could not be written.
    pub fn finish(&self) -> io::Result<Option<Verdict>> {
        let Some(mut state) = self.lock() else {
            return Ok(None);
        };
        match &mut state.mode {
            Mode::Capturing(capturing) => capturing.close().map(|()| None),
            Mode::Replaying(replaying) => {
                replaying.end();
                Ok(replaying.verdict.clone())
            }
            Mode::Off => Ok(None),
        }
    }

    /// What a replay does; None for other tapes. Where the capture has nothing for it, the end is reported.
    fn replayed<T>(&self, act: impl FnOnce(&mut Replaying) -> Option<T>) -> Option<Option<T>> {
        let mut state = self.lock()?;
        let is_suspended = state.is_suspended;
        let Mode::Replaying(replaying) = &mut state.mode else {
            return None;
        };
        if is_suspended {
            return Some(None);
        }
        let outcome = act(replaying);
        let verdict = outside(|| replaying.verdict.clone());
        let Some(mut on_end) = verdict.as_ref().and_then(|_| state.on_end.take()) else {
            return Some(outcome);
        };
        drop(state);
        outside(|| {
            verdict.iter().for_each(&mut on_end);
            drop((verdict, on_end));
        });
        Some(outcome)
    }

    /// What a capture gets, outside of other inputs.
    fn captured(&self, act: impl FnOnce(&mut Capturing)) {
        if let Some(mut state) = self.lock()
            && state.depth == 0
            && let Mode::Capturing(capturing) = &mut state.mode
        {
            outside(|| act(capturing));
        }
    }

    /// Reads an input: what it asks for meanwhile is part of it.
    fn within<T>(&self, read: impl FnOnce() -> T) -> T {
        let _depth = Depth::enter(self);
        read()
    }
}

/// An input that is being read; it ends also when reading panics.
struct Depth<'a>(&'a Tape);

impl<'a> Depth<'a> {
    fn enter(tape: &'a Tape) -> Self {
        tape.begin_input();
        Self(tape)
    }
}

impl Drop for Depth<'_> {
    fn drop(&mut self) {
        self.0.end_input();
    }
}

/// An error with the same number or words.
fn copy_of(error: &io::Error) -> io::Error {
    error.raw_os_error().map_or_else(
        || io::Error::new(error.kind(), error.to_string()),
        io::Error::from_raw_os_error,
    )
}

mod moments;
#[cfg(test)]
mod tests;
