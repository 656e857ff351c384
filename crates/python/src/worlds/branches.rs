//! Branches: several numbers of one simulator, whose memory is that of one of them at a time.

use std::collections::BTreeMap;
use std::rc::Rc;

use pyo3::prelude::*;

use crate::errors::{self, Error};
use crate::worlds::{self, World};

/// A simulator as it was at a moment.
#[pyclass(frozen, module = "swanilda._swanilda")]
pub struct Snapshot(pub swanilda::Snapshot);

#[pymethods]
impl Snapshot {
    /// Bytes that only this snapshot holds.
    #[getter]
    fn own_bytes(&self) -> usize {
        self.0.own_bytes()
    }
}

/// The branches of a simulator.
pub struct Branches {
    /// The one that the memory holds; None when it was closed.
    active: Option<u64>,
    /// What the others are.
    others: BTreeMap<u64, Rc<swanilda::Snapshot>>,
}

impl Branches {
    /// One simulator, without others.
    pub fn only(number: u64) -> Self {
        Self {
            active: Some(number),
            others: BTreeMap::new(),
        }
    }
}

/// Why a simulator has either branches or pages.
pub const NOT_SHOWN: &str = "a simulator that browsers show has no branches.";

impl World {
    /// Branches from the present moment on; their numbers.
    ///
    /// # Errors
    /// When there is no snapshot, or browsers look at the simulator.
    pub fn branch(self: &Rc<Self>, count: usize) -> PyResult<Vec<u64>> {
        if self.viewer.borrow().is_some() {
            return Err(Error::new_err(NOT_SHOWN));
        }
        self.check_not_recorded()?;
        let moment = self.borrow()?.snapshot();
        let moment = Rc::new(moment.map_err(|error| errors::plain(&error))?);
        let numbers: Vec<u64> = (0..count).map(|_| worlds::new_number()).collect();
        let mut branches = self.branches.borrow_mut();
        for &number in &numbers {
            branches.others.insert(number, Rc::clone(&moment));
            worlds::add_as(number, self);
        }
        Ok(numbers)
    }

    /// Whether it is one of several branches.
    pub fn has_branches(&self) -> bool {
        !self.branches.borrow().others.is_empty()
    }

    /// Makes the memory that of a branch.
    ///
    /// # Errors
    /// When a branch cannot be left: it is in the middle of a step, or has something open that no snapshot reaches.
    pub fn turn_to(&self, number: u64) -> PyResult<()> {
        let active = self.branches.borrow().active;
        if active == Some(number) {
            return Ok(());
        }
        let Some(moment) = self.branches.borrow().others.get(&number).cloned() else {
            return Ok(());
        };
        let mut simulator = self.borrow()?;
        let left = active.map(|_| simulator.snapshot()).transpose();
        let left = left.map_err(|error| errors::plain(&error))?;
        let restored = simulator.restore(&moment);
        restored.map_err(|error| errors::plain(&error))?;
        let mut branches = self.branches.borrow_mut();
        if let (Some(active), Some(left)) = (active, left) {
            branches.others.insert(active, Rc::new(left));
        }
        branches.others.remove(&number);
        branches.active = Some(number);
        Ok(())
    }

    /// Forgets a branch.
    pub fn forget(&self, number: u64) {
        let mut branches = self.branches.borrow_mut();
        branches.others.remove(&number);
        branches.active = branches.active.filter(|&active| active != number);
    }
}
