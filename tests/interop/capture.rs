//! Runs with programs of others, captured and replayed.

use std::path::Path;

use serde_json::json;
use test_support::debug_client::Client;

use crate::server::{capture, python, replay, run};

const SWANILDA: &str = env!("CARGO_BIN_EXE_swanilda");

#[test]
#[cfg(unix)]
fn two_official_clients_that_step() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let capture = capture(folder.path(), &[], |server| {
        run(python, "zmq_capture.py", server, &[]);
    });
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
    let captured = capture(&place, &[&scene_name], |server| {
        run(python, "zmq_race.py", server, &[]);
    });
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
