//! The cases of a property: what the script of a test draws its values from, and what the runner learns of each case.
//!
//! Like the bench it lies on, it is outside of the simulator's memory: a case is undone, what it has chosen is not.

use std::cell::{Cell, RefCell};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::coverage::LineCounts;
use heap::outside;
use search::{Case, CaseEnd, Domain, Plan, Server, Value};

/// Where cases come from.
#[derive(Debug, Clone)]
pub enum CaseSource {
    /// One case, which is not undone: the simulator is left as it ends.
    Single(Plan),
    /// Those of a search, each of which is undone.
    Search(Arc<Server>),
    /// One of a search, with its number, in a simulator of its own.
    OneOf(Arc<Server>, usize, Plan),
}

/// A value that a case has drawn, for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// The line of the test's file that has drawn it, if known.
    pub line: Option<u32>,
    /// The value.
    pub text: String,
}

/// A temporal property over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Signal {
    /// The property.
    pub name: String,
    /// Time in seconds, and how far the condition is from false then; infinite where it is a boolean.
    pub samples: Vec<(f64, f64)>,
    /// How far the property is from false.
    pub robustness: f64,
}

/// The cases of a property.
#[derive(Debug)]
pub struct TestCases {
    source: CaseSource,
    running: RefCell<Option<Running>>,
    notes: RefCell<Vec<Note>>,
    /// The lines that ran in cases.
    line_counts: RefCell<LineCounts>,
    /// The single case has been begun.
    is_used: Cell<bool>,
    /// When the case that runs has begun, or has last come to a branch.
    since: Cell<Option<Instant>>,
}

#[derive(Debug)]
struct Running {
    number: usize,
    case: Case,
}

/// What the case that ran had chosen at a moment from which others may go on.
#[derive(Debug)]
pub struct Branch {
    case: Case,
    notes: Vec<Note>,
}

impl TestCases {
    /// The cases of that source.
    pub fn new(source: CaseSource) -> Self {
        Self {
            source,
            running: RefCell::default(),
            notes: RefCell::default(),
            line_counts: RefCell::default(),
            is_used: Cell::default(),
            since: Cell::default(),
        }
    }

    /// Whether each case is undone.
    pub fn are_undone(&self) -> bool {
        matches!(self.source, CaseSource::Search(_))
    }

    /// Whether the failure of a case is that of the test, rather than reported to a search.
    pub fn is_single(&self) -> bool {
        matches!(self.source, CaseSource::Single(_))
    }

    /// Begins the next case, waiting for one; false at the end, or when `is_stopped`.
    pub fn begin(&self, is_stopped: impl Fn() -> bool) -> bool {
        outside(|| {
            let next = match &self.source {
                CaseSource::Search(server) => server.next(is_stopped),
                _ if self.is_used.replace(true) => None,
                CaseSource::Single(plan) => Some((0, plan.clone())),
                CaseSource::OneOf(_, number, plan) => Some((*number, plan.clone())),
            };
            let case = next.map(|(number, plan)| Running {
                number,
                case: Case::new(plan),
            });
            self.notes.borrow_mut().clear();
            *self.running.borrow_mut() = case;
            self.renew_age();
        });
        self.running.borrow().is_some()
    }

    /// Makes a choice of the case that runs. None when none runs, or when it has made too many.
    pub fn choose(&self, domain: Domain) -> Option<Value> {
        self.with_case(|case| case.choose(domain)).flatten()
    }

    /// How long the case has been running, or since its last branch.
    pub fn age(&self) -> Duration {
        let since = self.since.get();
        since.map_or(Duration::ZERO, |since| now().duration_since(since))
    }

    /// Others may go on from where the case that runs has come to.
    pub fn add_branch(&self) {
        self.with_case(Case::add_branch);
    }

    /// What the case that runs has chosen so far. None when none runs.
    pub fn branch(&self) -> Option<Branch> {
        let notes = &self.notes;
        self.with_case(|case| Branch {
            case: case.clone(),
            notes: notes.borrow().clone(),
        })
    }

    /// The [age](Self::age) counts from now on.
    pub fn renew_age(&self) {
        self.since.set(Some(now()));
    }

    /// Begins the next case if it goes on from there; it waits for one.
    pub fn go_on(&self, branch: &Branch, is_stopped: impl Fn() -> bool) -> bool {
        outside(|| {
            let server = self.server();
            let next = server.and_then(|server| server.next_from(&branch.case, is_stopped));
            let is_next = next.is_some();
            if let Some((number, case)) = next {
                self.notes.borrow_mut().clone_from(&branch.notes);
                *self.running.borrow_mut() = Some(Running { number, case });
                self.renew_age();
            }
            is_next
        })
    }

    /// Begins a span of choices that belong together. Returns its number.
    pub fn begin_span(&self) -> Option<usize> {
        self.with_case(Case::begin_span)
    }

    /// The choices that follow belong to a span that was ended.
    pub fn resume_span(&self, span: usize) {
        self.with_case(|case| case.resume_span(span));
    }

    /// Ends the last span that was begun.
    pub fn end_span(&self) {
        self.with_case(Case::end_span);
    }

    fn with_case<T>(&self, work: impl FnOnce(&mut Case) -> T) -> Option<T> {
        let mut running = self.running.borrow_mut();
        let running = running.as_mut()?;
        outside(|| Some(work(&mut running.case)))
    }

    /// Notes a value for people.
    pub fn note(&self, line: Option<u32>, text: &str) {
        outside(|| {
            let text = text.to_owned();
            self.notes.borrow_mut().push(Note { line, text });
        });
    }

    /// The values that were noted since the case has begun.
    pub fn notes(&self) -> Vec<Note> {
        self.notes.borrow().clone()
    }

    /// Keeps what ran in a case, which may be undone.
    pub fn add_line_counts(&self, counts: &LineCounts) {
        outside(|| self.line_counts.borrow_mut().merge(counts.clone()));
    }

    /// Hands over the lines that ran in cases.
    pub fn take_line_counts(&self) -> LineCounts {
        self.line_counts.take()
    }

    /// Ends the case that runs, and reports it to the search.
    pub fn end(&self, end: &CaseEnd) {
        outside(|| {
            let Some(Running { number, case }) = self.running.borrow_mut().take() else {
                return;
            };
            let Some(server) = self.server() else {
                return;
            };
            server.finish(number, case.finish(end.clone()));
        });
    }
}

impl TestCases {
    fn server(&self) -> Option<&Server> {
        match &self.source {
            CaseSource::Single(_) => None,
            CaseSource::Search(server) | CaseSource::OneOf(server, ..) => Some(server),
        }
    }
}

impl Drop for TestCases {
    /// The search learns that a case has not come to its end.
    fn drop(&mut self) {
        let running = self.running.take();
        if let (Some(server), Some(running)) = (self.server(), running) {
            server.give_up(running.case.values());
        }
    }
}

/// The wall clock says what is worth it; results do not depend on it.
#[expect(clippy::disallowed_methods, reason = "see above")]
fn now() -> Instant {
    Instant::now()
}
