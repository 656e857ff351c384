//! Which tests run, and what runs together.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Config;
use super::case::{Outcome, TestCase};
use super::property::PropertyOptions;
use script::test_bench::CompiledFile;

/// Tests of a loaded file.
pub(super) struct Collection {
    pub file: PathBuf,
    pub tests: Vec<Found>,
    /// Whether it uses the simulator, so that each test needs one of its own.
    pub simulates: bool,
    /// The file as the simulators of its tests load it.
    pub compiled: Option<CompiledFile>,
    /// Set when it could not be loaded.
    pub broken: Option<Outcome>,
}

impl Collection {
    /// A file of which nothing is known yet.
    pub(super) fn new(file: &Path) -> Self {
        Self {
            file: file.to_owned(),
            tests: Vec::new(),
            simulates: true,
            compiled: None,
            broken: None,
        }
    }

    /// A file that could not be loaded.
    pub(super) fn broken(outcome: Outcome) -> Self {
        let file = Self::new(&outcome.test.file);
        Self {
            broken: Some(outcome),
            ..file
        }
    }
}

/// A test as declared in its file.
pub(super) struct Found {
    pub name: Vec<String>,
    pub line: Option<u32>,
    /// What it says about its cases, if it is a property.
    pub property: Option<PropertyOptions>,
}

/// Tests of one file that share a simulator.
#[derive(Debug, Clone)]
pub(super) struct Job {
    tests: Arc<[Arc<TestCase>]>,
    /// How many of them are over.
    done: usize,
    pub compiled: Option<CompiledFile>,
}

impl Job {
    fn new(tests: Vec<Arc<TestCase>>, compiled: Option<&CompiledFile>) -> Self {
        Self {
            tests: tests.into(),
            done: 0,
            compiled: compiled.cloned(),
        }
    }

    /// Without any tests.
    pub(super) fn none() -> Self {
        Self::new(Vec::new(), None)
    }

    /// The tests that are left.
    pub(super) fn left(&self) -> &[Arc<TestCase>] {
        &self.tests[self.done..]
    }

    /// The job without the first of the tests that are left.
    pub(super) fn rest(&self) -> Self {
        Self {
            done: self.tests.len().min(self.done + 1),
            ..self.clone()
        }
    }
}

/// The work to do.
pub(super) struct Plan {
    pub tests: Vec<Arc<TestCase>>,
    pub jobs: Vec<Job>,
    /// Files that could not be loaded.
    pub broken: Vec<Outcome>,
    pub deselected: usize,
}

impl Plan {
    pub(super) fn new(config: &Config, mut collected: Vec<Collection>) -> Self {
        collected.sort_by(|a, b| a.file.cmp(&b.file));
        let mut plan = Self {
            tests: Vec::new(),
            jobs: Vec::new(),
            broken: Vec::new(),
            deselected: 0,
        };
        let mut number = 0;
        for collection in collected {
            let mut chosen = Vec::new();
            for test in cases(config, &collection) {
                if is_chosen(config, &test, number) {
                    chosen.push(Arc::new(test));
                } else {
                    plan.deselected += 1;
                }
                number += 1;
            }
            plan.tests.extend(chosen.iter().cloned());
            plan.jobs.extend(jobs(config, chosen, &collection));
            plan.broken.extend(collection.broken);
        }
        plan
    }

    /// All tests that will have an outcome.
    pub(super) fn all(&self) -> Vec<Arc<TestCase>> {
        self.broken
            .iter()
            .map(|outcome| &outcome.test)
            .chain(&self.tests)
            .cloned()
            .collect()
    }
}

/// Every test as often as it is repeated.
fn cases(config: &Config, collection: &Collection) -> Vec<TestCase> {
    let repeat = |(i, found): (usize, &Found)| {
        let (file, name, line) = (collection.file.clone(), found.name.clone(), found.line);
        let case = TestCase {
            file,
            index: i + 1,
            name,
            line,
            repetition: 0,
            seed: config.seed,
            property: found.property,
        };
        (0..config.repeat.max(1)).map(move |repetition| TestCase {
            repetition,
            seed: config.seed.wrapping_add(repetition),
            ..case.clone()
        })
    };
    collection
        .tests
        .iter()
        .enumerate()
        .flat_map(repeat)
        .collect()
}

fn is_chosen(config: &Config, test: &TestCase, number: usize) -> bool {
    if let Some(only) = config.only {
        return (test.index, test.repetition) == only;
    }
    if config.search.is_some() && test.property.is_none() {
        return false;
    }
    let id = test.id();
    let named =
        config.filters.is_empty() || config.filters.iter().any(|filter| id.contains(filter));
    named
        && config
            .shard
            .is_none_or(|(part, parts)| number % parts + 1 == part)
}

/// Without a simulator, the tests of a file share their Lua state, each round one.
fn jobs(config: &Config, tests: Vec<Arc<TestCase>>, collection: &Collection) -> Vec<Job> {
    let job = |tests| Job::new(tests, collection.compiled.as_ref());
    if collection.simulates || config.isolate.is_some() {
        return tests.into_iter().map(|test| job(vec![test])).collect();
    }
    let round = |n| {
        tests
            .iter()
            .filter(|test| test.repetition == n)
            .cloned()
            .collect::<Vec<_>>()
    };
    let rounds = (0..config.repeat.max(1))
        .map(round)
        .filter(|round| !round.is_empty());
    rounds.map(job).collect()
}
