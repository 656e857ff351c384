//! Lua's sockets and servers in Python: the files `sockets_*`.

use std::process::Command;

use test_support::process::run_bounded;

use crate::server::{folder, python};

/// Runs one file, which starts its servers and the command; it says nothing when all is well.
fn check(file: &str) {
    let Some(python) = python() else { return };
    let mut command = Command::new(python);
    command
        .arg(folder().join(file))
        .arg(env!("CARGO_BIN_EXE_swanilda"))
        .env("PYTHONDONTWRITEBYTECODE", "1");
    assert_eq!(run_bounded(&mut command).as_deref(), Ok(""), "{file}");
}

#[test]
#[cfg(target_os = "linux")]
fn http_and_https() {
    check("sockets_http.py");
}

#[test]
#[cfg(target_os = "linux")]
fn mail_and_files() {
    check("sockets_mail.py");
}

#[test]
#[cfg(target_os = "linux")]
fn peers_that_are_slow_rude_or_gone() {
    check("sockets_peers.py");
}
