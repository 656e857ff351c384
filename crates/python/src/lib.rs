//! The extension module of the Python package `swanilda`: simulators, and the modules that scripts have, in-process.
//!
//! Values are converted and calls passed on; everything else is the library's, or Python's in `python/swanilda`.

mod batch;
mod cases;
mod console;
mod convert;
mod errors;
mod host;
mod interruption;
mod library;
mod lua_tests;
mod module;
mod options;
mod quantities;
mod script;
mod simulator;
mod vector;
mod worlds;

use pyo3::prelude::*;

/// Each simulator has memory of its own, which snapshots copy.
#[global_allocator]
static ALLOCATOR: swanilda::Allocator = swanilda::Allocator;

#[pymodule]
mod _swanilda {
    #[pymodule_export]
    use crate::batch::Batch;
    #[pymodule_export]
    use crate::cases::Cases;
    #[pymodule_export]
    use crate::errors::Error;
    #[pymodule_export]
    use crate::library::write_library;
    #[pymodule_export]
    use crate::lua_tests::{list_tests, run_tests};
    #[pymodule_export]
    use crate::module::{Function, Module};
    #[pymodule_export]
    use crate::quantities::Quantities;
    #[pymodule_export]
    use crate::simulator::Simulator;
    #[pymodule_export]
    use crate::vector::{Array, Vector};
    #[pymodule_export]
    use crate::worlds::branches::Snapshot;
    #[pymodule_export]
    use crate::worlds::{close_all, forget_after_fork};

    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }

    /// Nothing: what a call from Python costs at least.
    #[pyfunction]
    fn empty_call() {}
}
