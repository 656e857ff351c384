//! Going to other moments of a replay, and leaving it.

use std::io;

use heap::outside;

use super::{Mode, State, Tape, Verdict};
use crate::state::Mark;

impl Tape {
    /// The present moment of a replay; None for other tapes.
    pub fn mark(&self) -> Option<Mark> {
        let state = self.lock()?;
        match &state.mode {
            Mode::Replaying(replaying) => Some(replaying.mark()),
            _ => None,
        }
    }

    /// Goes on with a replay from a moment. The simulator has to be what it was then.
    ///
    /// # Errors
    /// When the file cannot be read.
    pub fn go_to(&self, mark: &Mark) -> io::Result<()> {
        let mut state = self.lock();
        match state.as_deref_mut() {
            Some(State {
                mode: Mode::Replaying(replaying),
                depth,
                ..
            }) => {
                // An iteration that was broken off may have been in the midst of an input.
                *depth = 0;
                replaying.go_to(mark)
            }
            _ => Ok(()),
        }
    }

    /// How the replay has ended; None while it goes on, and for other tapes.
    pub fn verdict(&self) -> Option<Verdict> {
        let state = self.lock()?;
        match &state.mode {
            Mode::Replaying(replaying) => replaying.verdict.clone(),
            _ => None,
        }
    }

    /// Steps of the replay so far.
    pub fn steps(&self) -> u64 {
        match self.lock().as_deref() {
            Some(State {
                mode: Mode::Replaying(replaying),
                ..
            }) => replaying.steps,
            Some(State {
                mode: Mode::Capturing(capturing),
                ..
            }) => capturing.steps,
            _ => 0,
        }
    }

    /// From now on a step with another hash does not end a replay.
    pub fn tolerate_hashes(&self) {
        if let Some(mut state) = self.lock()
            && let Mode::Replaying(replaying) = &mut state.mode
        {
            replaying.tolerates_hashes = true;
        }
    }

    /// Ends a replay in the midst: from now on everything comes from outside.
    pub fn go_live(&self) {
        if let Some(mut state) = self.lock()
            && let Mode::Replaying(_) = state.mode
        {
            outside(|| state.mode = Mode::Off);
        }
    }

    /// While `is_suspended`, code runs that is no part of the run, such as expressions of a debugger: a replay has nothing for it.
    pub fn suspend(&self, is_suspended: bool) {
        if let Some(mut state) = self.lock() {
            state.is_suspended = is_suspended;
        }
    }
}
