//! Captures of failed tests and runs: files from which `swanilda replay` runs one again, with all that came from outside.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use capture::{Header, Tape};
use script::test_cases::CaseSource;
use search::Value;
use tempfile::NamedTempFile;

use super::Config;
use super::case::{Outcome, TestCase};
use super::property::plan_of;
use super::session::Session;

/// Where captures of failed tests go, and how this program was started.
#[derive(Debug, Clone)]
pub struct Captures {
    /// The folder for them; made for the first one.
    pub folder: PathBuf,
    /// What each of them begins with.
    pub header: Header,
}

/// Facts of a capture's header.
const FILE: &str = "test file";
const TESTS: &str = "tests";
const CHOICES: &str = "choices";

/// A simulator of tests, or the one of a run, that is being captured. What was captured is removed when this is dropped, unless something has
/// failed.
pub(super) struct TestCapture {
    tape: Tape,
    file: NamedTempFile,
    folder: PathBuf,
    /// The place of the capture, once a test has failed.
    kept: Option<PathBuf>,
}

impl TestCapture {
    /// Of a simulator that will run those tests of a file; of a property, the case with these choices.
    ///
    /// # Errors
    /// When there is no place for it.
    pub(super) fn start(
        captures: &Captures,
        file: &Path,
        tests: &[Arc<TestCase>],
        choices: Option<&[Value]>,
    ) -> io::Result<Self> {
        let tests: Vec<String> = tests.iter().map(|test| numbers(test)).collect();
        let file = file.to_string_lossy().into_owned();
        let facts = [(FILE, file), (TESTS, tests.join(","))];
        match choices {
            None => Self::of_facts(captures, facts),
            Some(choices) => {
                let [file, tests] = facts;
                Self::of_facts(captures, [file, tests, (CHOICES, search::text_of(choices))])
            }
        }
    }

    /// Of the simulator that these facts are about.
    ///
    /// # Errors
    /// When there is no place for it.
    pub(super) fn of_facts<const N: usize>(
        captures: &Captures,
        facts: [(&str, String); N],
    ) -> io::Result<Self> {
        let place = NamedTempFile::new()?;
        let mut header = captures.header.clone();
        let facts = facts.map(|(name, value)| (name.to_owned(), value));
        header.facts.extend(facts);
        Ok(Self {
            tape: Tape::capturing(place.path(), &header)?,
            file: place,
            folder: captures.folder.clone(),
            kept: None,
        })
    }

    pub(super) fn tape(&self) -> &Tape {
        &self.tape
    }

    /// Says in the outcome of a failed test where the capture will be.
    pub(super) fn note(&mut self, outcome: &mut Outcome) {
        if outcome.is_bad() {
            let place = || self.folder.join(outcome.test.file_stem() + ".swc");
            outcome.capture = Some(self.kept.get_or_insert_with(place).clone());
        }
    }
}

impl Drop for TestCapture {
    fn drop(&mut self) {
        let Some(kept) = &self.kept else { return };
        // The outcome has the path: it is missing where the file could not be written.
        let _ = self
            .tape
            .finish()
            .and_then(|_| std::fs::create_dir_all(&self.folder))
            .and_then(|()| std::fs::copy(self.file.path(), kept));
    }
}

/// `index:repetition:seed`.
fn numbers(test: &TestCase) -> String {
    format!("{}:{}:{}", test.index, test.repetition, test.seed)
}

/// What a header says about that.
pub(super) fn fact<'a>(header: &'a Header, name: &str) -> Option<&'a str> {
    let found = header.facts.iter().find(|(fact, _)| fact == name);
    found.map(|(_, value)| value.as_str())
}

/// Runs the tests of a capture again, on its tape. Their outcomes.
///
/// # Errors
/// When it is no capture of tests; in words.
pub fn replay(config: &Config, header: &Header, tape: &Tape) -> Result<Vec<Outcome>, String> {
    let file = PathBuf::from(fact(header, FILE).ok_or("it is no capture of a test")?);
    let tests = fact(header, TESTS).unwrap_or_default().split(',');
    let tests: Option<Vec<_>> = tests.map(|numbers| test_of(&file, numbers)).collect();
    let tests = tests.ok_or("its tests have no numbers")?;
    let seed = tests.first().map_or(config.seed, |test| test.seed);
    let stop = Arc::new(AtomicBool::new(false));
    let mut session = Session::new(config, &file, seed, stop, tape);
    if let Some(choices) = fact(header, CHOICES) {
        let choices = search::values_of(choices).ok_or("its choices are no list of numbers")?;
        session.take_cases_from(CaseSource::Single(plan_of(&choices)));
    }
    let only = (tests.len() == 1).then_some(tests[0].index);
    if let Err(broken) = session.load(&file, None, only) {
        return Ok(vec![*broken]);
    }
    let mut outcomes: Vec<_> = tests.iter().map(|test| session.run(test)).collect();
    if let Some(last) = outcomes.last_mut() {
        session.finish(last);
    }
    Ok(outcomes)
}

fn test_of(file: &Path, numbers: &str) -> Option<Arc<TestCase>> {
    let mut numbers = numbers.split(':').map(str::parse::<u32>);
    let mut number = || numbers.next()?.ok();
    Some(Arc::new(TestCase {
        index: usize::try_from(number()?).ok()?,
        repetition: number()?,
        seed: number()?,
        ..TestCase::of_file(file)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_come_back_by_their_numbers() {
        let file = Path::new("a_test.lua");
        let test = TestCase {
            index: 3,
            repetition: 1,
            seed: 4_000_000_000,
            ..TestCase::of_file(file)
        };
        assert_eq!(test_of(file, &numbers(&test)).as_deref(), Some(&test));
        for bad in ["", "1", "1:2", "1:2:x", "-1:0:0"] {
            assert!(test_of(file, bad).is_none(), "{bad}");
        }
        assert_eq!(test.file_stem(), "a-test-3-1--file-");
    }
}
