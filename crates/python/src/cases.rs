//! The cases of a property in Python: a search on a thread of its own proposes them, and learns how each ended.

use std::path::PathBuf;
use std::sync::Arc;
use std::thread::JoinHandle;

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use search::{
    Budget, Case, CaseEnd, Domain, Failures, Found, KnownFailure, Plan, Rest, Server, Settings,
    Status, Value, WorkersGone,
};

/// The cases of a property, one after the other.
#[pyclass(module = "swanilda._swanilda", unsendable)]
pub struct Cases {
    server: Arc<Server>,
    thread: Option<JoinHandle<Result<Found, WorkersGone>>>,
    running: Option<(usize, Case)>,
    failures: Failures,
    test: String,
}

#[pymethods]
impl Cases {
    /// The cases of a test, whose failures are kept in that folder.
    #[new]
    fn new(test: String, folder: PathBuf, cases: usize, shrinks: usize, seed: u64) -> Self {
        let failures = Failures::new(folder);
        let known = failures.load(&test).map(|failure| failure.choices);
        let settings = Settings {
            seed,
            budget: Budget { cases, shrinks },
            known: known.into_iter().collect(),
        };
        let server = Arc::new(Server::new(1, || {}));
        let served = Arc::clone(&server);
        let thread = std::thread::spawn(move || {
            let mut evaluate = &*served;
            let found = search::search(&settings, &mut evaluate, &mut || false, &mut |_, _| {});
            served.close();
            found
        });
        Self {
            server,
            thread: Some(thread),
            running: None,
            failures,
            test,
        }
    }

    /// Begins the next case; False when there are no more.
    fn next(&mut self, py: Python<'_>) -> bool {
        let server = Arc::clone(&self.server);
        let next = py.detach(move || server.next(|| false));
        self.running = next.map(|(number, plan)| (number, Case::new(plan)));
        self.running.is_some()
    }

    /// Begins the case with these choices, which is reported to nobody.
    fn repeat(&mut self, choices: Vec<Number>) {
        let values = choices.into_iter().map(Number::value).collect();
        let rest = Rest::Simplest;
        self.running = Some((0, Case::new(Plan { values, rest })));
    }

    fn choose_integer(&mut self, min: i64, max: i64, simplest: i64) -> PyResult<i64> {
        match self.choose(Domain::Integer { min, max, simplest })? {
            Value::Integer(value) => Ok(value),
            Value::Float(value) => Ok(value as i64),
        }
    }

    fn choose_float(&mut self, min: f64, max: f64, simplest: f64) -> PyResult<f64> {
        let value = self.choose(Domain::Float { min, max, simplest })?;
        Ok(value.as_float())
    }

    /// Whether a list has one more element.
    fn follows(&mut self, probability: f64) -> PyResult<bool> {
        Ok(self.choose(Domain::Follows { probability })? == Value::Integer(1))
    }

    /// Begins or ends choices that belong together.
    fn span(&mut self, begins: bool) {
        let Some((_, case)) = &mut self.running else {
            return;
        };
        if begins {
            case.begin_span();
        } else {
            case.end_span();
        }
    }

    /// Ends the case.
    fn finish(&mut self, status: &str, place: String, robustness: f64) -> PyResult<()> {
        let status = match status {
            "passed" => Status::Passed,
            "failed" => Status::Failed,
            "discarded" => Status::Discarded,
            _ => {
                return Err(PyValueError::new_err(
                    "a case is passed, failed or discarded",
                ));
            }
        };
        let (number, case) = self.running.take().ok_or_else(no_case)?;
        let report = case.finish(CaseEnd {
            status,
            place,
            robustness,
            covered: Vec::new(),
        });
        self.server.finish(number, report);
        Ok(())
    }

    /// What was found: cases, runs that shrinking took, and the choices of the simplest failing case or None.
    fn result(&mut self, py: Python<'_>) -> PyResult<(usize, usize, Option<Vec<Number>>)> {
        let thread = self.thread.take();
        let thread = thread.ok_or_else(|| PyRuntimeError::new_err("the result was taken"))?;
        let ended = py.detach(move || thread.join());
        let found = ended.ok().and_then(Result::ok);
        let found = found.ok_or_else(|| PyRuntimeError::new_err("the search was left"))?;
        let simplest = found.simplest.map(|report| report.values());
        if simplest.is_none() {
            self.failures.remove(&self.test);
        }
        let simplest = simplest.map(|values| values.into_iter().map(Number::of).collect());
        Ok((found.cases, found.shrinks, simplest))
    }

    /// Keeps a failing case, which comes first the next time.
    fn keep(&self, message: String, choices: Vec<Number>) -> PyResult<PathBuf> {
        let failure = KnownFailure {
            test: self.test.clone(),
            message,
            choices: choices.into_iter().map(Number::value).collect(),
        };
        Ok(self.failures.save(&failure)?)
    }
}

impl Cases {
    fn choose(&mut self, domain: Domain) -> PyResult<Value> {
        let (_, case) = self.running.as_mut().ok_or_else(no_case)?;
        let value = case.choose(domain);
        value.ok_or_else(|| PyRuntimeError::new_err("a case draws at most 10000 values"))
    }
}

fn no_case() -> PyErr {
    PyRuntimeError::new_err("values are drawn while a case runs")
}

impl Drop for Cases {
    /// The search ends, whether it has come to its end or not.
    fn drop(&mut self) {
        if let Some((_, case)) = self.running.take() {
            self.server.give_up(case.values());
        }
        self.server.leave();
        self.server.close();
    }
}

/// A whole number or another one, as Python has it.
#[derive(FromPyObject, IntoPyObject)]
enum Number {
    Integer(i64),
    Float(f64),
}

impl Number {
    fn of(value: Value) -> Self {
        match value {
            Value::Integer(value) => Self::Integer(value),
            Value::Float(value) => Self::Float(value),
        }
    }

    fn value(self) -> Value {
        match self {
            Self::Integer(value) => Value::Integer(value),
            Self::Float(value) => Value::Float(value),
        }
    }
}
