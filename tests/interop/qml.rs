//! Interfaces in QML, with PySide6 of the Python index: on the page of the viewer, and in tests.

use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;
use std::time::Duration;

use test_support::process::run_within;
use test_support::skipped_outside_of_ci;

use crate::server::{folder, make_environment};
use crate::web::check_in_browser_with;

const LIMIT: Duration = Duration::from_secs(60);

/// A Python with PySide6, apart from that of the other tests, which do without it. None where there is no python3.
fn python() -> Option<&'static PathBuf> {
    static PYTHON: OnceLock<Option<PathBuf>> = OnceLock::new();
    let make = || make_environment("qml-venv", "requirements_qml.txt");
    let python = PYTHON.get_or_init(make).as_ref();
    if python.is_none() {
        skipped_outside_of_ci("there is no python3 with venv");
    }
    python
}

#[test]
fn interfaces_in_a_browser() {
    if let Some(python) = python() {
        check_in_browser_with("view_qml.py", &[python]);
    }
}

#[test]
fn interfaces_in_tests() {
    let Some(python) = python() else { return };
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("test").arg(folder().join("qml_test.lua"));
    command.env("QML_PYTHON", python);
    let output = run_within(&mut command, LIMIT).expect("it ends");
    assert!(output.contains("6 passed"), "{output}");
}
