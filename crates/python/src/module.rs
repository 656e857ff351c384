//! Modules and their functions as objects of Python.

use std::sync::Arc;

use pyo3::exceptions::{PyAttributeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use scene::Data;
use swanilda::{ApiFunction, ModuleMember, Progress, SimulationState};

use crate::worlds::{Speaker, World};
use crate::{convert, errors, interruption, worlds};

/// A module as scripts get it from `require`: functions and constants are attributes.
#[pyclass(frozen, dict, module = "swanilda")]
pub struct Module {
    world: u64,
    script: Option<i64>,
    name: String,
}

// A function of a module. Without a doc comment: that would hide the documentation of the function.
#[pyclass(frozen, module = "swanilda")]
pub struct Function {
    world: u64,
    script: Option<i64>,
    function: Arc<ApiFunction>,
    is_short: bool,
}

impl Module {
    /// Looks the module up.
    ///
    /// # Errors
    /// As that of `require` in scripts.
    pub fn require(py: Python<'_>, world: u64, script: Option<i64>, name: &str) -> PyResult<Self> {
        let required = interruption::detached(py, || -> PyResult<_> {
            Ok(worlds::get(world)?.speaker(script)?.caller.require(name))
        })?;
        required.map_err(|error| errors::plain(&error))?;
        Ok(Self {
            world,
            script,
            name: name.to_owned(),
        })
    }

    fn member<'py>(&self, py: Python<'py>, member: ModuleMember) -> PyResult<Bound<'py, PyAny>> {
        match member {
            ModuleMember::Constant(value) => convert::from_data(py, value),
            ModuleMember::Enumeration(constants) => {
                let namespace = PyDict::new(py);
                for (name, value) in constants {
                    namespace.set_item(name, value)?;
                }
                py.import("types")?
                    .getattr("SimpleNamespace")?
                    .call((), Some(&namespace))
            }
            ModuleMember::Function(function) => {
                let is_short = function.is_short();
                let function = Arc::new(function);
                Ok(Bound::new(
                    py,
                    Function {
                        world: self.world,
                        script: self.script,
                        function,
                        is_short,
                    },
                )?
                .into_any())
            }
        }
    }
}

#[pymethods]
impl Module {
    /// Called for names that are not yet attributes.
    fn __getattr__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let this = slf.get();
        let missing =
            || PyAttributeError::new_err(format!("module '{}' has no member '{name}'", this.name));
        if name.starts_with("__") {
            return Err(missing());
        }
        let found = worlds::get(this.world)?
            .speaker(this.script)?
            .caller
            .member(&this.name, name);
        let member = found
            .map_err(|error| errors::plain(&error))?
            .ok_or_else(missing)?;
        let value = this.member(slf.py(), member)?;
        slf.as_any().getattr("__dict__")?.set_item(name, &value)?;
        Ok(value)
    }

    fn __dir__(&self) -> PyResult<Vec<String>> {
        let names = worlds::get(self.world)?
            .speaker(self.script)?
            .caller
            .member_names(&self.name);
        names.map_err(|error| errors::plain(&error))
    }

    fn __repr__(&self) -> String {
        format!("<module '{}' of a simulator>", self.name)
    }
}

#[pymethods]
impl Function {
    #[pyo3(signature = (*args))]
    fn __call__(&self, py: Python<'_>, args: &Bound<'_, PyTuple>) -> PyResult<Py<PyAny>> {
        let world = worlds::get(self.world)?;
        let speaker = world.speaker(self.script)?;
        let args = convert::arguments(args, &speaker.callables)?;
        let results = if self.is_short {
            speaker
                .caller
                .call(&self.function, &args)
                .map_err(|error| self.error(&error))
        } else if self.function.is_lua() && self.script.is_none() && world.borrow().is_ok() {
            self.call_and_step(py, &world, &args)
        } else {
            self.call_detached(py, &args)
        };
        world.raise()?;
        convert::results(py, results?)
    }

    #[getter]
    fn __name__(&self) -> &str {
        self.function.name()
    }

    #[getter]
    fn __doc__(&self) -> Option<String> {
        let text = docs::functions()
            .into_iter()
            .find(|function| function.name == self.function.name());
        text.as_ref().map(docs::function_text)
    }

    fn __repr__(&self) -> String {
        format!("<function {}>", self.function.name())
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(PyTypeError::new_err(
            "functions of a simulator stay in their process",
        ))
    }
}

impl Function {
    fn error(&self, error: &swanilda::Error) -> PyErr {
        errors::in_function(self.function.name(), error)
    }

    /// Lets other threads run meanwhile: it may take long.
    fn detached<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&Speaker) -> Result<T, swanilda::Error> + Send,
    ) -> PyResult<T> {
        let result = interruption::detached(py, || -> PyResult<_> {
            Ok(work(&*worlds::get(self.world)?.speaker(self.script)?))
        })?;
        if result.is_err() {
            // Ctrl-c comes before what it has led to.
            py.check_signals()?;
        }
        result.map_err(|error| self.error(&error))
    }

    fn call_detached(&self, py: Python<'_>, args: &[Data]) -> PyResult<Vec<Data>> {
        self.detached(py, |speaker| speaker.caller.call(&self.function, args))
    }

    /// A function in Lua that is called from outside of the loop may wait for steps: they run here.
    fn call_and_step(&self, py: Python<'_>, world: &World, args: &[Data]) -> PyResult<Vec<Data>> {
        let mut progress =
            self.detached(py, |speaker| speaker.caller.begin(&self.function, args))?;
        loop {
            let number = match progress {
                Progress::Done(results) => return Ok(results),
                Progress::Waits(number) => number,
            };
            if let Err(error) = self.step_for_waiting(py, world) {
                world.main.caller.cancel(number);
                return Err(error);
            }
            progress = self.detached(py, |speaker| speaker.caller.resume(number))?;
        }
    }

    fn step_for_waiting(&self, py: Python<'_>, world: &World) -> PyResult<()> {
        if matches!(
            world.main.caller.state(),
            SimulationState::Stopped | SimulationState::Paused
        ) {
            let name = self.function.name();
            return Err(errors::Error::new_err(format!(
                "in {name}: it waits for steps of a simulation that does not run: start() it first."
            )));
        }
        interruption::detached(py, || -> PyResult<()> {
            worlds::get(self.world)?.borrow()?.iterate();
            Ok(())
        })?;
        world.raise()?;
        py.check_signals()
    }
}
