//! Searches for a case in which a test fails, and for the simplest one that does.
//!
//! A test draws values from its [`Case`]: numbers within bounds, one after the other. The sequence of these *choices* is all that
//! distinguishes one case from another, as in Hypothesis: a case is run again, changed and shrunk by its choices, so that whatever a
//! test makes of them shrinks without code of its own. [`explore`] proposes [`Plan`]s of cases and learns from their [`Report`]s;
//! [`shrink`] shrinks a failing one; [`Server`] hands plans to the threads that run them. The result depends on the seed and on the
//! budget in cases, not on the number of threads. Nothing here knows of simulators.

mod case;
mod choice;
mod explore;
mod failures;
mod random;
mod search;
mod server;
mod shrink;

#[cfg(test)]
mod tests;

pub use case::{Case, CaseEnd, Plan, Rest, Span};
pub use choice::{Choice, Domain, Value};
pub use explore::explore;
pub use failures::{Failures, KnownFailure, text_of, values_of};
pub use search::{Budget, Found, Settings, search};
pub use server::{Evaluate, Server, WorkersGone};
pub use shrink::shrink;

/// How a case ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// All held.
    Passed,
    /// Something did not hold, or went wrong.
    Failed,
    /// The test has no use for these values: the case does not count.
    Discarded,
}

/// A case that was run.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// What it chose, in order.
    pub choices: Vec<Choice>,
    /// The choices that belong together.
    pub spans: Vec<Span>,
    /// How many choices it had made at the moments from which other cases may go on: a later one was made after time had passed.
    pub branches: Vec<usize>,
    /// How it ended.
    pub status: Status,
    /// Where it failed; two cases that fail at the same place fail for the same reason.
    pub place: String,
    /// How far it was from failing, in the test's own unit; negative when it failed, infinite when the test measures nothing.
    pub robustness: f64,
    /// The lines of scripts that ran, as numbers of the caller's choice, in ascending order; empty where they are not counted.
    pub covered: Vec<u64>,
}

impl Report {
    /// The values of its choices.
    pub fn values(&self) -> Vec<Value> {
        self.choices.iter().map(|choice| choice.value).collect()
    }
}
