//! Values between Python and the simulator.
//!
//! Bytes become buffers; lists, tuples and arrays become lists; a callable becomes the name under which the simulator calls it.
//! Back: text that is not UTF-8 and buffers are bytes, lists are lists, tables are dictionaries.

pub mod arrays;
pub mod callables;

use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{
    PyBool, PyByteArray, PyBytes, PyDict, PyFloat, PyInt, PyList, PyMemoryView, PyString, PyTuple,
};
use scene::{Data, Key};

use crate::convert::callables::Callables;

/// Levels of lists and dictionaries.
const MAX_DEPTH: usize = 100;

/// The arguments of a call.
pub fn arguments(args: &Bound<'_, PyTuple>, callables: &Callables) -> PyResult<Vec<Data>> {
    args.iter()
        .map(|value| to_data(&value, callables, 0))
        .collect()
}

/// A value for the simulator.
pub fn to_data(value: &Bound<'_, PyAny>, callables: &Callables, depth: usize) -> PyResult<Data> {
    if let Ok(number) = value.cast_exact::<PyFloat>() {
        return Ok(Data::Float(number.value()));
    }
    if value.is_none() {
        return Ok(Data::Nil);
    }
    if let Ok(value) = value.cast::<PyBool>() {
        return Ok(Data::Bool(value.is_true()));
    }
    if value.is_instance_of::<PyInt>() {
        return value
            .extract()
            .map(Data::Int)
            .map_err(|_| PyOverflowError::new_err("an integer has at most 64 bits"));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Data::Text(text.to_str()?.as_bytes().to_vec()));
    }
    if depth > MAX_DEPTH {
        return Err(PyValueError::new_err(format!(
            "values are nested at most {MAX_DEPTH} levels deep"
        )));
    }
    if let Ok(list) = value.cast::<PyList>() {
        return list
            .iter()
            .map(|item| to_data(&item, callables, depth + 1))
            .collect::<PyResult<_>>()
            .map(Data::Array);
    }
    if let Ok(tuple) = value.cast::<PyTuple>() {
        return tuple
            .iter()
            .map(|item| to_data(&item, callables, depth + 1))
            .collect::<PyResult<_>>()
            .map(Data::Array);
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        let entries = dict
            .iter()
            .map(|(key, item)| Ok((to_key(&key)?, to_data(&item, callables, depth + 1)?)));
        return entries.collect::<PyResult<_>>().map(Data::Map);
    }
    other_to_data(value, callables, depth)
}

fn other_to_data(value: &Bound<'_, PyAny>, callables: &Callables, depth: usize) -> PyResult<Data> {
    if let Ok(bytes) = value.cast::<PyBytes>() {
        return Ok(Data::Buffer(bytes.as_bytes().to_vec()));
    }
    if let Ok(bytes) = value.cast::<PyByteArray>() {
        return Ok(Data::Buffer(bytes.to_vec()));
    }
    if value.is_instance_of::<PyMemoryView>() {
        return other_to_data(&value.call_method0("tobytes")?, callables, depth);
    }
    // Arrays and scalars of numpy, and what is like them.
    if value.hasattr("tolist")? {
        if let Some(list) = arrays::to_list(value)? {
            return Ok(list);
        }
        return to_data(&value.call_method0("tolist")?, callables, depth + 1);
    }
    if value.hasattr("__index__")? {
        return Ok(Data::Int(value.extract()?));
    }
    if value.is_instance_of::<PyFloat>() || value.hasattr("__float__")? {
        return Ok(Data::Float(value.extract()?));
    }
    if value.is_callable() {
        return Ok(Data::Text(callables.name_of(value)?.into_bytes()));
    }
    let ty = value.get_type();
    Err(PyTypeError::new_err(format!(
        "the simulator has no values of type {}",
        ty.name()?
    )))
}

fn to_key(key: &Bound<'_, PyAny>) -> PyResult<Key> {
    if let Ok(text) = key.cast::<PyString>() {
        return Ok(Key::Text(text.to_str()?.as_bytes().to_vec()));
    }
    if let Ok(value) = key.cast::<PyBool>() {
        return Ok(Key::Bool(value.is_true()));
    }
    if let Ok(number) = key.cast::<PyFloat>() {
        return Ok(Key::Float(number.value()));
    }
    key.extract()
        .map(Key::Int)
        .map_err(|_| PyTypeError::new_err("keys are text, numbers or booleans"))
}

/// The results of a call as Python has them: nothing is None, several are a tuple.
pub fn results(py: Python<'_>, results: Vec<Data>) -> PyResult<Py<PyAny>> {
    let mut results = results;
    match results.len() {
        0 => Ok(py.None()),
        1 => Ok(from_data(py, results.remove(0))?.unbind()),
        _ => Ok(tuple(py, results)?.into_any().unbind()),
    }
}

/// Several values.
pub fn tuple(py: Python<'_>, values: Vec<Data>) -> PyResult<Bound<'_, PyTuple>> {
    let values = values
        .into_iter()
        .map(|value| from_data(py, value))
        .collect::<PyResult<Vec<_>>>()?;
    PyTuple::new(py, values)
}

/// A value for Python.
pub fn from_data(py: Python<'_>, data: Data) -> PyResult<Bound<'_, PyAny>> {
    Ok(match data {
        Data::Nil => py.None().into_bound(py),
        Data::Bool(value) => PyBool::new(py, value).to_owned().into_any(),
        Data::Int(number) => number.into_pyobject(py)?.into_any(),
        Data::Float(number) => PyFloat::new(py, number).into_any(),
        Data::Text(text) => from_text(py, &text),
        Data::Buffer(bytes) => PyBytes::new(py, &bytes).into_any(),
        Data::Array(items) => {
            let items = items
                .into_iter()
                .map(|item| from_data(py, item))
                .collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_any()
        }
        Data::Map(entries) => {
            let dict = PyDict::new(py);
            for (key, value) in entries {
                dict.set_item(from_key(py, key)?, from_data(py, value)?)?;
            }
            dict.into_any()
        }
    })
}

fn from_key(py: Python<'_>, key: Key) -> PyResult<Bound<'_, PyAny>> {
    from_data(
        py,
        match key {
            Key::Bool(value) => Data::Bool(value),
            Key::Int(number) => Data::Int(number),
            Key::Float(number) => Data::Float(number),
            Key::Text(text) => Data::Text(text),
        },
    )
}

fn from_text<'py>(py: Python<'py>, text: &[u8]) -> Bound<'py, PyAny> {
    match std::str::from_utf8(text) {
        Ok(text) => PyString::new(py, text).into_any(),
        Err(_) => PyBytes::new(py, text).into_any(),
    }
}
