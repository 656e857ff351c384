//! How a simulator behaves, as Python says it.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::path::{Path, PathBuf};

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use swanilda::{Options, Permissions, ScriptKind};
use vector::Recorded;

/// The arguments of simulators and of worlds.
pub struct Given {
    pub seed: Option<u32>,
    pub params: Option<BTreeMap<String, String>>,
    pub unsafe_functions: bool,
    pub package_dirs: Option<Vec<PathBuf>>,
    pub data_dir: Option<PathBuf>,
    pub verbosity: Option<i64>,
    pub render_threads: Option<usize>,
}

impl Given {
    /// The options for a scene.
    pub fn options(self, py: Python<'_>, scene: Option<&Path>) -> Options {
        let folder = scene.map(swanilda::Simulator::folder_of_scene);
        let package_dirs = folder.into_iter();
        let permissions = if self.unsafe_functions {
            Permissions::all()
        } else {
            Permissions::none()
        };
        let defaults = Options::default();
        Options {
            seed: self.seed.unwrap_or(defaults.seed),
            verbosity: self.verbosity.unwrap_or(defaults.verbosity),
            named_params: self.params.unwrap_or_default(),
            package_dirs: package_dirs
                .chain(self.package_dirs.unwrap_or_default())
                .collect(),
            data_dir: self.data_dir,
            python: executable(py),
            render_threads: self.render_threads.and_then(NonZero::new),
            permissions,
            ..defaults
        }
    }
}

/// This Python, for programs that work for scripts; None where a program contains it.
fn executable(py: Python<'_>) -> Option<String> {
    let name: String = py
        .import("sys")
        .ok()?
        .getattr("executable")
        .ok()?
        .extract()
        .ok()?;
    Path::new(&name).is_file().then_some(name)
}

/// The type of script of that name.
pub fn kind_of(name: &str) -> PyResult<ScriptKind> {
    match name {
        "customization" => Ok(ScriptKind::Customization),
        "simulation" => Ok(ScriptKind::Simulation),
        "addon" => Ok(ScriptKind::AddOn),
        "sandbox" => Ok(ScriptKind::Sandbox),
        "main" => Ok(ScriptKind::Main),
        _ => Err(PyValueError::new_err(format!(
            "there are no scripts of type '{name}': it is customization, simulation, addon, sandbox or main"
        ))),
    }
}

/// What of a simulator is recorded.
pub fn recorded(images: bool) -> Recorded {
    if images {
        Recorded::SceneAndImages
    } else {
        Recorded::Scene
    }
}

/// A time step that a simulation may have.
pub fn check_time_step(time_step: Option<f64>) -> PyResult<()> {
    if time_step.is_some_and(|step| !(step > 0.0 && step.is_finite())) {
        return Err(PyValueError::new_err(
            "time_step is a number of seconds above 0",
        ));
    }
    Ok(())
}
