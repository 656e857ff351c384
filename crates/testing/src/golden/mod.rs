//! Golden recordings, traces and pictures: each is compared with an earlier one.

mod claims;
mod compare;
mod file;
#[cfg(feature = "plots")]
mod plot;
#[cfg(not(feature = "plots"))]
#[path = "plot_left_out.rs"]
mod plot;
mod snapshot;

use std::path::{Path, PathBuf};

pub(super) use claims::Claims;
pub use compare::{Difference, Divergence};
pub use snapshot::{ImageDifference, RecordedImage};

use super::case::{Outcome, Status, TestCase};
use script::test_bench::{Golden, GoldenContent, Snapshot, Tolerances, Trace};

const WRONG_NAME: &str = "a name is made of letters, digits, '_', '-' and blanks.";
const IF_RIGHT: &str = "If that is right, record it with --update-golden.";

/// A recording of a test and its golden file.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The name that the test has given it.
    pub name: String,
    /// The golden file.
    pub path: PathBuf,
    /// What was recorded now and before.
    pub recordings: Recordings,
    /// How they compare.
    pub result: ComparisonResult,
}

/// Recordings of a test, and the content of the file.
#[derive(Debug, Clone)]
pub enum Recordings {
    /// Samples of quantities over time.
    Traces {
        /// Of the test.
        actual: Trace,
        /// Of the file; None where there is none that can be read.
        expected: Option<Trace>,
    },
    /// Images of a vision sensor.
    Images {
        /// Of the test.
        actual: Snapshot,
        /// Of the file; None where there is none that can be read.
        expected: Option<RecordedImage>,
    },
}

/// The result of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub enum ComparisonResult {
    /// All values are within their tolerances.
    Equal,
    /// Traces that differ.
    Different(Difference),
    /// Images that differ.
    DifferentImage(ImageDifference),
    /// There is no file.
    Missing,
    /// The file or the trace cannot be used, for this reason.
    Unusable(String),
}

impl Comparison {
    /// Compares a recording with its file.
    pub(super) fn new(test: &TestCase, golden: Golden) -> Self {
        match golden.content {
            GoldenContent::Trace { trace, tolerances } => {
                Self::of_trace(test, golden.name, trace, &tolerances)
            }
            GoldenContent::Image(snapshot) => Self::of_image(test, golden.name, snapshot),
        }
    }

    fn of_trace(test: &TestCase, name: String, actual: Trace, tolerances: &Tolerances) -> Self {
        let path = path_of(&test.file, &name, "golden");
        let (expected, result) = match read(&path, &name, &actual) {
            Ok(Some(expected)) => {
                let result = compare::compare(&expected, &actual, tolerances);
                (
                    Some(expected),
                    result.map_or(ComparisonResult::Equal, ComparisonResult::Different),
                )
            }
            Ok(None) => (None, ComparisonResult::Missing),
            Err(reason) => (None, ComparisonResult::Unusable(reason)),
        };
        Self {
            name,
            path,
            recordings: Recordings::Traces { actual, expected },
            result,
        }
    }

    fn of_image(test: &TestCase, name: String, actual: Snapshot) -> Self {
        let path = path_of(&test.file, &name, "png");
        let recorded = if is_name(&name) {
            snapshot::read(&path)
        } else {
            Err(WRONG_NAME.into())
        };
        let (expected, result) = match recorded {
            Ok(Some(expected)) => {
                let result = snapshot::compare(&expected, &actual);
                (
                    Some(expected),
                    result.map_or(ComparisonResult::Equal, ComparisonResult::DifferentImage),
                )
            }
            Ok(None) => (None, ComparisonResult::Missing),
            Err(reason) => (None, ComparisonResult::Unusable(reason)),
        };
        Self {
            name,
            path,
            recordings: Recordings::Images { actual, expected },
            result,
        }
    }

    /// Whether it makes the test fail.
    pub fn is_bad(&self) -> bool {
        self.result != ComparisonResult::Equal
    }

    /// The message of a failure; None without one.
    pub fn message(&self) -> Option<String> {
        let about = format!("golden '{}' ({})", self.name, self.path.display());
        match &self.result {
            ComparisonResult::Equal => None,
            ComparisonResult::Missing => Some(format!(
                "{about}: there is no such file. Record it with --update-golden."
            )),
            ComparisonResult::Unusable(reason) => Some(format!("{about}: {reason}")),
            ComparisonResult::Different(difference) => {
                Some(format!("{about}: {difference}\n{IF_RIGHT}"))
            }
            ComparisonResult::DifferentImage(difference) => {
                Some(format!("{about}: {difference}\n{IF_RIGHT}"))
            }
        }
    }

    /// A plot of what was expected and what came, for those quantities that differ; None when there is nothing to compare, and for
    /// pictures.
    pub fn svg(&self) -> Option<String> {
        plot::svg(self)
    }

    /// The same picture as PNG. Of pictures: both of them, and where they differ; only if they do.
    pub fn png(&self) -> Option<Vec<u8>> {
        match &self.recordings {
            Recordings::Traces { .. } => plot::png(self),
            Recordings::Images { actual, expected } => {
                snapshot::png(expected.as_ref()?, actual).filter(|_| self.is_bad())
            }
        }
    }

    /// Records the trace, unless the file is right as it is.
    pub(super) fn record(&mut self) -> std::io::Result<()> {
        if matches!(self.result, ComparisonResult::Equal) || !is_name(&self.name) {
            return Ok(());
        }
        match &self.recordings {
            Recordings::Traces { actual, .. } => file::write(&self.path, actual)?,
            Recordings::Images { actual, .. } => snapshot::write(&self.path, actual)?,
        }
        self.result = ComparisonResult::Equal;
        Ok(())
    }
}

/// `drive_test.lua` and `lap` make `drive_test.lap.golden`, beside the test.
fn path_of(test: &Path, name: &str, extension: &str) -> PathBuf {
    let stem = test.file_stem().unwrap_or_default().to_string_lossy();
    test.with_file_name(format!("{stem}.{name}.{extension}"))
}

fn is_name(name: &str) -> bool {
    // No dots, so that no two test files share a recording.
    let fits = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | ' ');
    !name.is_empty() && name.len() <= 100 && name.chars().all(fits)
}

fn read(path: &Path, name: &str, actual: &Trace) -> Result<Option<Trace>, String> {
    if !is_name(name) {
        return Err(WRONG_NAME.into());
    }
    if actual.rows.is_empty() {
        return Err("nothing was recorded: the test made no step after t.golden.".into());
    }
    file::read(path)
}

/// Compares the recordings a test has left. One that is wrong fails the test; with `update` it is left for [`record`].
pub(super) fn judge(outcome: &mut Outcome, update: bool) {
    let goldens = std::mem::take(&mut outcome.goldens);
    outcome.comparisons = goldens
        .into_iter()
        .map(|golden| Comparison::new(&outcome.test, golden))
        .collect();
    let usable = |comparison: &&Comparison| {
        matches!(comparison.result, ComparisonResult::Unusable(_)) || !update
    };
    let messages: Vec<_> = outcome
        .comparisons
        .iter()
        .filter(usable)
        .filter_map(Comparison::message)
        .collect();
    if !messages.is_empty() && !outcome.is_bad() {
        outcome.fail(&messages.join("\n"));
    }
}

/// Writes the golden files of a test that passed. Of its repetitions, the first one counts.
pub(super) fn record(outcome: &mut Outcome) {
    if outcome.status != Status::Passed || outcome.test.repetition > 0 {
        return;
    }
    let failed = |c: &mut Comparison| {
        c.record()
            .err()
            .map(|error| format!("cannot write {}: {error}", c.path.display()))
    };
    let problems: Vec<_> = outcome.comparisons.iter_mut().filter_map(failed).collect();
    if !problems.is_empty() {
        outcome.fail(&problems.join("\n"));
    }
}

/// Writes pictures of differing recordings into `folder`; the message has their paths.
pub(super) fn draw(outcome: &mut Outcome, folder: &Path) {
    let mut notes = String::new();
    for comparison in outcome
        .comparisons
        .iter()
        .filter(|comparison| comparison.is_bad())
    {
        let Some(png) = comparison.png() else {
            continue;
        };
        let stem = outcome
            .test
            .file
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy();
        let path = folder.join(format!(
            "{stem}.{}.{}.png",
            comparison.name, outcome.test.seed
        ));
        match std::fs::create_dir_all(folder).and_then(|()| std::fs::write(&path, png)) {
            Ok(()) => notes += &format!("\nplot: {}", path.display()),
            Err(error) => notes += &format!("\ncannot write {}: {error}", path.display()),
        }
    }
    outcome.message.push_str(&notes);
}
