//! Batches of runs for programs that spread them over machines: the library's runs and its store, one at a time.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use swanilda::Permissions;
use testing::batch::{self, Row, Run, Store};
use testing::{Allowance, Config};

use crate::errors::Error;

/// Bytes that the scripts of a run may have.
const MEMORY: usize = 4096 << 20;

/// A scene with seeds and parameters, as `swanilda batch` runs it.
#[pyclass(frozen, module = "swanilda._swanilda")]
pub struct Batch {
    batch: batch::Batch,
    runs: Vec<Run>,
    timeout: f64,
    unsafe_functions: bool,
    store: Mutex<Option<Store>>,
}

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(signature = (scene, seeds, sweeps, fixed, time=None, timeout=3600.0, unsafe_functions=true))]
    fn new(
        scene: PathBuf,
        seeds: Vec<u32>,
        sweeps: Vec<(String, Vec<String>)>,
        fixed: BTreeMap<String, String>,
        time: Option<f64>,
        timeout: f64,
        unsafe_functions: bool,
    ) -> PyResult<Self> {
        if !(0.0..=1e9).contains(&timeout) || time.is_some_and(|time| time.is_nan() || time < 0.0) {
            return Err(PyValueError::new_err(
                "time and timeout are numbers of seconds, zero or more",
            ));
        }
        let batch = batch::Batch {
            scene,
            seeds,
            sweeps,
            fixed,
            time,
            branch_at: None,
        };
        Ok(Self {
            runs: batch.runs(),
            batch,
            timeout,
            unsafe_functions,
            store: Mutex::default(),
        })
    }

    fn __len__(&self) -> usize {
        self.runs.len()
    }

    /// Opens or creates the folder of results; returns the numbers of the runs that are not done.
    #[pyo3(signature = (folder, force=false))]
    fn open(&self, py: Python<'_>, folder: PathBuf, force: bool) -> PyResult<Vec<usize>> {
        let store = Store::open(&folder, &self.batch, force)
            .map_err(|error| Error::new_err(error.to_string()))?;
        if let Some(notice) = &store.notice {
            let warnings = py.import("warnings")?;
            warnings.call_method1("warn", (notice,))?;
        }
        let missing = store
            .missing(&self.runs)
            .iter()
            .map(|run| run.number)
            .collect();
        self.with_slot(|slot| *slot = Some(store));
        Ok(missing)
    }

    /// Makes a run, from 1; returns its row as a line of JSON.
    fn simulate(&self, py: Python<'_>, number: usize) -> PyResult<String> {
        let run = self.run_of(number)?.clone();
        py.detach(|| {
            let permissions = if self.unsafe_functions {
                Permissions::all()
            } else {
                Permissions::none()
            };
            let allowance = Allowance {
                wall: Duration::from_secs_f64(self.timeout),
                simulated: f64::INFINITY,
                memory: MEMORY,
            };
            let config = Config {
                permissions,
                ..Config::new(1, allowance, Arc::default())
            };
            let mut line = None;
            batch::run(&config, &self.batch, &[run], &mut |finished| {
                line = Some(finished.row.line());
            })
            .map_err(Error::new_err)?;
            line.ok_or_else(|| Error::new_err("the run has no result."))
        })
    }

    /// The row of a run that could not be made, as a line of JSON.
    fn lost(&self, number: usize, reason: String) -> PyResult<String> {
        let run = self.run_of(number)?.clone();
        Ok(Row {
            run,
            error: Some(reason),
            steps: 0,
            time: 0.0,
            results: BTreeMap::new(),
        }
        .line())
    }

    /// Keeps the row of a line; false when it is there already.
    fn add(&self, line: &str) -> PyResult<bool> {
        self.with_store(|store| {
            store
                .add_line(line, &self.runs)
                .map_err(|error| Error::new_err(error.to_string()))
        })
    }

    /// Writes the table of all rows; returns its path.
    fn finish(&self) -> PyResult<PathBuf> {
        self.with_store(|store| {
            store
                .finish()
                .map_err(|error| Error::new_err(error.to_string()))
        })
    }

    /// How many runs failed.
    fn failed(&self) -> PyResult<usize> {
        self.with_store(|store| Ok(store.failed()))
    }
}

impl Batch {
    fn run_of(&self, number: usize) -> PyResult<&Run> {
        let run = number.checked_sub(1).and_then(|at| self.runs.get(at));
        run.ok_or_else(|| PyValueError::new_err(format!("there is no run {number}")))
    }

    fn with_slot<T>(&self, work: impl FnOnce(&mut Option<Store>) -> T) -> T {
        work(&mut self.store.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn with_store<T>(&self, work: impl FnOnce(&mut Store) -> PyResult<T>) -> PyResult<T> {
        self.with_slot(|slot| {
            work(
                slot.as_mut()
                    .ok_or_else(|| Error::new_err("open() the folder of results first."))?,
            )
        })
    }
}
