//! Batches: runs of a scene with different seeds and parameters, one row of results each.
//!
//! A parameter is a named parameter of the simulator (`sim.getNamedStringParam`), and so is a result: one whose name begins with `result.`
//! when the run ends. `store` keeps the rows in a folder, from which an interrupted batch goes on.

mod simulate;
mod store;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use capture::{Header, Tape};

pub(super) use simulate::{Job, simulate};
pub use store::{Store, StoreError};

use super::Config;
use super::captures::fact;
use super::case::{Outcome, Status, TestCase};
use super::workers::{Message, Task, work};

/// Named parameters that begin so are results.
const RESULT: &str = "result.";

/// A batch of runs.
#[derive(Debug, Clone)]
pub struct Batch {
    /// A scene, as for `swanilda run`.
    pub scene: PathBuf,
    /// The seeds of the simulator; every combination is run with each.
    pub seeds: Vec<u32>,
    /// Parameters with the values each takes; every combination is run.
    pub sweeps: Vec<(String, Vec<String>)>,
    /// Parameters that are the same in all runs.
    pub fixed: BTreeMap<String, String>,
    /// Simulated seconds after which a run is asked to end.
    pub time: Option<f64>,
    /// Simulated seconds up to which all runs are the same one.
    pub branch_at: Option<f64>,
}

/// One run of a batch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Run {
    /// From 1, in the order of the combinations.
    pub number: usize,
    /// The seed of the simulator.
    pub seed: u32,
    /// The swept parameters.
    pub params: Vec<(String, String)>,
}

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The run.
    pub run: Run,
    /// Description of the failure.
    pub error: Option<String>,
    /// Simulation steps.
    pub steps: u64,
    /// Simulated seconds.
    pub time: f64,
    /// The results by their names, without `result.`.
    pub results: BTreeMap<String, String>,
}

impl Batch {
    /// All runs: the seeds vary fastest, then the last parameter.
    pub fn runs(&self) -> Vec<Run> {
        let mut combinations = vec![Vec::new()];
        for (name, values) in &self.sweeps {
            let extend = |known: &Vec<(String, String)>| {
                let with =
                    |value: &String| [known.clone(), vec![(name.clone(), value.clone())]].concat();
                values.iter().map(with).collect::<Vec<_>>()
            };
            combinations = combinations.iter().flat_map(extend).collect();
        }
        let all = combinations
            .iter()
            .flat_map(|params| self.seeds.iter().map(move |&seed| (seed, params.clone())));
        all.enumerate()
            .map(|(i, (seed, params))| Run {
                number: i + 1,
                seed,
                params,
            })
            .collect()
    }
}

/// A run that is over.
#[derive(Debug)]
pub struct Finished<'a> {
    /// Its row.
    pub row: Row,
    /// The names of the parameters that it has read.
    pub params_read: &'a BTreeSet<String>,
    /// The capture of a run that has failed, where that was asked for.
    pub capture: Option<&'a Path>,
}

/// Runs what the store has no row of, as `config` says, and hands over each run that is over.
///
/// # Errors
/// When the scene cannot be read, in words.
pub fn run(
    config: &Config,
    batch: &Batch,
    runs: &[Run],
    done: &mut dyn FnMut(Finished<'_>),
) -> Result<(), String> {
    let scene = Arc::new(simulate::Scene::read(&batch.scene, &Tape::default())?);
    let task = |run: &Run| Task::Simulate(job(batch, run, &scene));
    let by_number: BTreeMap<usize, &Run> = runs.iter().map(|run| (run.number, run)).collect();
    work(config, runs.iter().map(task).collect(), &mut |message| {
        if let Message::Finished(outcome) = message
            && let Some(run) = by_number.get(&outcome.test.index)
        {
            done(Finished {
                row: row(run, &outcome),
                params_read: &outcome.params_read,
                capture: outcome.capture.as_deref(),
            });
        }
        true
    });
    Ok(())
}

/// Makes the run of a capture again, on its tape. Its outcome.
///
/// # Errors
/// When it is no capture of a run of this batch, or differs in what it reads first; in words.
pub fn replay(
    config: &Config,
    batch: &Batch,
    header: &Header,
    tape: &Tape,
) -> Result<Outcome, String> {
    let number = fact(header, simulate::RUN).and_then(|number| number.parse::<usize>().ok());
    let runs = batch.runs();
    let run = runs.iter().find(|run| Some(run.number) == number);
    let run = run.ok_or("it is no capture of a run")?;
    let place = fact(header, simulate::PLACE).ok_or("it does not say where its scene was")?;
    let scene = Arc::new(simulate::Scene::read(Path::new(place), tape)?);
    let stop = Arc::new(AtomicBool::new(false));
    let job = job(batch, run, &scene);
    Ok(simulate::simulate_on(config, &job, &stop, tape))
}

fn job(batch: &Batch, run: &Run, scene: &Arc<simulate::Scene>) -> Job {
    let fixed = batch.fixed.clone().into_iter();
    Job {
        case: Arc::new(case(batch, run)),
        scene: Arc::clone(scene),
        params: fixed.chain(run.params.iter().cloned()).collect(),
        time: batch.time,
    }
}

/// The results among the named parameters at the end of a run, by their names without `result.`.
pub fn results(params: impl IntoIterator<Item = (String, String)>) -> BTreeMap<String, String> {
    let result = |(name, value): (String, String)| {
        let name = name.strip_prefix(RESULT)?.to_owned();
        Some((name, value))
    };
    params.into_iter().filter_map(result).collect()
}

fn case(batch: &Batch, run: &Run) -> TestCase {
    let name = run
        .params
        .iter()
        .map(|(name, value)| format!("{name}={value}"))
        .collect();
    TestCase {
        index: run.number,
        name,
        seed: run.seed,
        ..TestCase::of_file(&batch.scene)
    }
}

fn row(run: &Run, outcome: &Outcome) -> Row {
    Row {
        run: run.clone(),
        error: (outcome.status != Status::Passed).then(|| {
            outcome
                .message
                .lines()
                .next()
                .unwrap_or_default()
                .to_owned()
        }),
        steps: outcome.steps,
        time: outcome.time,
        results: outcome.results.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::Batch;

    #[test]
    fn every_combination_is_run() {
        let sweep = |name: &str, values: &[&str]| {
            (
                name.to_owned(),
                values.iter().map(|v| (*v).to_owned()).collect(),
            )
        };
        let batch = Batch {
            scene: "a.lua".into(),
            seeds: vec![4, 5],
            sweeps: vec![sweep("kp", &["1", "2"]), sweep("kd", &["x", "y", "z"])],
            fixed: Default::default(),
            time: None,
            branch_at: None,
        };
        let runs = batch.runs();
        assert_eq!(runs.len(), 12);
        assert_eq!((runs[0].seed, runs[1].seed), (4, 5));
        assert_eq!(
            runs[2].params,
            [("kp".to_owned(), "1".to_owned()), ("kd".into(), "y".into())]
        );
        assert!(runs.iter().enumerate().all(|(i, run)| run.number == i + 1));
    }
}
