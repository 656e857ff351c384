//! Whether a script may yield.

use std::cell::Cell;

use crate::binding::args::{Args, FromScript};
use crate::binding::source::Source;
use crate::error::ApiResult;
use scene::Data;

/// May code of a script yield, and when is it made to?
#[derive(Default)]
pub struct Yields {
    /// 0: pre-emption is allowed in code outside of coroutines that have a level of their own.
    pub auto: Cell<i64>,
    /// 0: yielding is allowed at all.
    pub overall: Cell<i64>,
    /// Whole milliseconds, as scripts set it.
    pub delay_ms: Cell<u32>,
    /// Instructions run by coroutines since the slice began.
    pub used: Cell<u64>,
    /// The count hook comes early, to end a slice.
    pub hastened: Cell<bool>,
}

impl Yields {
    /// A call from outside begins: it has a time slice of its own, and no locks.
    pub(crate) fn begin_slice(&self) {
        self.overall.set(0);
        self.used.set(0);
    }
}

/// The level after `change`: false raises it, true lowers it (not below 0), a number sets it.
pub fn changed_level(level: i64, change: LevelChange) -> i64 {
    match change {
        LevelChange::Forbid => level + 1,
        LevelChange::Allow => (level - 1).max(0),
        LevelChange::Set(level) => level.max(0),
    }
}

/// Arguments of `setAutoYield` and `setYieldAllowed`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LevelChange {
    /// One level up: no yielding until as many calls allow it.
    Forbid,
    /// One level down, not below 0.
    Allow,
    /// That level.
    Set(i64),
}

impl FromScript for LevelChange {
    const TYPE: &'static str = "any";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> ApiResult<Self> {
        Ok(match Data::from_script(args)? {
            Data::Int(level) => Self::Set(level),
            Data::Float(level) => Self::Set(numbers::truncated(level)),
            other if other.truthy() => Self::Allow,
            _ => Self::Forbid,
        })
    }
}
