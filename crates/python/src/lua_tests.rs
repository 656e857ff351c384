//! Tests in Lua, for pytest: what a file has, and how they went.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use pyo3::prelude::*;
use testing::{self, Allowance, Config, Outcome, Reporter, Status};

/// Bytes that the scripts of a test may have.
const MEMORY: usize = 1024 << 20;

/// Number (0: the file itself), name and line of each test of a file.
#[pyfunction]
pub fn list_tests(py: Python<'_>, file: PathBuf) -> PyResult<Vec<(usize, String, Option<u32>)>> {
    let tests = py.detach(|| testing::list(&config(file, 60.0)))?;
    Ok(tests
        .iter()
        .map(|test| (test.index, test.title(), test.line))
        .collect())
}

/// Runs a file's tests: number, name, status (`passed`, `failed`, `error` or `pending`), message and traceback of each, and what it printed.
#[pyfunction]
#[pyo3(signature = (file, timeout=60.0))]
#[expect(clippy::type_complexity, reason = "a row of a table for Python")]
pub fn run_tests(
    py: Python<'_>,
    file: PathBuf,
    timeout: f64,
) -> PyResult<Vec<(usize, String, &'static str, String, String)>> {
    struct Quiet;
    impl Reporter for Quiet {
        fn outcome(&mut self, _: &Outcome) {}
    }
    let summary = py.detach(|| testing::run(&config(file, timeout), &mut Quiet))?;
    let row = |outcome: Outcome| {
        let status = match outcome.status {
            Status::Passed => "passed",
            Status::Failed => "failed",
            Status::Error => "error",
            Status::Pending => "pending",
        };
        (
            outcome.test.index,
            outcome.test.title(),
            status,
            outcome.message,
            outcome.trace,
        )
    };
    Ok(summary.outcomes.into_iter().map(row).collect())
}

fn config(file: PathBuf, timeout: f64) -> Config {
    let wall = Duration::try_from_secs_f64(timeout).unwrap_or(Duration::MAX);
    let allowance = Allowance {
        wall,
        simulated: f64::INFINITY,
        memory: MEMORY,
    };
    Config {
        paths: vec![file],
        ..Config::new(1, allowance, Arc::default())
    }
}
