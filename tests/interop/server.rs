//! `swanilda serve` for a test, and the Python that runs a client against it.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;

use test_support::process::{LIMIT, output_of, run_bounded, wait_within};
use test_support::skipped_outside_of_ci;

/// `swanilda serve` at a port of the system's choice.
pub struct Server {
    pub child: Child,
    pub port: String,
}

impl Server {
    pub fn start() -> Self {
        Self::start_with(&["--remote-api=0"])
    }

    pub fn start_with(args: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command
            .args(["serve", "--json"])
            .args(args)
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        let mut child = command.spawn().expect("the server starts");
        let mut out = BufReader::new(child.stdout.take().expect("standard output is piped"));
        let port = announced_port(&mut out);
        // What else it says must not fill the pipe.
        std::thread::spawn(move || std::io::copy(&mut out, &mut std::io::sink()));
        Self { child, port }
    }
}

/// Reads until the server says where it listens.
fn announced_port(out: &mut impl BufRead) -> String {
    for line in out.lines() {
        let event: serde_json::Value =
            serde_json::from_str(&line.expect("the server lives")).expect("--json gives JSON");
        if event["type"] == "listening" {
            return event["port"].to_string();
        }
    }
    panic!("the server ended without listening");
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/interop")
}

/// The Python of the environment with the foreign clients; None where there is no python3.
pub fn python() -> Option<&'static PathBuf> {
    static PYTHON: OnceLock<Option<PathBuf>> = OnceLock::new();
    let make = || make_environment("interop-venv", "requirements.txt");
    let python = PYTHON.get_or_init(make).as_ref();
    if python.is_none() {
        skipped_outside_of_ci("there is no python3 with venv");
    }
    python
}

/// The Python of an environment with a list of packages; None where there is no python3.
pub fn make_environment(name: &str, list: &str) -> Option<PathBuf> {
    if !Command::new("python3")
        .args(["-c", "import ensurepip, venv"])
        .status()
        .is_ok_and(|status| status.success())
    {
        return None;
    }
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let (python, requirements) = (dir.join("bin/python"), folder().join(list));
    let stamp = dir.join("installed.txt");
    let wanted = fs::read_to_string(&requirements).expect("the list of requirements is readable");
    if fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) {
        return Some(python);
    }
    succeed(
        Command::new("python3")
            .args(["-m", "venv", "--clear"])
            .arg(&dir),
    );
    succeed(
        Command::new(&python)
            .args(["-m", "pip", "install", "--quiet", "--requirement"])
            .arg(&requirements),
    );
    fs::write(stamp, wanted).expect("the environment is ours");
    Some(python)
}

fn succeed(command: &mut Command) {
    let status = command.status().expect("the command starts");
    assert!(status.success(), "{command:?}: {status}");
}

/// Runs one file against a server of its own; it says nothing when all is well.
///
/// The run is captured, and replayed without the client.
pub fn check(file: &str, args: &[&str]) {
    check_with(file, args, &[]);
}

/// The same; the server has further options.
pub fn check_with(file: &str, args: &[&str], options: &[&str]) {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let capture = capture(folder.path(), options, |server| {
        run(python, file, server, args);
    });
    replay(&capture, Path::new("/"), &[]);
}

/// What a server has captured while somebody worked with it.
pub fn capture(folder: &Path, options: &[&str], work: impl FnOnce(&Server)) -> PathBuf {
    let capture = folder.join("run.swc");
    let name = capture.to_string_lossy();
    let args = [&["--remote-api=0", "--capture", &name], options].concat();
    let mut server = Server::start_with(&args);
    work(&server);
    let id = server.child.id().to_string();
    let interrupted = Command::new("kill").args(["-INT", &id]).status();
    assert!(interrupted.expect("there is kill").success());
    wait_within(&mut server.child, LIMIT).expect("it ends");
    capture
}

/// Replays a capture in a folder; what it prints on standard error.
pub fn replay(capture: &Path, folder: &Path, args: &[&str]) -> String {
    let mut replay = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    let replay = replay.arg("replay").arg(capture).args(args);
    let output = output_of(replay.current_dir(folder));
    let status = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        status.ends_with("as in the capture, to the end\n"),
        "{status}"
    );
    assert_eq!(output.status.code(), Some(0));
    status
}

/// Runs one file against a server.
pub fn run(python: &Path, file: &str, server: &Server, args: &[&str]) {
    let mut command = Command::new(python);
    command
        .arg(folder().join(file))
        .arg(&server.port)
        .args(args)
        .env("PYTHONDONTWRITEBYTECODE", "1");
    assert_eq!(
        run_bounded(&mut command).as_deref(),
        Ok(""),
        "{file} {args:?}"
    );
}
