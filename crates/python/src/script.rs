//! Scripts whose functions are Python's.

use std::cell::RefCell;
use std::rc::Rc;

use pyo3::exceptions::PyStopIteration;
use pyo3::prelude::*;
use scene::Data;
use swanilda::{Caller, NativeScript};

use crate::convert::callables::{self, Callables};
use crate::worlds::{Shared, Speaker};
use crate::{convert, errors};

/// Python's main program: functions that it passed to the simulator. Their exceptions are raised where it called the simulator; they do
/// not end it.
pub struct MainProgram {
    pub callables: Rc<Callables>,
    pub shared: Rc<Shared>,
}

impl NativeScript for MainProgram {
    fn is_stateless(&self) -> bool {
        // Its functions are the program's, which calls the simulator.
        true
    }

    fn defines(&self, function: &str) -> bool {
        self.callables.contains(function)
    }

    fn call(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        let called = Python::try_attach(|py| {
            let Some(callable) = self.callables.get(py, function) else {
                return Vec::new();
            };
            callables::call(py, callable.bind(py), args, &self.callables).unwrap_or_else(|error| {
                self.shared.exception.borrow_mut().get_or_insert(error);
                Vec::new()
            })
        });
        called.ok_or_else(|| "Python is ending.".to_owned())
    }
}

/// A module, an object or an instance of a class whose functions have the names of callbacks.
pub struct PythonScript {
    object: Py<PyAny>,
    speaker: Rc<Speaker>,
    shared: Rc<Shared>,
    thread: RefCell<Thread>,
}

/// The generator of `sysCall_thread`, which waits for a step at each `yield`.
enum Thread {
    NotStarted,
    Waiting(Py<PyAny>),
    Ended,
}

impl PythonScript {
    /// Makes the object of a script that starts: `create` gets its handle.
    pub fn start(
        caller: Caller,
        create: &Py<PyAny>,
        shared: &Rc<Shared>,
    ) -> Result<Box<dyn NativeScript>, String> {
        let speaker = Rc::new(Speaker {
            caller,
            callables: Rc::default(),
        });
        let handle = speaker.caller.handle();
        shared
            .speakers
            .borrow_mut()
            .insert(handle, Rc::clone(&speaker));
        let made = Python::try_attach(|py| {
            create
                .bind(py)
                .call1((handle,))
                .map(Bound::unbind)
                .map_err(|e| (errors::text(py, &e), e))
        });
        match made {
            Some(Ok(object)) => {
                let thread = RefCell::new(Thread::NotStarted);
                Ok(Box::new(Self {
                    object,
                    speaker,
                    shared: Rc::clone(shared),
                    thread,
                }))
            }
            Some(Err((text, error))) => {
                shared.exception.borrow_mut().get_or_insert(error);
                Err(text)
            }
            None => Err("Python is ending.".to_owned()),
        }
    }

    /// Works with Python; an exception is the script's error, and raised where Python called the simulator.
    fn attached<T>(&self, work: impl FnOnce(Python<'_>) -> PyResult<T>) -> Result<T, String> {
        let result =
            Python::try_attach(|py| work(py).map_err(|error| (errors::text(py, &error), error)));
        result
            .ok_or_else(|| "Python is ending.".to_owned())?
            .map_err(|(text, error)| {
                self.shared.exception.borrow_mut().get_or_insert(error);
                text
            })
    }

    fn function<'py>(&self, py: Python<'py>, name: &str) -> Option<Bound<'py, PyAny>> {
        if let Some(callable) = self.speaker.callables.get(py, name) {
            return Some(callable.into_bound(py));
        }
        let object = self.object.bind(py);
        object
            .getattr(name)
            .ok()
            .filter(pyo3::types::PyAnyMethods::is_callable)
    }

    fn advance(&self, py: Python<'_>, generator: Py<PyAny>) -> PyResult<Thread> {
        match generator.bind(py).call_method0("__next__") {
            Ok(_) => Ok(Thread::Waiting(generator)),
            Err(error) if error.is_instance_of::<PyStopIteration>(py) => Ok(Thread::Ended),
            Err(error) => Err(error),
        }
    }
}

impl NativeScript for PythonScript {
    fn defines(&self, function: &str) -> bool {
        Python::try_attach(|py| self.function(py, function).is_some()).unwrap_or(false)
    }

    fn call(&self, function: &str, args: &[Data]) -> Result<Vec<Data>, String> {
        self.attached(|py| match self.function(py, function) {
            Some(callable) => callables::call(py, &callable, args, &self.speaker.callables),
            None => Ok(Vec::new()),
        })
    }

    fn resume_thread(&self) -> Result<(), String> {
        let thread = self.thread.replace(Thread::Ended);
        let next = self.attached(|py| match thread {
            Thread::Ended => Ok(Thread::Ended),
            Thread::Waiting(generator) => self.advance(py, generator),
            Thread::NotStarted => match self.function(py, "sysCall_thread") {
                None => Ok(Thread::Ended),
                Some(function) => {
                    let result = function.call0()?;
                    if result.hasattr("__next__")? {
                        self.advance(py, result.unbind())
                    } else {
                        Ok(Thread::Ended)
                    }
                }
            },
        })?;
        self.thread.replace(next);
        Ok(())
    }

    fn evaluate(&self, text: &[u8]) -> Result<Vec<Data>, String> {
        self.attached(|py| {
            let object = self.object.bind(py);
            let names = object.getattr("__dict__")?;
            let text = String::from_utf8_lossy(text).into_owned();
            let value = py
                .import("builtins")?
                .getattr("eval")?
                .call1((text, names))?;
            Ok(vec![convert::to_data(&value, &self.speaker.callables, 0)?])
        })
    }
}

impl Drop for PythonScript {
    fn drop(&mut self) {
        let handle = self.speaker.caller.handle();
        let mut speakers = self.shared.speakers.borrow_mut();
        // It may have started anew.
        if speakers
            .get(&handle)
            .is_some_and(|speaker| Rc::ptr_eq(speaker, &self.speaker))
        {
            speakers.remove(&handle);
        }
    }
}
