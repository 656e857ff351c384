//! `swanilda run --branch-at`: one past, many futures.

use std::fs;
use std::process::Output;

use serde_json::Value;

use super::{Scene, stderr, stdout};

/// A box that falls and is pushed by what a parameter says, with random numbers on the way.
const PUSHED: &str = "sim = require 'sim'
function sysCall_init()
    box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(box, {0, 0, 2})
    sim.setBoolProperty(box, 'dynamic', true)
    steps = 0
end
function sysCall_actuation()
    -- here
    steps = steps + 1
    print('step ' .. steps)
    local push = tonumber(sim.getNamedStringParam('push') or 0)
    if push == 9 then error('too much') end
    sim.addForce(box, {0, 0, 0}, {push + math.random(), 0, 0})
end
function sysCall_sensing()
    sim.setNamedStringParam('result.x', string.format('%.17g', sim.getObjectPosition(box)[1]))
    sim.setNamedStringParam('result.steps', tostring(steps))
end";

/// How a future ends that begins after six steps of 50 ms.
const ENDS: &[&str] = &["--time", "0.6", "--hash"];

fn branch(scene: &Scene, sweep: &str, more: &[&str]) -> Output {
    branch_at("0.3", scene, sweep, more)
}

fn branch_at(time: &str, scene: &Scene, sweep: &str, more: &[&str]) -> Output {
    let out = scene.folder.path().join("out").display().to_string();
    let args = ["--branch-at", time, "--sweep", sweep, "--out", &out];
    scene.run(&[&args, ENDS, more].concat())
}

fn table(scene: &Scene) -> Vec<String> {
    let file = scene.folder.path().join("out/results.csv");
    let text = fs::read_to_string(file).expect("the table");
    text.lines().map(str::to_owned).collect()
}

fn hashes(output: &Output) -> Vec<String> {
    let text = stdout(output);
    let lines = text.lines().filter(|line| line.starts_with("state hash "));
    lines.map(str::to_owned).collect()
}

/// The hash and the result of a run that sets the parameter itself at that time.
fn whole_run(push: &str) -> String {
    let sets = format!(
        "if sim.getSimulationTime() > 0.29 then sim.setNamedStringParam('push', '{push}') end"
    );
    let scene = Scene::new(&PUSHED.replace("-- here", &sets));
    let output = scene.run(ENDS);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    hashes(&output).remove(0)
}

#[test]
fn each_future_is_the_run_that_sets_the_parameter_itself() {
    let scene = Scene::new(PUSHED);
    let output = branch(&scene, "push=1,2,5", &[]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let printed = stdout(&output);
    let count = |line: &str| printed.lines().filter(|&printed| printed == line).count();
    assert_eq!((count("step 6"), count("step 7")), (1, 3), "{printed}");
    assert!(printed.contains("3 of 3 runs done, 0 failed"), "{printed}");
    let rows = table(&scene);
    assert_eq!(rows[0], "run,seed,push,error,steps,time,steps,x");
    assert!(rows[1..].iter().all(|row| row.contains(",,15,0.75,15,")));
    let found = hashes(&output);
    assert_eq!(found, ["1", "2", "5"].map(whole_run));

    let output = branch(&scene, "push=5,1,2", &["--force"]);
    let turned = hashes(&output);
    assert_eq!(turned, [2, 0, 1].map(|at: usize| found[at].clone()));
    let x = |row: &String| row.rsplit(',').next().map(str::to_owned);
    let (first, second) = (rows, table(&scene));
    assert_eq!(x(&first[1]), x(&second[2]));
    assert_ne!(x(&first[1]), x(&second[1]));
}

#[test]
fn a_future_that_fails_is_a_row() {
    let scene = Scene::new(PUSHED);
    let output = branch(&scene, "push=9,1", &["--sweep", "other=a,b"]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let said = stderr(&output);
    assert!(said.contains("no script has read the parameter other "));
    assert!(!said.contains("the parameter push "), "{said}");
    let rows = table(&scene);
    assert!(rows[1].contains("1,123456,a,9,") && rows[1].contains(": too much"));
    assert!(rows[2].contains("2,123456,b,9,") && rows[2].contains(": too much"));
    assert!(rows[3].contains("3,123456,a,1,,15,"), "{rows:?}");
    assert!(rows[4].contains("4,123456,b,1,,15,"), "{rows:?}");

    // Other runs are not overwritten.
    let output = branch(&scene, "push=1", &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("holds the results of another batch"));
    assert_eq!(table(&scene), rows);
}

#[test]
fn futures_are_lines_of_json() {
    let scene = Scene::new(PUSHED);
    let output = branch(&scene, "push=1,2", &["--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let of_type = |name: &str| {
        let text = stdout(&output);
        let lines = text
            .lines()
            .map(|line| serde_json::from_str(line).expect(line));
        let lines = lines.filter(|line: &Value| line["type"] == name);
        lines.collect::<Vec<_>>()
    };
    let (branches, rows) = (of_type("branch"), of_type("row"));
    assert_eq!(
        (branches.len(), rows.len(), of_type("hash").len()),
        (2, 2, 2)
    );
    assert_eq!(branches[1]["params"]["push"], "2");
    assert_eq!(rows[1]["params"]["push"], 2);
    assert_eq!(rows[1]["results"]["steps"], 15);
    // The past is counted once.
    assert_eq!(of_type("summary")[0]["steps"], 6 + 2 * 9);
}

#[test]
fn what_cannot_be_branched_is_said() {
    let scene = Scene::new(PUSHED);
    let refused = |args: &[&str], text: &str| {
        let output = branch(&scene, "push=1", args);
        assert_eq!(output.status.code(), Some(2), "{}", stdout(&output));
        assert!(stderr(&output).contains(text), "{}", stderr(&output));
    };
    refused(&["--remote-api=0"], "the server of the ZeroMQ remote API");
    refused(&["--no-start"], "--no-start");
    refused(&["--capture", "x.swc"], "--capture");
    assert!(!scene.folder.path().join("out/results.csv").exists());

    let output = branch_at("3", &scene, "push=1", &[]);
    assert_eq!(output.status.code(), Some(2));
    let said = stderr(&output);
    assert!(said.contains("has ended after 0.750 s, before"), "{said}");
    assert!(!scene.folder.path().join("out").exists());
}
