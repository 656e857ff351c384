//! Ownership of golden files by tests.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::super::case::Outcome;

/// The first test that has used each file, by its number in its file.
#[derive(Debug, Default)]
pub(crate) struct Claims(BTreeMap<PathBuf, usize>);

impl Claims {
    /// Fails a test that uses the file of another one before it: two tests cannot both say what is right. Tests come in the order of their file.
    pub(crate) fn assign(&mut self, outcome: &mut Outcome) {
        let own = outcome.test.index;
        let mut taken = None;
        for comparison in &outcome.comparisons {
            if *self.0.entry(comparison.path.clone()).or_insert(own) != own {
                taken = taken.or(Some(comparison.name.clone()));
            }
        }
        if let Some(name) = taken {
            outcome.fail(&format!(
                "golden '{name}' is the name of another test's recording: choose another."
            ));
        }
    }
}
