//! Debugging a capture: steps back, and on from earlier moments.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::json;
use tempfile::TempDir;
use test_support::process::output_of;

use super::SWANILDA;
use test_support::debug_client::{Client, Stopped, named};

/// A function that is called in each step, a thread, and an error at the end. Addresses and random numbers are part of what is shown.
const SCRIPT: &str = "\
local sim = require 'sim'
local count = 0
local box

local function add(n)
    count = count + n
    return count
end

function sysCall_init()
    box = sim.createDummy(0.01)
    sim.setObjectAlias(box, 'Box')
end

function sysCall_thread()
    for i = 1, 6 do
        local drawn = math.random(1000)
        sim.step()
        print(i, drawn, tostring({}))
    end
end

function sysCall_actuation()
    local n = add(1)
    if n == 5 then
        sim.setObjectPosition(box, {n, 0, 0})
    end
    local last = n
end
";

/// A capture of the script; the script is gone.
fn capture(script: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path().canonicalize().expect("it is there");
    let (scene, capture) = (place.join("back.lua"), place.join("run.swc"));
    std::fs::write(&scene, script).expect("the file is written");
    let mut command = Command::new(SWANILDA);
    command
        .arg("run")
        .arg(&scene)
        .args(["--steps", "8", "--capture"]);
    output_of(command.arg(&capture));
    (folder, capture)
}

/// The line that the thread has printed then, with the address of a table.
fn captured_line(capture: &Path, i: u32) -> String {
    let mut command = Command::new(SWANILDA);
    let output = output_of(command.arg("replay").arg(capture));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let line = text
        .lines()
        .find(|line| line.starts_with(&format!("{i}, ")));
    line.expect("the line is printed").to_owned()
}

/// A client whose capture has stopped at a breakpoint.
fn stopped_at(capture: &Path, line: u32, condition: &str) -> (Client, Stopped, PathBuf) {
    let scene = capture.with_file_name("back.lua");
    let mut client = Client::start(SWANILDA, &[&capture.to_string_lossy()]);
    client.launch(json!({}));
    client.set_breakpoints(&scene, json!([{"line": line, "condition": condition}]));
    client.run();
    let stopped = client.stopped("breakpoint");
    (client, stopped, scene)
}

#[test]
fn steps_go_back_through_calls_and_iterations() {
    let (_folder, capture) = capture(SCRIPT);
    let (mut client, stopped, _) = stopped_at(&capture, 28, "n == 4");
    assert_eq!(client.evaluate(&stopped, "n"), "4");
    let mut calls = Vec::new();
    let mut counts = Vec::new();
    for _ in 0..5 {
        client.go("stepBack", &stopped);
        let stopped = client.stopped("step");
        calls.push(stopped.calls()[0].clone());
        counts.push(client.evaluate(&stopped, "require 'sim'.getSimulationTime()"));
    }
    assert_eq!(
        calls,
        [
            "sysCall_actuation:25",
            "sysCall_actuation:24",
            "sysCall_actuation:28",
            "sysCall_actuation:25",
            "sysCall_actuation:24"
        ]
    );
    let (now, before) = (&counts[0], &counts[2]);
    assert_eq!(counts, [now, now, before, before, before].map(Clone::clone));
    assert!(now.parse::<f64>().unwrap() - before.parse::<f64>().unwrap() > 0.04);
    client.request("disconnect", json!({}));
    client.end();
}

#[test]
fn what_was_looked_at_and_changed_leaves_no_trace() {
    let (_folder, capture) = capture(SCRIPT);
    let (mut client, stopped, scene) = stopped_at(&capture, 19, "i == 4");
    let (drawn, text) = ("drawn", "tostring({})");
    let first = [
        client.evaluate(&stopped, drawn),
        client.evaluate(&stopped, text),
    ];
    client.evaluate(&stopped, "i = 1000");
    client.set_breakpoints(&scene, json!([{"line": 19}]));
    client.go("continue", &stopped);
    // As in the run that was captured.
    client.output(&captured_line(&capture, 4));
    let later = client.stopped("breakpoint");
    assert_eq!(client.evaluate(&later, "i"), "5");
    client.go("reverseContinue", &later);
    let again = client.stopped("breakpoint");
    assert_eq!(
        first,
        [
            client.evaluate(&again, drawn),
            client.evaluate(&again, text)
        ]
    );
    assert_eq!(client.evaluate(&again, "i"), "4");
    client.request("disconnect", json!({}));
    client.end();
}

#[test]
fn data_breakpoints_are_found_backwards() {
    let (_folder, capture) = capture(SCRIPT);
    let (mut client, stopped, scene) = stopped_at(&capture, 28, "n == 7");
    client.set_breakpoints(&scene, json!([]));
    client.request(
        "setDataBreakpoints",
        json!({"breakpoints": [{"dataId": "/Box.pose"}]}),
    );
    client.go("reverseContinue", &stopped);
    let change = client.stopped("data breakpoint");
    assert_eq!(change.calls()[0], "sysCall_actuation:26");
    let (_, locals) = client.scope(&change, "Locals");
    assert_eq!(named(&locals, "n")["value"], "5");
    client.go("stepBack", &change);
    let before = client.stopped("step");
    assert_eq!(before.calls()[0], "sysCall_actuation:26");
    assert_eq!(
        client.evaluate(&before, "require 'sim'.getObjectPosition(box)[1]"),
        "0.0"
    );
    client.request("disconnect", json!({}));
    client.end();
}

#[test]
fn the_borders_of_a_capture_stop() {
    let (_folder, capture) = capture(SCRIPT);
    let (mut client, stopped, scene) = stopped_at(&capture, 24, "true");
    client.set_breakpoints(&scene, json!([]));
    client.go("reverseContinue", &stopped);
    let beginning = client.stopped("pause");
    client.go("reverseContinue", &beginning);
    let beginning = client.stopped("pause");
    client.go("continue", &beginning);
    let end = client.stopped("pause");
    client.set_breakpoints(&scene, json!([{"line": 26}]));
    client.go("reverseContinue", &end);
    let inside = client.stopped("breakpoint");
    assert_eq!(client.evaluate(&inside, "n"), "5");
    client.set_breakpoints(&scene, json!([]));
    client.go("continue", &inside);
    let end = client.stopped("pause");
    client.go("continue", &end);
    assert_eq!(client.end(), Some(0));
}

#[test]
fn only_captures_go_back() {
    let (_folder, file) = super::file(SCRIPT);
    let mut client = super::start(&file);
    client.launch(json!({}));
    client.set_breakpoints(&file, json!([{"line": 24}]));
    client.run();
    let stopped = client.stopped("breakpoint");
    let refused = client.answer("stepBack", json!({"threadId": stopped.thread}));
    let message = refused["message"].as_str().unwrap_or_default();
    assert!(message.contains("--capture"), "{message}");
    client.request("disconnect", json!({}));
    client.end();
}
