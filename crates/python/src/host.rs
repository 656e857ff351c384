//! Scripts of scenes that run in this Python.
//!
//! Python's objects know the calls of a script by a number: the calls themselves lie in a table of the simulator's thread, as simulators do.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use pyo3::exceptions::PySystemExit;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use swanilda::{EmbeddedScript, PythonHost, ScriptCalls};

use crate::errors::Error;
use crate::worlds::Shared;

thread_local! {
    static CALLS: RefCell<BTreeMap<u64, Rc<ScriptCalls>>> = const { RefCell::new(BTreeMap::new()) };
}

static COUNT: AtomicU64 = AtomicU64::new(1);

/// This Python, for one simulator.
pub struct ThisPython {
    pub shared: Rc<Shared>,
}

impl PythonHost for ThisPython {
    fn start(&self, modules: &[u8], calls: ScriptCalls) -> Result<Rc<dyn EmbeddedScript>, String> {
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        CALLS.with_borrow_mut(|all| all.insert(number, Rc::new(calls)));
        let script = attached(&self.shared, |py| {
            let start = py.import("swanilda._embedded")?.getattr("start")?;
            start
                .call1((PyBytes::new(py, modules), Calls { number }))
                .map(Bound::unbind)
        });
        let script = script.inspect_err(|_| forget(number))?;
        Ok(Rc::new(Embedded {
            script,
            number,
            shared: Rc::clone(&self.shared),
        }))
    }
}

/// What a script may call, for its modules in Python.
#[pyclass(frozen, module = "swanilda._swanilda")]
pub struct Calls {
    number: u64,
}

#[pymethods]
impl Calls {
    fn is_short(&self, name: &str) -> PyResult<bool> {
        Ok(calls(self.number)?.is_short(name))
    }

    /// Does what a message says; returns the answer.
    fn serve<'py>(&self, py: Python<'py>, message: &[u8]) -> PyResult<Bound<'py, PyBytes>> {
        let answer = py.detach(|| -> PyResult<_> { Ok(calls(self.number)?.serve(message)) })?;
        answer
            .map(|answer| PyBytes::new(py, &answer))
            .map_err(Error::new_err)
    }

    /// The same, while other threads wait.
    fn serve_at_once<'py>(&self, py: Python<'py>, message: &[u8]) -> PyResult<Bound<'py, PyBytes>> {
        let answer = calls(self.number)?.serve(message);
        answer
            .map(|answer| PyBytes::new(py, &answer))
            .map_err(Error::new_err)
    }
}

fn calls(number: u64) -> PyResult<Rc<ScriptCalls>> {
    let found = CALLS.try_with(|calls| calls.try_borrow().ok()?.get(&number).cloned());
    found.ok().flatten().ok_or_else(|| {
        Error::new_err("the script has ended, or this is not its simulator's process.")
    })
}

/// A script of a scene, an object of `swanilda_embedded`.
struct Embedded {
    script: Py<PyAny>,
    number: u64,
    shared: Rc<Shared>,
}

impl EmbeddedScript for Embedded {
    fn ask(&self, message: &[u8]) -> Result<Vec<u8>, String> {
        attached(&self.shared, |py| self.call(py, "ask", message)?.extract())
    }

    fn hand_over(&self, message: &[u8]) -> Result<(), String> {
        attached(&self.shared, |py| {
            self.call(py, "hand_over", message).map(drop)
        })
    }

    fn take(&self, limit: Duration) -> Result<Option<Vec<u8>>, String> {
        attached(&self.shared, |py| {
            self.script
                .bind(py)
                .call_method1("take", (limit.as_secs_f64(),))?
                .extract()
        })
    }

    fn close(&self) {
        // What is left undone ends with Python.
        let _ = attached(&self.shared, |py| {
            self.script.bind(py).call_method0("close").map(drop)
        });
        forget(self.number);
    }
}

impl Embedded {
    fn call<'py>(
        &self,
        py: Python<'py>,
        function: &str,
        message: &[u8],
    ) -> PyResult<Bound<'py, PyAny>> {
        self.script
            .bind(py)
            .call_method1(function, (PyBytes::new(py, message),))
    }
}

/// Works with Python. Ctrl-c and the like is raised where Python called the simulator.
fn attached<T>(shared: &Shared, work: impl FnOnce(Python<'_>) -> PyResult<T>) -> Result<T, String> {
    let result = Python::try_attach(|py| work(py).map_err(|error| noted(py, shared, error)));
    result.ok_or_else(|| "Python is ending.".to_owned())?
}

fn noted(py: Python<'_>, shared: &Shared, error: PyErr) -> String {
    let text = error.to_string();
    // The script was ended by the simulator, which knows why.
    if !error.is_instance_of::<PySystemExit>(py) {
        shared.exception.borrow_mut().get_or_insert(error);
    }
    text
}

fn forget(number: u64) {
    let removed = CALLS.try_with(|calls| calls.try_borrow_mut().ok()?.remove(&number));
    drop(removed);
}

/// In a new child process, which has copies of the scripts.
pub fn forget_after_fork() {
    let forgotten = CALLS.try_with(|calls| {
        calls
            .try_borrow_mut()
            .map(|mut calls| std::mem::take(&mut *calls))
    });
    if let Ok(Ok(calls)) = forgotten {
        std::mem::forget(calls);
    }
}
