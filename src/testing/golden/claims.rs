//! Which test a golden file belongs to.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::super::case::Outcome;

/// The tests that have used each file, by file and number in it.
#[derive(Debug, Default)]
pub(crate) struct Claims(BTreeMap<PathBuf, Vec<(PathBuf, usize)>>);

impl Claims {
    /// Notes the files a test has used.
    pub(crate) fn note(&mut self, outcome: &Outcome) {
        for comparison in &outcome.comparisons {
            let claimants = self.0.entry(comparison.path.clone()).or_default();
            let claimant = (outcome.test.file.clone(), outcome.test.index);
            if !claimants.contains(&claimant) {
                claimants.push(claimant);
            }
        }
    }

    /// Fails a test that uses the file of another one before it: two tests cannot both say what is right.
    pub(crate) fn settle(&self, outcome: &mut Outcome) {
        let own = (outcome.test.file.clone(), outcome.test.index);
        let taken = outcome.comparisons.iter().find(|comparison| {
            self.0.get(&comparison.path).and_then(|claimants| claimants.iter().min()).is_some_and(|first| *first != own)
        });
        if let Some(comparison) = taken {
            let message =
                format!("golden '{}' is the name of another test's recording: choose another.", comparison.name);
            outcome.fail(&message);
        }
    }
}
