//! The extension as what is behind `libcoppeliaSim.so`: programs that load CoppeliaSim in their own process find the simulator in it.

use std::path::PathBuf;

use c_interface::folder::{Folder, Release};
use c_session::Value;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A call of a function: see [`c_session::call`].
///
/// # Safety
/// Only the generated library calls this.
#[expect(unsafe_code, reason = "an edge to C")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn swanilda_library_call(
    interface: u32,
    row: u32,
    values: *mut Value,
    count: u32,
) -> i64 {
    // SAFETY: the generated library has made the values for this row.
    unsafe { c_session::call(interface, row, values, count) }
}

/// Writes a folder for COPPELIASIM_ROOT; `extension` is the file of this extension, of which the folder gets a copy.
#[pyfunction]
pub fn write_library(folder: PathBuf, release: &str, extension: PathBuf) -> PyResult<()> {
    let release = match release {
        "4.1" => Release::V41,
        "4.10" => Release::V410,
        _ => {
            return Err(PyValueError::new_err(format!(
                "the library is there for 4.1 and 4.10, not for {release}"
            )));
        }
    };
    if !release.is_supported() {
        return Err(PyValueError::new_err("the library is there on Linux only"));
    }
    let parts = Folder {
        release,
        simulator: &extension,
        command: None,
    };
    Ok(parts.write(&folder)?)
}
