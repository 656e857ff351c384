//! Planned motions against the libraries others plan with: the files `motion_*`.

use std::process::Command;

use test_support::process::run_bounded;

use crate::server::{folder, python};

#[test]
fn ruckig_agrees_with_the_official_library() {
    let Some(python) = python() else { return };
    let mut command = Command::new(python);
    command
        .arg(folder().join("motion_ruckig.py"))
        .arg(env!("CARGO_BIN_EXE_swanilda"))
        .env("PYTHONDONTWRITEBYTECODE", "1");
    assert_eq!(run_bounded(&mut command).as_deref(), Ok(""));
}
