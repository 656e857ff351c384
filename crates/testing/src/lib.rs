//! The test runner: finds tests in Lua files, runs each in a simulator of its own, and says how they went.
//!
//! `discover` finds files, `session` is one simulator with a test file in it, `workers` spreads the work over threads, `plan` chooses
//! tests. What is shown is up to a [`Reporter`]; `report` has the texts of reports, most of which are made from the [`Summary`].

mod apart;
pub mod batch;
mod captures;
mod case;
mod coverage;
mod discover;
mod excerpt;
mod golden;
mod isolated;
mod plan;
mod property;
mod recording;
pub mod report;
mod results;
mod session;
mod workers;

use std::num::NonZero;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

pub use captures::{Captures, replay};
pub use case::{Outcome, Status, TestCase};
pub use coverage::{Coverage, FileCoverage};
pub use discover::find_files;
pub use excerpt::{Excerpt, positions};
pub use golden::{
    Comparison, ComparisonResult, Difference, Divergence, ImageDifference, RecordedImage,
    Recordings,
};
pub use property::{
    FailingCases, PropertyOptions, PropertyReport, Sample, SearchOptions, ShownValue,
};

pub use search::Found;

use permissions::Permissions;
use plan::Plan;
use results::Results;
use script::coverage::LineCounts;
use workers::{Message, Task, work};

/// Selection of tests, and how to run them.
#[derive(Debug, Clone)]
pub struct Config {
    /// Test files, and folders to look for them.
    pub paths: Vec<PathBuf>,
    /// How many tests run at a time.
    pub jobs: usize,
    /// Threads of each of them that compute mechanisms.
    pub threads: NonZero<usize>,
    /// Only tests whose identifier contains one of these; all when there are none.
    pub filters: Vec<String>,
    /// Part and number of parts, from 1: only this share of the tests.
    pub shard: Option<(usize, usize)>,
    /// How often each test runs; the seed rises by one each time.
    pub repeat: u32,
    /// Seed of the first repetition.
    pub seed: u32,
    /// No further tests after one has failed.
    pub fail_fast: bool,
    /// Record golden traces instead of comparing with them.
    pub update_golden: bool,
    /// Where pictures of golden traces go that differ.
    pub artifacts: PathBuf,
    /// Where recordings of failed tests go, if they are wanted.
    pub record_failures: Option<PathBuf>,
    /// Where captures of failed tests go, if they are wanted.
    pub captures: Option<Captures>,
    /// Where failing cases of properties are kept, if they are.
    pub failing_cases: Option<FailingCases>,
    /// Only properties run, searched like this; None: all tests, properties as they say.
    pub search: Option<SearchOptions>,
    /// The file for the report of which lines ran, if that is wanted.
    pub coverage: Option<PathBuf>,
    /// Limits of a test.
    pub allowance: Allowance,
    /// Permissions of scripts; the scene's folder is that of the test's file.
    pub permissions: Permissions,
    /// Folder of an installation of CoppeliaSim ([`simulator::Options::resources`]).
    pub resources: Option<PathBuf>,
    /// The command that runs a test in a process of its own and prints its outcome by [`run_child`]; None: tests run here.
    pub isolate: Option<fn(&TestCase) -> std::process::Command>,
    /// Number and repetition of the only test to run.
    pub only: Option<(usize, u32)>,
    /// Becomes true when the user wants an end.
    pub interrupted: Arc<AtomicBool>,
}

impl Config {
    /// The permissions of scripts of a scene in `folder`.
    fn permissions_in(&self, folder: &std::path::Path) -> Permissions {
        let set = self.permissions.clone().of_scene(folder);
        self.resources
            .iter()
            .fold(set, |set, resources| set.of_scene(resources))
    }

    /// Nothing chosen yet, everything once.
    pub fn new(jobs: usize, allowance: Allowance, interrupted: Arc<AtomicBool>) -> Self {
        Self {
            paths: Vec::new(),
            jobs,
            threads: NonZero::<usize>::MIN,
            filters: Vec::new(),
            shard: None,
            repeat: 1,
            seed: simulator::Options::default().seed,
            fail_fast: false,
            update_golden: false,
            artifacts: PathBuf::new(),
            record_failures: None,
            captures: None,
            failing_cases: None,
            search: None,
            coverage: None,
            allowance,
            permissions: Permissions::all(),
            resources: None,
            isolate: None,
            only: None,
            interrupted,
        }
    }
}

/// Limits of a test.
#[derive(Debug, Clone, Copy)]
pub struct Allowance {
    /// By the wall clock.
    pub wall: Duration,
    /// Simulated time, seconds.
    pub simulated: f64,
    /// Bytes all Lua code of the simulator together may have.
    pub memory: usize,
}

/// Receives the progress of the tests.
pub trait Reporter {
    /// All tests are known. A file that could not be loaded stands among them as a test of its own.
    fn begin(&mut self, tests: &[Arc<TestCase>]) {
        let _ = tests;
    }

    /// The search of a property goes on.
    fn progress(&mut self, test: &TestCase, found: &Found) {
        let _ = (test, found);
    }

    /// A test is over.
    fn outcome(&mut self, outcome: &Outcome);

    /// All is over.
    fn end(&mut self, summary: &Summary) {
        let _ = summary;
    }
}

/// How it went.
#[derive(Debug, Default)]
pub struct Summary {
    /// In the order of the files and their tests.
    pub outcomes: Vec<Outcome>,
    /// Tests that were not run, since one before had failed or the user wanted an end.
    pub not_run: usize,
    /// Tests that were not chosen.
    pub deselected: usize,
    /// Whether the user wanted an end before all tests had run.
    pub interrupted: bool,
    /// How long all of it took by the wall clock.
    pub wall: Duration,
    /// Line coverage of the tested scripts, if requested.
    pub coverage: Option<Coverage>,
}

impl Summary {
    /// How many tests ended so.
    pub fn count(&self, status: Status) -> usize {
        self.outcomes
            .iter()
            .filter(|outcome| outcome.status == status)
            .count()
    }

    /// Whether no test failed.
    pub fn is_good(&self) -> bool {
        self.count(Status::Failed) + self.count(Status::Error) == 0
    }
}

/// The tests there are, chosen by `config`.
///
/// # Errors
/// When a path cannot be read.
pub fn list(config: &Config) -> std::io::Result<Vec<Arc<TestCase>>> {
    Ok(plan(config)?.tests)
}

/// Finds the tests and runs them.
///
/// # Errors
/// When a path cannot be read.
pub fn run(config: &Config, reporter: &mut dyn Reporter) -> std::io::Result<Summary> {
    #[allow(
        clippy::disallowed_methods,
        reason = "how long tests take is what their user wants to know"
    )]
    let begun = std::time::Instant::now();
    let files = find_files(&config.paths)?;
    let plan = plan(config)?;
    reporter.begin(&plan.all());
    let (chosen, deselected) = (plan.tests.len(), plan.deselected);
    let (outcomes, counts) = run_plan(config, plan, reporter);
    let ran = outcomes
        .iter()
        .filter(|outcome| outcome.test.index > 0)
        .count();
    let summary = Summary {
        not_run: chosen.saturating_sub(ran),
        deselected,
        interrupted: config.interrupted.load(Ordering::Relaxed),
        coverage: config
            .coverage
            .as_ref()
            .map(|report| Coverage::new(report, &files, counts)),
        outcomes,
        wall: begun.elapsed(),
    };
    reporter.end(&summary);
    Ok(summary)
}

/// In the child process of a test (`Config::only`): runs it and returns the line that the parent reads.
///
/// # Errors
/// When its file cannot be read.
pub fn run_child(config: &Config) -> std::io::Result<String> {
    struct Quiet;
    impl Reporter for Quiet {
        fn outcome(&mut self, _: &Outcome) {}
    }
    let (outcomes, counts) = run_plan(config, plan(config)?, &mut Quiet);
    Ok(outcomes
        .first()
        .map(|outcome| isolated::printed(outcome, &counts))
        .unwrap_or_default())
}

/// The outcomes in the order of the files, and what lines ran.
fn run_plan(
    config: &Config,
    plan: Plan,
    reporter: &mut dyn Reporter,
) -> (Vec<Outcome>, LineCounts) {
    let mut results = Results::new(config, &plan.tests, reporter);
    plan.broken
        .into_iter()
        .for_each(|outcome| results.add(outcome));
    let goes_on = |results: &Results<'_>| !(config.fail_fast && results.has_failure());
    if goes_on(&results) {
        let tasks = plan.jobs.into_iter().map(Task::Run).collect();
        work(config, tasks, &mut |message| {
            match message {
                Message::Finished(outcome) => results.add(*outcome),
                Message::Progress(test, found) => results.progress(&test, &found),
                Message::Collected(_) => {}
            }
            goes_on(&results)
        });
    }
    results.finish()
}

/// Loads every file to learn what tests it has.
fn plan(config: &Config) -> std::io::Result<Plan> {
    let files = find_files(&config.paths)?;
    let tasks = files.iter().cloned().map(Task::Collect).collect();
    let mut collected = Vec::new();
    work(config, tasks, &mut |message| {
        if let Message::Collected(collection) = message {
            collected.push(*collection);
        }
        true
    });
    Ok(Plan::new(config, collected))
}
