//! Which line a step ends at.

use script::{CodeLevel, Place};

/// What the client wants the code to do until it stops again.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Mode {
    /// Runs to a breakpoint.
    #[default]
    Run,
    /// Stops at the next line of any script.
    Into,
    /// Stops at the next line of the function, or of one that called it.
    Over(Origin),
    /// Stops at the next line of a function that called this one.
    Out(Origin),
}

/// Where a step began.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Origin {
    /// The script.
    pub script: i64,
    /// Its coroutine, and the functions below the one that steps.
    pub level: CodeLevel,
    /// The first line of that function.
    pub function: u32,
}

impl Mode {
    /// Whether lines without breakpoints matter.
    pub fn steps(self) -> bool {
        self != Self::Run
    }

    /// Where the step began, if that matters.
    pub fn origin(self) -> Option<Origin> {
        match self {
            Self::Over(origin) | Self::Out(origin) => Some(origin),
            Self::Run | Self::Into => None,
        }
    }

    /// Whether the step ends at this line. `now` is the coroutine where it began as it is now, if it is still there.
    pub fn ends_at(self, place: &Place<'_>, now: Option<CodeLevel>) -> bool {
        let (origin, highest) = match self {
            Self::Run => return false,
            Self::Into => return true,
            Self::Over(origin) => (origin, origin.level.below),
            Self::Out(origin) => (origin, origin.level.below - 1),
        };
        let level = place.level();
        let is_same = place.script.id == origin.script && level.coroutine == origin.level.coroutine;
        if !is_same {
            // Something that the function has called, or that runs while it waits; unless it has ended.
            return now.is_none_or(|now| now.below < origin.level.below);
        }
        // `return f()` runs f in place of the function.
        let is_called_last = place.is_tail_call
            && level.below == origin.level.below
            && place.function != origin.function;
        level.below <= highest && !is_called_last
    }
}
