//! `swanilda replay` with questions: times, changes, expressions.

use serde_json::{Value, json};

use super::{Bench, replay, text};

/// A script moves a box, and an error of it shows in its sign; the physics moves a ball.
const SCENE: &str = "\
sim = require 'sim'
local box, n = nil, 0
function sysCall_init()
    box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}, 0)
    sim.setObjectAlias(box, 'Box')
    local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1}, 0)
    sim.setObjectAlias(ball, 'Ball')
    sim.setObjectPosition(ball, {5, 0, 1})
    sim.setObjectInt32Param(ball, sim.shapeintparam_static, 0)
end
local function move(x)
    sim.setObjectPosition(box, {x, 0, 0.05})
end
function sysCall_actuation()
    n = n + 1
    print('step', n)
    if n % 7 == 0 then
        move(-n)
    elseif n < 30 then
        move(n)
    end
end
";

/// What ends with the simulator is no part of a moment.
const ADD_ON: &str = "function sysCall_cleanup() print('the end of the simulator') end";

fn capture() -> tempfile::TempDir {
    let bench = Bench::new(&[("scene.lua", SCENE), ("add_on.lua", ADD_ON)]);
    bench.run(&["run", "scene.lua", "--addon", "add_on.lua", "--steps", "40"]);
    bench.without_scene()
}

/// The answer as JSON.
fn answer(folder: &tempfile::TempDir, args: &[&str]) -> Value {
    let output = replay(
        &folder.path().join("run.swc"),
        &[args, &["--json"]].concat(),
    );
    let line = text(&output.stdout);
    serde_json::from_str(line.trim()).unwrap_or_else(|_| panic!("{line}\n{}", text(&output.stderr)))
}

#[test]
fn a_change_names_the_step_and_the_line() {
    let folder = capture();
    let found = answer(&folder, &["--at", "1.8", "--last-change", "/Box:pose"]);
    assert_eq!(found["step"], json!(35), "{found}");
    assert_eq!(
        found["by"],
        json!({"script": "scene.lua", "line": 12, "code": "sim.setObjectPosition(box, {x, 0, 0.05})"})
    );
    assert!(
        found["text"]
            .as_str()
            .is_some_and(|text| text.contains("{-35, 0")),
        "{found}"
    );
    let found = answer(&folder, &["--at", "1.6", "--last-change", "/Box.pose"]);
    assert_eq!(
        found["step"],
        json!(29),
        "nothing moves it from then on: {found}"
    );
    let fallen = answer(&folder, &["--at", "1.6", "--last-change", "/Ball:pose"]);
    assert_eq!(
        (&fallen["by"], &fallen["step"]),
        (&Value::Null, &json!(32)),
        "{fallen}"
    );
}

#[test]
fn an_expression_is_true_from_a_step_on() {
    let folder = capture();
    let found = answer(
        &folder,
        &[
            "--when",
            "sim.getObjectPosition(sim.getObject '/Box')[1] < -8",
        ],
    );
    assert_eq!(
        (&found["step"], &found["by"]["line"]),
        (&json!(14), &json!(12)),
        "{found}"
    );
    let fallen = "sim.getObjectPosition(sim.getObject '/Ball')[3] < 0.5";
    let found = answer(&folder, &["--when", fallen]);
    // 0.5 m take 0.32 s.
    assert_eq!(
        (&found["step"], &found["by"]),
        (&json!(7), &Value::Null),
        "{found}"
    );
}

#[test]
fn expressions_leave_no_trace() {
    let folder = capture();
    let changes = "(function() sim.setObjectPosition(sim.getObject '/Box', {99, 0, 0}); x = {}; return false end)()";
    let output = replay(&folder.path().join("run.swc"), &["--when", changes]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let said = text(&output.stderr);
    assert!(
        said.contains("is not true until the end of the capture"),
        "{said}"
    );
}

#[test]
fn a_time_is_reached_with_its_lines_and_hash() {
    let folder = capture();
    let capture = folder.path().join("run.swc");
    let output = replay(&capture, &["--at", "0.5"]);
    let said = text(&output.stdout);
    assert!(
        said.contains("step, 10\n") && !said.contains("step, 11\n"),
        "{said}"
    );
    let last = said.lines().last().unwrap_or_default();
    assert!(last.starts_with("step 10, 0.500 s: state hash "), "{said}");
    let late = replay(&capture, &["--at", "99"]);
    assert_eq!(late.status.code(), Some(1));
    assert!(text(&late.stderr).contains("the time is not reached until the end of the capture"));
}

#[test]
fn what_is_not_there_is_said() {
    let folder = capture();
    let capture = folder.path().join("run.swc");
    for (args, said) in [
        (
            ["--last-change", "/Bux:pose"],
            "there is no property /Bux:pose",
        ),
        (
            ["--last-change", "/Box:size"],
            "there is no property /Box:size",
        ),
        (
            ["--when", "nothing.at.all"],
            "has no value until the end of the capture",
        ),
        (
            ["--when", "false"],
            "is not true until the end of the capture",
        ),
    ] {
        let output = replay(&capture, &args);
        let text = text(&output.stderr);
        assert!(text.contains(said), "{args:?}: {text}");
        assert_eq!(output.status.code(), Some(1), "{args:?}");
    }
}
