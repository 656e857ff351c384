//! WebSockets and browsers: the files `ws_*.py`, which start the program themselves.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use test_support::process::run_within;
use test_support::skipped_outside_of_ci;

use crate::server::{folder, python};

/// These files bound each of their waits; browsers take long to start on a busy machine.
const LIMIT: Duration = Duration::from_secs(240);

/// Runs one file; it says nothing when all is well.
pub fn check(file: &str) {
    check_with(file, &[]);
}

fn check_with(file: &str, arguments: &[&Path]) {
    let Some(python) = python() else { return };
    let mut command = Command::new(python);
    command
        .arg(folder().join(file))
        .arg(env!("CARGO_BIN_EXE_swanilda"))
        .args(arguments);
    command.env("PYTHONDONTWRITEBYTECODE", "1");
    assert_eq!(run_within(&mut command, LIMIT).as_deref(), Ok(""), "{file}");
}

#[test]
fn servers_and_clients_of_scripts() {
    check("ws_module.py");
}

#[test]
#[cfg(target_os = "linux")]
fn peers_that_behave_badly() {
    check("ws_bad_input.py");
}

#[test]
fn the_remote_api() {
    check("ws_remote.py");
}

#[test]
fn pages_in_a_browser() {
    check_in_browser("ws_browser.py");
}

/// Runs a file that needs Chromium.
pub fn check_in_browser(file: &str) {
    check_in_browser_with(file, &[]);
}

/// The same with further arguments.
pub fn check_in_browser_with(file: &str, arguments: &[&Path]) {
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let is_there = |name: &&str| {
        Command::new(name)
            .arg("--version")
            .output()
            .is_ok_and(|output| output.status.success())
    };
    if names.iter().any(is_there) {
        return check_with(file, arguments);
    }
    skipped_outside_of_ci("there is no Chromium");
}
