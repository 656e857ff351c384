//! Runs with programs of others, captured and replayed.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::json;
use test_support::debug_client::Client;
use test_support::process::{LIMIT, output_of, wait_within};

use crate::server::{Server, python, run};

const SWANILDA: &str = env!("CARGO_BIN_EXE_swanilda");

/// What a server has captured while clients in Python worked with it.
fn capture(folder: &Path, python: &Path, clients: &str, scene: &[&str]) -> PathBuf {
    let capture = folder.join("run.swc");
    let name = capture.to_string_lossy();
    let args = [&["--remote-api=0", "--capture", &name], scene].concat();
    let mut server = Server::start_with(&args);
    run(python, clients, &server, &[]);
    let id = server.child.id().to_string();
    let interrupted = Command::new("kill").args(["-INT", &id]).status();
    assert!(interrupted.expect("there is kill").success());
    wait_within(&mut server.child, LIMIT).expect("it ends");
    capture
}

/// Replays a capture in a folder; what it prints on standard error.
fn replay(capture: &Path, folder: &Path, args: &[&str]) -> String {
    let mut replay = Command::new(SWANILDA);
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

#[test]
#[cfg(unix)]
fn two_official_clients_that_step() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let capture = capture(folder.path(), python, "zmq_capture.py", &[]);
    for threads in ["1", "2", "3"] {
        replay(&capture, Path::new("/"), &["--threads", threads]);
    }
}

/// The story of docs/TIME.md.
#[test]
#[cfg(unix)]
fn a_race_of_two_clients_is_found_backwards() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path().canonicalize().expect("it is there");
    let scene = place.join("race.lua");
    std::fs::write(&scene, include_str!("race.lua")).expect("our own folder is writable");
    let scene_name = scene.to_string_lossy().into_owned();
    let captured = capture(&place, python, "zmq_race.py", &[&scene_name]);
    let elsewhere = tempfile::tempdir().expect("a folder");
    let copy = elsewhere.path().join("copy.swc");
    std::fs::copy(&captured, &copy).expect("our own folder is writable");
    let folders = [&place, &place, Path::new("/"), elsewhere.path(), &place];
    for (file, folder) in [&captured, &copy, &captured, &copy, &captured]
        .into_iter()
        .zip(folders)
    {
        let said = replay(file, folder, &[]);
        assert!(
            said.contains("attempt to perform arithmetic on a nil value (upvalue 'goal')"),
            "{said}"
        );
    }
    let mut client = Client::start(SWANILDA, &[&captured.to_string_lossy()]);
    client.launch(json!({}));
    client.request("setExceptionBreakpoints", json!({"filters": ["uncaught"]}));
    client.run();
    let failed = client.stopped("exception");
    assert_eq!(failed.calls(), ["sysCall_actuation:11"]);
    assert_eq!(client.evaluate(&failed, "goal"), "nil");
    let failed_at = client.evaluate(&failed, "sim.getSimulationTime()");
    client.set_breakpoints(&scene, json!([{"line": 16}]));
    client.go("reverseContinue", &failed);
    let before = client.stopped("breakpoint");
    assert_eq!(before.calls(), ["sysCall_sensing:16"]);
    assert_eq!(client.evaluate(&before, "sim.getFloatSignal 'goal'"), "nil");
    let time = client.evaluate(&before, "sim.getSimulationTime()");
    let [failed_at, time] = [failed_at, time].map(|time| time.parse::<f64>().expect("a number"));
    assert!((failed_at - time - 0.05).abs() < 1e-9, "a step before");
    client.request("disconnect", json!({}));
    client.end();
}
