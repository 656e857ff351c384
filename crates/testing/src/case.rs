//! A test, and how it ended.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::excerpt::Excerpt;
use super::golden::Comparison;
use super::property::{PropertyOptions, PropertyReport};
use script::coverage::LineCounts;
use script::test_bench::{ConsoleLine, Golden};
use script::test_cases::Signal;

/// One test of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TestCase {
    /// The file of the test, as the user named it or as it was found.
    pub file: PathBuf,
    /// Its number in the file, from 1; 0 for the file itself.
    pub index: usize,
    /// The names of its groups, then its own.
    pub name: Vec<String>,
    /// Where it begins, if known.
    pub line: Option<u32>,
    /// Which of its repetitions, from 0.
    pub repetition: u32,
    /// Seed of its simulator.
    pub seed: u32,
    /// What it says about its cases, if it is a property.
    pub property: Option<PropertyOptions>,
}

impl TestCase {
    /// The case of a file itself.
    pub(super) fn of_file(file: &Path) -> Self {
        Self {
            file: file.to_owned(),
            index: 0,
            name: vec!["(file)".into()],
            line: None,
            repetition: 0,
            seed: 0,
            property: None,
        }
    }

    /// The names in one line.
    pub fn title(&self) -> String {
        let title = self.name.join(" ");
        if self.repetition == 0 {
            title
        } else {
            format!("{title} (seed {})", self.seed)
        }
    }

    /// `file::title`, what filters look at.
    pub fn id(&self) -> String {
        format!("{}::{}", self.file.display(), self.title())
    }

    /// A name for files about it, without their extension: the file of the test, its number and its title, without what file systems treat in
    /// a special way.
    pub fn file_stem(&self) -> String {
        const MAX_LENGTH: usize = 80;
        let stem = self.file.file_stem().unwrap_or_default().to_string_lossy();
        let title = self.name.join("-");
        let text = format!("{stem}-{}-{}-{title}", self.index, self.repetition);
        let plain = text
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() { c } else { '-' });
        plain.take(MAX_LENGTH).collect()
    }

    /// Orders tests as files have them.
    pub fn key(&self) -> (PathBuf, usize, u32) {
        (self.file.clone(), self.index, self.repetition)
    }
}

/// How a test ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// All its assertions held.
    Passed,
    /// An assertion did not hold.
    Failed,
    /// Something else went wrong.
    Error,
    /// It is to be written, or not to be run.
    Pending,
}

/// A test that is over.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The test.
    pub test: Arc<TestCase>,
    /// How it ended.
    pub status: Status,
    /// Description of the failure, or why it is pending.
    pub message: String,
    /// Pending since it is yet to be written; else since it ended itself.
    pub todo: bool,
    /// Lua's traceback.
    pub trace: String,
    /// The line of the test's file where it went wrong.
    pub line: Option<u32>,
    /// Where it was when it had to be stopped.
    pub(super) stopped_at: Option<String>,
    /// The path of the script of the scene that raised an error.
    pub script: Option<String>,
    /// The source where it went wrong: of the script, then of the test.
    pub excerpts: Vec<Excerpt>,
    /// Simulated time when it ended, seconds.
    pub time: f64,
    /// Simulation steps of its simulator.
    pub steps: u64,
    /// How long it took by the wall clock.
    pub wall: Duration,
    /// What it and its scripts printed.
    pub console: Vec<ConsoleLine>,
    /// Recordings of the test, until they are compared.
    pub(super) goldens: Vec<Golden>,
    /// Its recordings, compared with their golden files.
    pub comparisons: Vec<Comparison>,
    /// The page that plays what happened, where failures are recorded.
    pub recording: Option<PathBuf>,
    /// The file from which it can be run again, where failures are captured.
    pub capture: Option<PathBuf>,
    /// Temporal properties over time.
    pub signals: Vec<Signal>,
    /// What is known of it, if it is a property.
    pub property: Option<PropertyReport>,
    /// Results of a run of a batch.
    pub results: BTreeMap<String, String>,
    /// The names of the parameters that a batch's run has read.
    pub params_read: BTreeSet<String>,
    /// The lines that ran, where they are counted.
    pub line_counts: LineCounts,
}

impl Outcome {
    /// A test that ended so, of which nothing else is known yet.
    pub fn new(test: Arc<TestCase>, status: Status, message: impl Into<String>) -> Self {
        Self {
            test,
            status,
            message: message.into(),
            todo: false,
            trace: String::new(),
            line: None,
            stopped_at: None,
            script: None,
            excerpts: Vec::new(),
            time: 0.0,
            steps: 0,
            wall: Duration::ZERO,
            console: Vec::new(),
            goldens: Vec::new(),
            comparisons: Vec::new(),
            recording: None,
            capture: None,
            signals: Vec::new(),
            property: None,
            results: BTreeMap::new(),
            params_read: BTreeSet::new(),
            line_counts: LineCounts::default(),
        }
    }

    /// Makes it a failure, besides what it is already.
    pub(super) fn fail(&mut self, message: &str) {
        if !self.is_bad() {
            self.status = Status::Failed;
            self.message.clear();
        }
        if !self.message.is_empty() {
            self.message.push('\n');
        }
        self.message.push_str(message);
    }

    /// Whether it counts against the run.
    pub fn is_bad(&self) -> bool {
        matches!(self.status, Status::Failed | Status::Error)
    }
}
