//! Outcomes of the tests of a run, in the order of reports.
//!
//! An outcome is reported at once. Only one with recordings waits until the tests before it in its file are over: a recording belongs to the first
//! test of that name, whichever ends first.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::case::{Outcome, TestCase};
use super::golden::{self, Claims};
use super::{Config, Reporter};
use script::coverage::LineCounts;

/// Takes what comes back from the tests.
pub(super) struct Results<'a> {
    config: &'a Config,
    reporter: &'a mut dyn Reporter,
    /// Tests that are not over.
    open: BTreeSet<Key>,
    /// Outcomes with recordings that wait for tests before them.
    waiting: Vec<Outcome>,
    claims: Claims,
    reported: Vec<Outcome>,
    has_failure: bool,
    counts: LineCounts,
}

/// Orders tests as files have them.
type Key = (PathBuf, usize, u32);

impl<'a> Results<'a> {
    /// For these tests, of which none is over.
    pub(super) fn new(
        config: &'a Config,
        tests: &[Arc<TestCase>],
        reporter: &'a mut dyn Reporter,
    ) -> Self {
        let open = tests.iter().map(|test| test.key()).collect();
        Self {
            config,
            reporter,
            open,
            waiting: Vec::new(),
            claims: Claims::default(),
            reported: Vec::new(),
            has_failure: false,
            counts: LineCounts::default(),
        }
    }

    /// The search of a property goes on.
    pub(super) fn progress(&mut self, test: &TestCase, found: &search::Found) {
        self.reporter.progress(test, found);
    }

    /// A test is over.
    pub(super) fn add(&mut self, mut outcome: Outcome) {
        self.counts.merge(std::mem::take(&mut outcome.line_counts));
        self.open.remove(&outcome.test.key());
        golden::judge(&mut outcome, self.config.update_golden);
        self.has_failure |= outcome.is_bad();
        let file = outcome.test.file.clone();
        if outcome.comparisons.is_empty() {
            self.report(outcome);
        } else {
            self.waiting.push(outcome);
        }
        let first_open = self.first_open(&file);
        self.report_waiting(|outcome| {
            outcome.test.file == file
                && first_open
                    .as_ref()
                    .is_none_or(|first| outcome.test.key() < *first)
        });
    }

    /// The first test of a file that is not over.
    fn first_open(&self, file: &Path) -> Option<Key> {
        self.open
            .range((file.to_owned(), 0, 0)..)
            .next()
            .filter(|(of, _, _)| of.as_path() == file)
            .cloned()
    }

    /// Reports the waiting outcomes whose turn it is, in the order of their files.
    fn report_waiting(&mut self, is_due: impl Fn(&Outcome) -> bool) {
        let (mut due, waiting) = std::mem::take(&mut self.waiting)
            .into_iter()
            .partition::<Vec<_>, _>(is_due);
        self.waiting = waiting;
        due.sort_by_key(|outcome| outcome.test.key());
        for mut outcome in due {
            self.claims.assign(&mut outcome);
            if self.config.update_golden {
                golden::record(&mut outcome);
            }
            golden::draw(&mut outcome, &self.config.artifacts);
            self.report(outcome);
        }
    }

    fn report(&mut self, outcome: Outcome) {
        self.has_failure |= outcome.is_bad();
        self.reporter.outcome(&outcome);
        self.reported.push(outcome);
    }

    /// Whether a test has failed, reported or not.
    pub(super) fn has_failure(&self) -> bool {
        self.has_failure
    }

    /// No test that is open will come to its end. The outcomes in the order of the files, and what lines ran.
    pub(super) fn finish(mut self) -> (Vec<Outcome>, LineCounts) {
        self.report_waiting(|_| true);
        self.reported.sort_by_key(|outcome| outcome.test.key());
        (self.reported, self.counts)
    }
}
