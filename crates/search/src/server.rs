//! Hands plans of cases to the threads that run them, and their reports back.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::case::{Case, Plan};
use super::choice::Value;
use super::{Report, Status};

/// How often a thread that waits asks whether it is to go on.
const TICK: Duration = Duration::from_millis(20);

/// Nobody runs cases any more, or a case was left unfinished.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a case was not run to its end")]
pub struct WorkersGone;

/// Runs cases.
pub trait Evaluate {
    /// Runs cases by these plans, and returns their reports in the order of the plans, up to the first one that failed: what comes after it
    /// is left out, whether it was run or not.
    ///
    /// # Errors
    /// When not all can be run.
    fn evaluate(&mut self, plans: &[Plan]) -> Result<Vec<Report>, WorkersGone>;
}

/// What threads that run cases and the one that chooses them share.
pub struct Server {
    state: Mutex<State>,
    changed: Condvar,
    /// Called whenever a case is over.
    on_case: Box<dyn Fn() + Send + Sync>,
}

#[derive(Debug, Default)]
struct State {
    waiting: VecDeque<(usize, Plan)>,
    running: usize,
    reports: BTreeMap<usize, Report>,
    /// How many threads run cases.
    workers: usize,
    is_closed: bool,
    /// What a case had chosen that was given up.
    unfinished: Option<Vec<Value>>,
}

impl Server {
    /// For so many threads that run cases; each of them [leaves](Self::leave) in the end. `on_case` is called whenever a case is over.
    pub fn new(workers: usize, on_case: impl Fn() + Send + Sync + 'static) -> Self {
        let state = State {
            workers,
            ..State::default()
        };
        Self {
            state: Mutex::new(state),
            changed: Condvar::new(),
            on_case: Box::new(on_case),
        }
    }

    /// The next plan and its number, for a thread that runs cases. It waits for one; None at the end, or when `is_stopped`.
    pub fn next(&self, is_stopped: impl Fn() -> bool) -> Option<(usize, Plan)> {
        let mut state = self.lock();
        loop {
            if state.is_closed || is_stopped() {
                return None;
            }
            if let Some(job) = state.waiting.pop_front() {
                state.running += 1;
                return Some(job);
            }
            state = self.wait(state);
        }
    }

    /// The case of the next plan and its number, if it goes on from where `case` has come to; it stays with the other threads otherwise.
    /// It waits for one as [`next`](Self::next) does.
    pub fn next_from(&self, case: &Case, is_stopped: impl Fn() -> bool) -> Option<(usize, Case)> {
        let mut state = self.lock();
        while !state.is_closed && !is_stopped() {
            if let Some((number, plan)) = state.waiting.front() {
                let next = (*number, case.resumed(plan)?);
                state.waiting.pop_front();
                state.running += 1;
                return Some(next);
            }
            state = self.wait(state);
        }
        None
    }

    /// How the case with that number ended.
    pub fn finish(&self, number: usize, report: Report) {
        let mut state = self.lock();
        state.running -= 1;
        if report.status == Status::Failed {
            // What comes after it is not wanted.
            state.waiting.retain(|(waiting, _)| *waiting < number);
        }
        state.reports.insert(number, report);
        drop(state);
        self.changed.notify_all();
        (self.on_case)();
    }

    /// A case will not be reported that had chosen these values: there is no result.
    pub fn give_up(&self, values: Vec<Value>) {
        self.lock().unfinished.get_or_insert(values);
        self.changed.notify_all();
    }

    /// A thread that runs cases ends.
    pub fn leave(&self) {
        self.lock().workers -= 1;
        self.changed.notify_all();
    }

    /// What the first case had chosen that was given up.
    pub fn unfinished(&self) -> Option<Vec<Value>> {
        self.lock().unfinished.clone()
    }

    /// There are no more plans.
    pub fn close(&self) {
        self.lock().is_closed = true;
        self.changed.notify_all();
    }

    /// See [`Evaluate`].
    ///
    /// # Errors
    /// See [`Evaluate`].
    pub fn evaluate(&self, plans: &[Plan]) -> Result<Vec<Report>, WorkersGone> {
        let mut state = self.lock();
        state.reports.clear();
        state.waiting = plans.iter().cloned().enumerate().collect();
        self.changed.notify_all();
        while !state.waiting.is_empty() || state.running > 0 {
            if state.unfinished.is_some() || state.workers == 0 {
                return Err(WorkersGone);
            }
            state = self.wait(state);
        }
        let reports = std::mem::take(&mut state.reports);
        Ok(up_to_first_failure(reports.into_values()))
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, state: MutexGuard<'a, State>) -> MutexGuard<'a, State> {
        self.changed
            .wait_timeout(state, TICK)
            .unwrap_or_else(PoisonError::into_inner)
            .0
    }
}

impl std::fmt::Debug for Server {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Server").finish_non_exhaustive()
    }
}

impl Evaluate for &Server {
    fn evaluate(&mut self, plans: &[Plan]) -> Result<Vec<Report>, WorkersGone> {
        Server::evaluate(self, plans)
    }
}

/// The reports until one that failed, with it.
fn up_to_first_failure(reports: impl Iterator<Item = Report>) -> Vec<Report> {
    let mut kept = Vec::new();
    for report in reports {
        let is_last = report.status == Status::Failed;
        kept.push(report);
        if is_last {
            break;
        }
    }
    kept
}
