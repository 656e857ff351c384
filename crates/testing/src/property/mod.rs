//! Properties: tests that run for many cases, whose values a search chooses.
//!
//! Simulators on threads of their own run the cases of the search, each undone before the next. The simplest case that fails then runs once
//! more in a fresh simulator, captured: its outcome is that of the test.
#![allow(
    clippy::disallowed_methods,
    reason = "how long a search goes on may be up to the wall clock"
)]

#[cfg(feature = "plots")]
pub(crate) mod plot;
#[cfg(not(feature = "plots"))]
#[path = "plot_left_out.rs"]
pub(crate) mod plot;
mod values;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::Config;
use super::captures::Captures;
use super::case::{Outcome, Status, TestCase};
use super::session::Session;
use super::workers::CRASHED;
use script::coverage::LineCounts;
use script::test_bench::CompiledFile;
use script::test_cases::CaseSource;
use search::{
    Budget, Failures, Found, KnownFailure, Plan, Report, Rest, Server, Settings, Value, WorkersGone,
};
use simulator::{Simulator, Tape};
pub use values::{Sample, ShownValue};

/// Cases of a property that does not say how many.
const CASES: usize = 100;
/// Runs that shrinking may take, unless a property says how many.
const SHRINKS: usize = 300;
/// Cases that are kept for a table and a picture.
const MAX_SAMPLES: usize = 20_000;

/// What a property says about its cases.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PropertyOptions {
    /// How many are tried.
    pub cases: Option<usize>,
    /// Runs that shrinking a failing one may take.
    pub shrinks: Option<usize>,
    /// Whether each has a simulator of its own, instead of being undone.
    pub is_fresh: bool,
}

/// How `swanilda search` searches for failing cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SearchOptions {
    /// Simulators that run cases at a time.
    pub jobs: usize,
    /// How long it goes on for each property.
    pub time: Option<Duration>,
    /// Cases that are tried at most.
    pub cases: Option<usize>,
}

/// Where failing cases are kept.
#[derive(Debug, Clone)]
pub struct FailingCases {
    /// The folder of their values.
    pub folder: PathBuf,
    /// Where their captures go.
    pub captures: Captures,
}

/// What is known of a property in the end.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PropertyReport {
    /// Cases that were tried.
    pub cases: usize,
    /// How many of them the property has discarded.
    pub discarded: usize,
    /// Runs that shrinking took.
    pub shrinks: usize,
    /// Values of the simplest failing case that cannot be simpler and still fail.
    pub chosen: usize,
    /// The least robustness that was found; infinite when nothing was measured.
    pub robustness: f64,
    /// Lines of scripts that were reached, where they are counted.
    pub lines: usize,
    /// The values of the first case that failed.
    pub first: Vec<ShownValue>,
    /// Those of the simplest one.
    pub simplest: Vec<ShownValue>,
    /// What a message says about a case that was not run to its end.
    pub(super) unfinished: String,
    /// The file that has the choices of the simplest case.
    pub kept: Option<PathBuf>,
    /// The cases that a search has tried, in order.
    pub samples: Vec<Sample>,
}

/// A property to be tested.
pub(super) struct Property<'a> {
    pub config: &'a Config,
    pub test: &'a Arc<TestCase>,
    pub compiled: Option<CompiledFile>,
    /// Ends whatever runs.
    pub stop: &'a Arc<AtomicBool>,
}

/// How the search of a property ended.
struct Searched {
    found: Result<Found, WorkersGone>,
    samples: Vec<Sample>,
    /// What a case had chosen that was not run to its end.
    unfinished: Option<Vec<Value>>,
    /// The first outcome of a simulator that is not good by itself.
    broken: Option<Outcome>,
    /// The lines that ran.
    line_counts: LineCounts,
}

impl Property<'_> {
    /// Searches and reports; `on_case` is called whenever a case is over, `progress` sees what was found so far.
    pub(super) fn run(
        &self,
        on_case: impl Fn() + Send + Sync + 'static,
        progress: &mut dyn FnMut(&Found),
    ) -> Outcome {
        let searched = self.search(on_case, progress);
        let mut outcome = match &searched.found {
            Ok(found) => self.concluded(found, searched.broken),
            Err(WorkersGone) => self.broken(searched.broken, searched.unfinished.as_deref()),
        };
        if let (Some(report), Ok(found)) = (&mut outcome.property, &searched.found) {
            report.count(found);
            report.samples = searched.samples;
        }
        outcome.line_counts.merge(searched.line_counts);
        outcome
    }

    fn search(
        &self,
        on_case: impl Fn() + Send + Sync + 'static,
        progress: &mut dyn FnMut(&Found),
    ) -> Searched {
        let jobs = self.config.search.map_or(1, |search| search.jobs.max(1));
        let server = Arc::new(Server::new(jobs, on_case));
        let mut samples = Vec::new();
        std::thread::scope(|scope| {
            let spawn = |_| {
                let server = Arc::clone(&server);
                std::thread::Builder::new()
                    .name("cases".into())
                    .stack_size(Simulator::STACK_SIZE)
                    .spawn_scoped(scope, move || self.run_cases(&server))
                    .expect("the system has a thread for the cases")
            };
            let threads: Vec<_> = (0..jobs).map(spawn).collect();
            let found = self.explore(&server, &mut |found, reports| {
                keep(&mut samples, reports);
                progress(found);
            });
            server.close();
            let outcome = |ended: std::thread::Result<Outcome>| {
                let crashed = |_| Outcome::new(Arc::clone(self.test), Status::Error, CRASHED);
                ended.unwrap_or_else(crashed)
            };
            let mut line_counts = LineCounts::default();
            let ended = threads.into_iter().map(|thread| outcome(thread.join()));
            let ended = ended.inspect(|outcome| line_counts.merge(outcome.line_counts.clone()));
            let broken = ended.filter(Outcome::is_bad).reduce(|first, _| first);
            Searched {
                found,
                samples: std::mem::take(&mut samples),
                unfinished: server.unfinished(),
                broken,
                line_counts,
            }
        })
    }

    fn explore(
        &self,
        mut server: &Server,
        progress: &mut dyn FnMut(&Found, &[Report]),
    ) -> Result<Found, WorkersGone> {
        let options = self.test.property.unwrap_or_default();
        let search = self.config.search;
        let limit = search.and_then(|search| search.time);
        let of_time = limit.map(|_| usize::MAX);
        let cases = search.and_then(|search| search.cases).or(of_time);
        let settings = Settings {
            seed: u64::from(self.test.seed),
            budget: Budget {
                cases: cases.or(options.cases).unwrap_or(CASES),
                shrinks: options.shrinks.unwrap_or(SHRINKS),
            },
            known: self.known().into_iter().collect(),
        };
        let begun = Instant::now();
        let mut is_over = || limit.is_some_and(|limit| begun.elapsed() >= limit);
        search::search(&settings, &mut server, &mut is_over, progress)
    }

    fn failures(&self) -> Option<Failures> {
        let kept = self.config.failing_cases.as_ref()?;
        Some(Failures::new(kept.folder.clone()))
    }

    fn known(&self) -> Option<Vec<Value>> {
        Some(self.failures()?.load(&self.test.id())?.choices)
    }

    /// Runs cases until there are no more. The outcome of a simulator that is not good by itself, or of the last one.
    fn run_cases(&self, server: &Arc<Server>) -> Outcome {
        let _leaving = Leaving(server);
        if !self.test.property.unwrap_or_default().is_fresh {
            return self.run_one(CaseSource::Search(Arc::clone(server)));
        }
        let mut outcome = Outcome::new(Arc::clone(self.test), Status::Passed, "");
        let is_stopped = || self.stop.load(Ordering::Relaxed);
        while let Some((number, plan)) = server.next(is_stopped) {
            let before = std::mem::take(&mut outcome.line_counts);
            outcome = self.run_one(CaseSource::OneOf(Arc::clone(server), number, plan));
            outcome.line_counts.merge(before);
            if outcome.is_bad() {
                // It has not come to its case, or not to the end of it.
                server.give_up(Vec::new());
                break;
            }
        }
        outcome
    }

    /// Runs the property in a simulator for cases of a search.
    fn run_one(&self, source: CaseSource) -> Outcome {
        let config = Config {
            record_failures: None,
            captures: None,
            ..self.config.clone()
        };
        let (file, stop) = (&self.test.file, Arc::clone(self.stop));
        let seed = self.test.seed;
        let counts_lines = self.config.search.is_some() || self.config.coverage.is_some();
        let session =
            Session::with_lines(&config, file, seed, stop, &Tape::default(), counts_lines);
        self.run_in(session, source).0
    }

    /// Runs the property by that source of cases; its outcome, and the values that the last case noted.
    fn run_in(&self, mut session: Session, source: CaseSource) -> (Outcome, Vec<ShownValue>) {
        session.take_cases_from(source);
        let compiled = self.compiled.clone().filter(|_| session.takes_compiled());
        if let Err(broken) = session.load(&self.test.file, compiled, Some(self.test.index)) {
            let test = Arc::clone(self.test);
            return (Outcome { test, ..*broken }, Vec::new());
        }
        let mut outcome = session.run(self.test);
        let (notes, line_counts) = session.end_cases();
        let values = values::shown(&self.test.file, &notes);
        session.finish(&mut outcome);
        session.note_capture(&mut outcome);
        session.take_line_counts(&mut outcome);
        outcome.line_counts.merge(line_counts);
        (outcome, values)
    }

    /// The outcome of a search that has come to its end.
    fn concluded(&self, found: &Found, broken: Option<Outcome>) -> Outcome {
        let (Some(failing), Some(simplest)) = (&found.failing, &found.simplest) else {
            if let Some(failures) = self.failures() {
                failures.remove(&self.test.id());
            }
            let passed = || Outcome::new(Arc::clone(self.test), Status::Passed, "");
            let mut outcome = broken.unwrap_or_else(passed);
            outcome.property = Some(PropertyReport::default());
            return outcome;
        };
        let (_, first) = self.single(&failing.values(), None);
        let (mut outcome, shown) = self.single(&simplest.values(), self.captures());
        if !outcome.is_bad() {
            outcome.fail("it has failed after other cases, and passes in a fresh simulator: something of a case is left over.");
        }
        let mut report = PropertyReport {
            first,
            simplest: shown,
            ..PropertyReport::default()
        };
        report.kept = self.keep(&outcome, simplest.values());
        outcome.message += &values::explained(&report, found);
        outcome.property = Some(report);
        outcome
    }

    /// The outcome when a case could not be run to its end.
    fn broken(&self, broken: Option<Outcome>, unfinished: Option<&[Value]>) -> Outcome {
        let unknown = || Outcome::new(Arc::clone(self.test), Status::Error, CRASHED);
        let mut outcome = broken.unwrap_or_else(unknown);
        let mut report = PropertyReport::default();
        if let Some(values) = unfinished {
            report.kept = self.keep(&outcome, values.to_vec());
            report.unfinished = values::of_unfinished(values);
            outcome.message += &report.unfinished;
        }
        outcome.property = Some(report);
        outcome
    }

    fn captures(&self) -> Option<Captures> {
        let kept = self.config.failing_cases.as_ref();
        let kept = kept.map(|kept| kept.captures.clone());
        self.config.captures.clone().or(kept)
    }

    /// Runs one case in a simulator of its own.
    fn single(&self, values: &[Value], captures: Option<Captures>) -> (Outcome, Vec<ShownValue>) {
        let kept = self.config.failing_cases.as_ref();
        let pages = self.config.record_failures.clone();
        let pages = pages.or(kept.map(|kept| kept.folder.clone()));
        let config = Config {
            record_failures: pages.filter(|_| captures.is_some()),
            captures,
            ..self.config.clone()
        };
        let tests = std::slice::from_ref(self.test);
        let session = Session::of_tests(&config, tests, Some(values), Arc::clone(self.stop));
        match session {
            Ok(session) => self.run_in(session, CaseSource::Single(plan_of(values))),
            Err(outcome) => (*outcome, Vec::new()),
        }
    }

    fn keep(&self, outcome: &Outcome, choices: Vec<Value>) -> Option<PathBuf> {
        let failure = KnownFailure {
            test: self.test.id(),
            message: outcome.message.clone(),
            choices,
        };
        // Without it, the case is only not tried first the next time.
        self.failures()?.save(&failure).ok()
    }
}

/// A thread that runs cases leaves the search, however it ends.
struct Leaving<'a>(&'a Server);

impl Drop for Leaving<'_> {
    fn drop(&mut self) {
        self.0.leave();
    }
}

/// A case with these choices.
pub(super) fn plan_of(values: &[Value]) -> Plan {
    Plan {
        values: values.to_vec(),
        rest: Rest::Simplest,
    }
}

fn keep(samples: &mut Vec<Sample>, reports: &[Report]) {
    let room = MAX_SAMPLES.saturating_sub(samples.len());
    samples.extend(reports.iter().take(room).map(Sample::of));
}

impl PropertyReport {
    /// The cases of the search as a table: status, robustness, and the numbers that each chose.
    pub fn csv(&self) -> String {
        values::csv(&self.samples)
    }

    /// The cases of the search over the two choices that matter most, as SVG; None with fewer than two choices, or in a build without plots.
    pub fn picture(&self) -> Option<String> {
        plot::of_samples(&self.samples)
    }

    fn count(&mut self, found: &Found) {
        (self.cases, self.discarded) = (found.cases, found.discarded);
        (self.shrinks, self.lines) = (found.shrinks, found.lines);
        let simplest = found.simplest.iter().flat_map(|report| &report.choices);
        self.chosen = simplest.filter(|choice| choice.is_chosen()).count();
        let reports = [&found.failing, &found.simplest, &found.closest];
        let robustness = reports
            .into_iter()
            .flatten()
            .map(|report| report.robustness);
        self.robustness = robustness.fold(f64::INFINITY, f64::min);
    }
}
