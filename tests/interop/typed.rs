//! What type checkers find in a program that uses the Python package, whose stubs need no extension.

use std::process::Command;
use std::time::Duration;

use test_support::process::run_within;

use crate::server::{folder, python};

const CHECKS: Duration = Duration::from_secs(500);

#[test]
fn type_checkers_find_mistakes_and_nothing_else() {
    let Some(python) = python() else { return };
    let mut command = Command::new(python);
    command
        .arg(folder().join("typed.py"))
        .env("PYTHONDONTWRITEBYTECODE", "1");
    assert_eq!(run_within(&mut command, CHECKS).as_deref(), Ok(""));
}
