//! Quantities and actions of one simulator, for `swanilda.gym`.

use pyo3::prelude::*;
use vector::{Action, Expressions, Quantity, Readers, Writers};

use crate::errors::Error;
use crate::interruption;
use crate::vector::{Named, action, quantity};
use crate::worlds;

/// What is read and written in a simulator.
#[pyclass(frozen, module = "swanilda._swanilda")]
pub struct Quantities {
    simulator: u64,
    readers: Readers,
    writers: Writers,
    expressions: Expressions,
}

impl Quantities {
    /// Finds them in the scene.
    pub fn new(simulator: u64, observations: &[Named], actions: &[Named]) -> PyResult<Self> {
        let observations: Vec<Quantity> =
            observations.iter().map(quantity).collect::<PyResult<_>>()?;
        let actions: Vec<Action> = actions.iter().map(action).collect::<PyResult<_>>()?;
        let world = worlds::get(simulator)?;
        let sim = &mut world.borrow()?;
        let is_lua = observations
            .iter()
            .any(|quantity| matches!(quantity, Quantity::Expression(_)))
            || actions
                .iter()
                .any(|action| matches!(action, Action::Statement(_)));
        let mut found = || {
            let expressions = if is_lua {
                Expressions::new(sim)?
            } else {
                Expressions::none()
            };
            Ok(Self {
                simulator,
                readers: Readers::new(sim, &expressions, &observations)?,
                writers: Writers::new(sim, &expressions, &actions)?,
                expressions,
            })
        };
        found().map_err(Error::new_err::<String>)
    }
}

#[pymethods]
impl Quantities {
    /// How many numbers each quantity has.
    #[getter]
    fn widths(&self) -> Vec<usize> {
        self.readers.widths()
    }

    /// The numbers of all quantities.
    fn read(&self, py: Python<'_>) -> PyResult<Vec<f64>> {
        let read = interruption::detached(py, || -> PyResult<_> {
            let world = worlds::get(self.simulator)?;
            let mut simulator = world.borrow()?;
            Ok(self.readers.read(&mut simulator, &self.expressions))
        })?;
        worlds::get(self.simulator)?.raise()?;
        read.map_err(Error::new_err)
    }

    /// Writes a number for each action.
    fn write(&self, py: Python<'_>, values: Vec<f64>) -> PyResult<()> {
        let written = interruption::detached(py, || -> PyResult<_> {
            let world = worlds::get(self.simulator)?;
            let mut simulator = world.borrow()?;
            Ok(self
                .writers
                .write(&mut simulator, &self.expressions, &values))
        })?;
        worlds::get(self.simulator)?.raise()?;
        written.map_err(Error::new_err)
    }
}
