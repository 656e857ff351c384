//! Errors as exceptions.

use pyo3::create_exception;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;

create_exception!(
    swanilda,
    Error,
    PyException,
    "An error of the simulator, in the words that scripts receive."
);

/// The exception for an error of the function `name`.
pub fn in_function(name: &str, error: &swanilda::Error) -> PyErr {
    Error::new_err(format!("in {name}: {error}"))
}

/// The exception for an error of the simulator.
pub fn plain(error: &swanilda::Error) -> PyErr {
    Error::new_err(error.to_string())
}

/// An exception as text, with its traceback.
pub fn text(py: Python<'_>, error: &PyErr) -> String {
    let traceback = error
        .traceback(py)
        .and_then(|traceback| traceback.format().ok())
        .unwrap_or_default();
    format!("{traceback}{error}")
}
