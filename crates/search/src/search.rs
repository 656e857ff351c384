//! A whole search: known failures, then new cases, then shrinking.

use super::case::{Plan, Rest};
use super::choice::Value;
use super::explore::explore;
use super::server::{Evaluate, WorkersGone};
use super::shrink::shrink;
use super::{Report, Status};

/// How long a search goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget {
    /// Cases that are tried at most.
    pub cases: usize,
    /// Runs that shrinking may take.
    pub shrinks: usize,
}

/// What a search begins with.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Seed of all that is random.
    pub seed: u64,
    /// How long it goes on.
    pub budget: Budget,
    /// The values of cases that have failed before: they come first.
    pub known: Vec<Vec<Value>>,
}

/// What a search has found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Found {
    /// Cases that were tried, without those that shrinking took.
    pub cases: usize,
    /// How many of them the test has discarded.
    pub discarded: usize,
    /// The first case that failed.
    pub failing: Option<Report>,
    /// The simplest case found that fails in the same way.
    pub simplest: Option<Report>,
    /// Runs that shrinking took.
    pub shrinks: usize,
    /// The case that passed closest to failing, where the test measures that.
    pub closest: Option<Report>,
    /// Lines of scripts that were reached, where they are counted.
    pub lines: usize,
}

impl Found {
    fn count(&mut self, reports: &[Report]) {
        self.cases += reports.len();
        for report in reports {
            match report.status {
                Status::Failed => self.failing = Some(report.clone()),
                Status::Discarded => self.discarded += 1,
                Status::Passed => {
                    let closest = self
                        .closest
                        .as_ref()
                        .map_or(f64::INFINITY, |r| r.robustness);
                    if report.robustness < closest {
                        self.closest = Some(report.clone());
                    }
                }
            }
        }
    }
}

/// Tries cases until one fails, the budget is used up, or `is_over` says so; `progress` sees what was found after each batch, with its
/// reports. A failing case is shrunk.
///
/// # Errors
/// When cases cannot be run any more.
pub fn search(
    settings: &Settings,
    evaluate: &mut dyn Evaluate,
    is_over: &mut dyn FnMut() -> bool,
    progress: &mut dyn FnMut(&Found, &[Report]),
) -> Result<Found, WorkersGone> {
    let mut found = Found::default();
    let known = settings.known.iter().map(|values| Plan {
        values: values.clone(),
        rest: Rest::Simplest,
    });
    let known: Vec<_> = known.collect();
    let mut explorer = explore(settings.seed);
    let mut plans = known;
    while found.failing.is_none() && found.cases < settings.budget.cases && !is_over() {
        if plans.is_empty() {
            plans = explorer.propose(settings.budget.cases - found.cases);
        }
        let reports = evaluate.evaluate(&plans)?;
        plans.clear();
        explorer.learn(&reports);
        found.count(&reports);
        found.lines = explorer.lines();
        progress(&found, &reports);
    }
    if let Some(failing) = found.failing.clone() {
        let (simplest, shrinks) = shrink(failing, settings.budget.shrinks, evaluate)?;
        (found.simplest, found.shrinks) = (Some(simplest), shrinks);
    }
    Ok(found)
}
