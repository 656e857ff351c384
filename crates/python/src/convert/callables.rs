//! Functions of Python that the simulator calls by name.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use scene::Data;

use crate::convert;

/// How the names begin; `lua/library/swanilda/calls.lua` knows them by it.
const PREFIX: &str = "native function ";

/// The callables that one script has passed to the simulator. They live as long as the script: the simulator may call them at any time.
#[derive(Default)]
pub struct Callables {
    by_name: RefCell<BTreeMap<String, Py<PyAny>>>,
    count: Cell<usize>,
}

impl Callables {
    /// The name of a callable; the same one for the same callable.
    pub fn name_of(&self, callable: &Bound<'_, PyAny>) -> PyResult<String> {
        let known = {
            let by_name = self.by_name.borrow();
            let mut all = by_name.iter();
            // Methods are new objects each time, and equal.
            all.find(|(_, known)| known.bind(callable.py()).eq(callable).unwrap_or(false))
                .map(|(name, _)| name.clone())
        };
        if let Some(name) = known {
            return Ok(name);
        }
        self.count.set(self.count.get() + 1);
        let label = callable
            .getattr("__name__")
            .and_then(|name| name.extract::<String>())
            .unwrap_or_default();
        let name = format!("{PREFIX}{} {label}", self.count.get());
        self.by_name
            .borrow_mut()
            .insert(name.clone(), callable.clone().unbind());
        Ok(name)
    }

    /// The callable of that name.
    pub fn get(&self, py: Python<'_>, name: &str) -> Option<Py<PyAny>> {
        self.by_name
            .borrow()
            .get(name)
            .map(|callable| callable.clone_ref(py))
    }

    /// Whether there is a callable of that name.
    pub fn contains(&self, name: &str) -> bool {
        self.by_name.borrow().contains_key(name)
    }
}

/// Calls a callable: None is no result, a tuple is several.
pub fn call(
    py: Python<'_>,
    callable: &Bound<'_, PyAny>,
    args: &[Data],
    callables: &Callables,
) -> PyResult<Vec<Data>> {
    let result = callable.call1(convert::tuple(py, args.to_vec())?)?;
    if result.is_none() {
        return Ok(Vec::new());
    }
    match result.cast::<PyTuple>() {
        Ok(several) => convert::arguments(several, callables),
        Err(_) => Ok(vec![convert::to_data(&result, callables, 0)?]),
    }
}
