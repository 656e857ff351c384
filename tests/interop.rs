//! Programs of others against `swanilda serve`: the Python files `zmq_*.py` of `tests/interop`.
//!
//! Needs python3 with `venv`, and the Python index once: the environment stays in `target/`. Without python3 the tests are skipped,
//! except where `CI` is set.

#![allow(clippy::disallowed_methods, reason = "tests start programs and look at the environment")]

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;

mod support;
use support::process::run_bounded;

/// `swanilda serve` at a port of the system's choice.
struct Server {
    child: Child,
    port: String,
}

impl Server {
    fn start() -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command.args(["serve", "--remote-api=0", "--json"]).stdin(Stdio::null()).stdout(Stdio::piped());
        let mut child = command.spawn().expect("the server starts");
        let mut line = String::new();
        let out = child.stdout.take().expect("standard output is piped");
        let mut lines = BufReader::new(out);
        lines.read_line(&mut line).expect("the server says where it listens");
        // What else it says must not fill the pipe.
        std::thread::spawn(move || std::io::copy(&mut lines, &mut std::io::sink()));
        let told: serde_json::Value = serde_json::from_str(&line).expect("--json gives JSON");
        Self { child, port: told["port"].to_string() }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/interop")
}

/// The Python of the environment with the foreign clients; None where there is no python3.
fn python() -> Option<&'static PathBuf> {
    static PYTHON: OnceLock<Option<PathBuf>> = OnceLock::new();
    PYTHON.get_or_init(make_environment).as_ref()
}

fn make_environment() -> Option<PathBuf> {
    if !Command::new("python3").args(["-c", "import ensurepip, venv"]).status().is_ok_and(|status| status.success()) {
        assert!(std::env::var_os("CI").is_none(), "CI must have python3 with venv");
        eprintln!("skipped: there is no python3 with venv");
        return None;
    }
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("interop-venv");
    let (python, requirements) = (dir.join("bin/python"), folder().join("requirements.txt"));
    let stamp = dir.join("installed.txt");
    let wanted = fs::read_to_string(&requirements).expect("the list of requirements is readable");
    if fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) {
        return Some(python);
    }
    succeed(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&dir));
    succeed(Command::new(&python).args(["-m", "pip", "install", "--quiet", "--requirement"]).arg(&requirements));
    fs::write(stamp, wanted).expect("the environment is ours");
    Some(python)
}

fn succeed(command: &mut Command) {
    let status = command.status().expect("the command starts");
    assert!(status.success(), "{command:?}: {status}");
}

/// Runs one file against a server of its own; it says nothing when all is well.
fn check(file: &str, args: &[&str]) {
    let Some(python) = python() else { return };
    let server = Server::start();
    let mut command = Command::new(python);
    command.arg(folder().join(file)).arg(&server.port).args(args).env("PYTHONDONTWRITEBYTECODE", "1");
    assert_eq!(run_bounded(&mut command).as_deref(), Ok(""), "{file} {args:?}");
}

#[test]
fn the_protocol_byte_by_byte() {
    check("zmq_protocol.py", &[]);
}

#[test]
#[cfg(unix)]
fn the_end_while_a_client_holds_up_the_simulation() {
    let Some(python) = python() else { return };
    let mut server = Server::start();
    let mut command = Command::new(python);
    command.arg(folder().join("zmq_end.py")).arg(&server.port).arg(server.child.id().to_string());
    assert_eq!(run_bounded(command.env("PYTHONDONTWRITEBYTECODE", "1")).as_deref(), Ok(""));
    assert!(server.child.wait().expect("the child is ours").success(), "SIGTERM is a clean end");
}

#[test]
fn the_official_client_with_cbor() {
    check("zmq_client.py", &["cbor"]);
}

#[test]
fn the_official_client_with_cbor2() {
    check("zmq_client.py", &["cbor2"]);
}
