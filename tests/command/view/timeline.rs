//! A capture in the viewer: its moments, forwards and back, and how it goes on from one of them.

use std::io::Read;
use std::process::Command;

use flate2::read::GzDecoder;
use serde_json::{Value, json};

use super::page::{Page, get};
use super::served::Served;

/// A robot that is pushed by a property, prints, sends messages, touches something and fails.
const SCENE: &str = "
sim = require 'sim'
function sysCall_init()
    mover = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(mover, 'mover')
    sim.setFloatProperty(mover, 'customData.speed', 1)
    print('ready')
end
function sysCall_actuation()
    local time = sim.getSimulationTime()
    local x = sim.getObjectPosition(mover)[1]
    sim.setObjectPosition(mover, {x + 0.05 * sim.getFloatProperty(mover, 'customData.speed') * (0.5 + math.random()), 0, 1})
    print(('at %.2f, of %s'):format(time, os.getenv('SPEED_OF')))
    if math.abs(time - 1.2) < 1e-6 then sim.createDummy(0.1) end
    if math.abs(time - 1) < 1e-6 then sim.broadcastMsg({id = 'half'}) end
    if math.abs(time - 1.5) < 1e-6 then error('too far') end
end
";

/// What it has printed at the beginning.
const BEGINNING: [&str; 2] = ["ready", "Simulation started."];

/// A capture of two seconds of that, in a viewer.
fn captured(script: &str, options: &[&str]) -> Served {
    captured_file("scene.lua", script, options)
}

fn captured_file(name: &str, script: &str, options: &[&str]) -> Served {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join(name);
    std::fs::write(&scene, script).expect("the scene is written");
    let run = Command::new(env!("CARGO_BIN_EXE_swanilda"))
        .args(["run", "--time", "2", "--quiet"])
        .arg(&scene)
        .current_dir(folder.path())
        .arg("--capture")
        .arg(folder.path().join("run.swc"))
        .env("SPEED_OF", "the capture")
        .output();
    run.expect("it runs");
    std::fs::remove_file(&scene).expect("it is there");
    Served::start_file(
        "view",
        folder,
        "run.swc",
        &[&["--no-open"], options].concat(),
    )
}

/// What a page knows, from all messages so far.
struct Shown {
    page: Page,
    scene: Value,
    timeline: Value,
    lines: Vec<String>,
    mover: i64,
    objects: Vec<i64>,
}

impl Shown {
    fn of(served: &Served) -> Self {
        let mut shown = Self {
            page: Page::open(served),
            scene: Value::Null,
            timeline: Value::Null,
            lines: Vec::new(),
            mover: -1,
            objects: Vec::new(),
        };
        shown.until(|shown| shown.timeline["complete"] == true && shown.mover >= 0);
        shown
    }

    fn until(&mut self, holds: impl Fn(&Self) -> bool) {
        while !holds(self) {
            let text = self.page.text();
            self.take(&text);
        }
    }

    fn take(&mut self, text: &Value) {
        if text["type"] == "snapshot" || text["logBegins"] == true {
            self.lines.clear();
        }
        for name in ["scene", "timeline"] {
            if let Some(value) = text.get(name) {
                match name {
                    "scene" => self.scene = value.clone(),
                    _ => self.timeline = value.clone(),
                }
            }
        }
        let list = |name: &str| text[name].as_array().cloned().unwrap_or_default();
        self.lines.extend(
            list("log")
                .iter()
                .map(|line| line["text"].as_str().expect("it has that form").to_owned()),
        );
        if text["type"] == "snapshot" {
            self.objects.clear();
        }
        for object in list("objects") {
            let handle = object["handle"].as_i64().expect("it has that form");
            if object["alias"] == "mover" {
                self.mover = handle;
            }
            if !self.objects.contains(&handle) {
                self.objects.push(handle);
            }
        }
        let removed = list("removed");
        self.objects
            .retain(|handle| !removed.contains(&json!(handle)));
    }

    fn ask(&mut self, request: Value) -> Result<Value, String> {
        self.page.ask(request)
    }

    fn frame(&self) -> u64 {
        self.scene["frame"].as_u64().expect("it has that form")
    }

    /// What there is at a frame: pose, count of objects, lines.
    fn at(&mut self, frame: u64) -> (Value, usize, Vec<String>) {
        self.ask(json!({"do": "seek", "frame": frame}))
            .expect("it goes there");
        self.until(|shown| shown.frame() == frame);
        (
            self.property("pose"),
            self.objects.len(),
            self.lines.clone(),
        )
    }

    fn property(&mut self, name: &str) -> Value {
        let rows = self
            .ask(json!({"do": "inspect", "handle": self.mover}))
            .expect("it is there");
        let row = rows
            .as_array()
            .expect("it has that form")
            .iter()
            .find(|row| row["name"] == name);
        row.expect("it has that property")["value"].clone()
    }

    fn last(&self) -> u64 {
        self.timeline["frames"].as_u64().expect("it has that form") - 1
    }

    fn go_on(&mut self) {
        assert_eq!(self.ask(json!({"do": "live"})), Ok(json!(true)));
        self.until(|shown| shown.scene["mode"] == "live");
    }
}

#[test]
fn any_moment_of_a_capture_comes_back_as_it_was() {
    let served = captured(SCENE, &[]);
    let mut shown = Shown::of(&served);
    assert_eq!(
        (
            &shown.scene["mode"],
            &shown.scene["readOnly"],
            shown.frame()
        ),
        (&json!("capture"), &json!(true), 0)
    );
    assert_eq!(shown.lines, BEGINNING);
    let last = shown.last();
    assert!((32..45).contains(&last), "{last}");
    let moments: Vec<_> = (0..=last).map(|frame| shown.at(frame)).collect();
    assert!(moments[1].0 != moments[last as usize].0);
    assert!(moments[28].1 > moments[0].1, "an object came");
    assert_eq!(
        moments[last as usize]
            .2
            .iter()
            .filter(|line| line.contains("of the capture"))
            .count(),
        31
    );
    for frame in [last, 3, 30, 29, 28, 27, 0, 35, 10, last, last - 1, 1] {
        assert_eq!(shown.at(frame), moments[frame as usize], "frame {frame}");
    }
    // Steps go from there.
    let (before, after) = (shown.at(20), shown.at(21));
    for (count, frame, moment) in [(-1, 20, &before), (1, 21, &after)] {
        assert_eq!(
            shown.ask(json!({"do": "step", "count": count})),
            Ok(json!(true))
        );
        shown.until(|shown| shown.frame() == frame);
        assert_eq!(
            (shown.property("pose"), &shown.lines),
            (moment.0.clone(), &moment.2)
        );
    }
    assert_eq!(shown.timeline["outcome"], "The capture ends here.");
}

#[test]
fn a_run_that_has_a_file_open_goes_back_as_well() {
    let script = SCENE.replace(
        "    print('ready')",
        "    file = io.open('log.txt', 'w')\n    print('ready')",
    );
    let script = script.replace("    local x =", "    file:write('x')\n    local x =");
    let served = captured(&script, &[]);
    let mut shown = Shown::of(&served);
    let moments: Vec<_> = [0, 5, 20].map(|frame| shown.at(frame)).into();
    for (frame, moment) in [(20, 2), (5, 1), (0, 0), (20, 2)] {
        assert_eq!(shown.at(frame), moments[moment], "frame {frame}");
    }
}

#[test]
fn the_timeline_has_marks() {
    let served = captured(SCENE, &[]);
    let mut shown = Shown::of(&served);
    let marks = shown.timeline["marks"].as_array().cloned().unwrap();
    let of = |kind: &str| {
        let mut found = marks.iter().filter(|mark| mark["kind"] == kind);
        let mark = found.next().expect("there is a mark").clone();
        assert!(found.next().is_none(), "one {kind}");
        mark
    };
    assert_eq!(of("broadcast")["text"], "half");
    let error = of("error");
    assert!(
        error["text"].as_str().unwrap().contains("too far"),
        "{error}"
    );
    assert!(
        (error["time"].as_f64().unwrap() - 1.55).abs() < 0.06,
        "{error}"
    );
    let frame = error["frame"].as_u64().unwrap();
    assert!(shown.at(frame).2.last().unwrap().contains("too far"));
    assert!(!shown.at(frame - 1).2.last().unwrap().contains("too far"));
}

#[test]
fn a_capture_plays_in_the_pace_of_its_simulation() {
    let served = captured(SCENE, &["--speed=4"]);
    let mut shown = Shown::of(&served);
    let begun = std::time::Instant::now();
    assert_eq!(shown.ask(json!({"do": "play"})), Ok(json!(true)));
    shown.until(|shown| shown.scene["playing"] == true);
    let last = shown.last();
    shown.until(|shown| shown.frame() == last && shown.scene["playing"] == false);
    let passed = begun.elapsed().as_secs_f64();
    assert!((0.4..20.0).contains(&passed), "{passed}");
    assert_eq!(shown.ask(json!({"do": "stop"})), Ok(json!(true)));
    shown.until(|shown| shown.frame() == 0);
    assert_eq!(shown.lines, BEGINNING);
}

#[test]
fn a_capture_cannot_be_changed_before_it_goes_on() {
    let served = captured(SCENE, &[]);
    let mut shown = Shown::of(&served);
    let mover = shown.mover;
    for request in [
        json!({"do": "set", "handle": mover, "name": "alias", "value": "a"}),
        json!({"do": "run", "code": "1"}),
        json!({"do": "select", "handles": [mover]}),
        json!({"do": "ui", "window": 1, "input": {"type": "click"}}),
        json!({"do": "configure", "handle": mover}),
        json!({"do": "answer", "question": 1}),
    ] {
        let refused = Err("this is a capture: go on from here first".to_owned());
        assert_eq!(shown.ask(request.clone()), refused, "{request}");
    }
    assert!(shown.ask(json!({"do": "seek", "frame": -1})).is_err());
    assert!(shown.ask(json!({"do": "seek", "frame": u64::MAX})).is_ok());
    shown.until(|shown| shown.frame() == shown.last());
}

#[test]
fn pages_that_only_read_look_at_all_moments_and_never_go_on() {
    let served = captured(SCENE, &["--view=read-only"]);
    let mut shown = Shown::of(&served);
    assert_eq!(shown.scene["goesOn"], false);
    shown.at(5);
    let refused = Err("this page may only read".to_owned());
    assert_eq!(shown.ask(json!({"do": "live"})), refused);
    assert_eq!(shown.ask(json!({"do": "run", "code": "1"})), refused);
}

#[test]
fn it_goes_on_live_with_a_changed_property() {
    let served = captured(SCENE, &[]);
    let mut shown = Shown::of(&served);
    let captured = shown.at(20);
    shown.at(10);
    let before = shown.property("pose");
    let steps = shown.scene["steps"].clone();
    shown.go_on();
    assert_eq!(
        (
            &shown.scene["state"],
            &shown.scene["readOnly"],
            &shown.timeline
        ),
        (&json!("paused"), &json!(false), &Value::Null)
    );
    // It stands still at that moment.
    assert_eq!(
        shown.ask(json!({"do": "run", "code": "(os.getenv('SPEED_OF')) == nil"})),
        Ok(json!("true"))
    );
    assert_eq!(
        (shown.property("pose"), &shown.scene["steps"]),
        (before, &steps)
    );
    let set = json!({"do": "set", "handle": shown.mover, "name": "customData.speed", "value": -1});
    assert_eq!(shown.ask(set), Ok(json!(true)));
    assert_eq!(
        shown.ask(json!({"do": "step", "count": 10})),
        Ok(json!(true))
    );
    let goal = steps.as_u64().unwrap() + 10;
    shown.until(|shown| shown.scene["steps"] == goal && shown.scene["state"] == "paused");
    let x = |pose: &Value| pose[0].as_f64().unwrap();
    assert!(x(&shown.property("pose")) < x(&captured.0) - 0.3);
    assert!(
        shown
            .lines
            .iter()
            .filter(|line| line.contains("of nil"))
            .count()
            == 10,
        "{:?}",
        shown.lines
    );
    assert!(shown.ask(json!({"do": "seek", "frame": 1})).is_err());
    assert!(shown.ask(json!({"do": "step", "count": -1})).is_err());
    assert!(shown.ask(json!({"do": "live"})).is_err());
}

#[test]
fn without_a_change_it_goes_on_as_the_capture_did() {
    let script = SCENE.replace("os.getenv('SPEED_OF')", "'it'");
    let served = captured(&script, &["--speed=0"]);
    let mut shown = Shown::of(&served);
    let captured = shown.at(25);
    let steps = shown.scene["steps"].as_u64().unwrap();
    shown.at(10);
    shown.go_on();
    let by = steps - shown.scene["steps"].as_u64().unwrap();
    assert_eq!(
        shown.ask(json!({"do": "step", "count": by})),
        Ok(json!(true))
    );
    shown.until(|shown| shown.scene["steps"] == steps && shown.scene["state"] == "paused");
    shown.until(|shown| {
        shown
            .lines
            .last()
            .is_some_and(|line| line == "Simulation paused.")
    });
    shown.lines.pop();
    shown
        .lines
        .retain(|line| !line.starts_with("live from here"));
    assert_eq!(
        (shown.property("pose"), &shown.lines),
        (captured.0, &captured.2)
    );
}

#[test]
fn it_goes_on_with_a_changed_script() {
    let served = captured(SCENE, &[]);
    let mut shown = Shown::of(&served);
    shown.at(10);
    shown.go_on();
    let script = shown
        .ask(json!({"do": "run", "code": "sim.getObject('/Script')"}))
        .unwrap();
    let script: i64 = script.as_str().unwrap().parse().unwrap();
    let text = "function sysCall_init() print('new') end";
    assert_eq!(
        shown.ask(json!({"do": "set", "handle": script, "name": "code", "value": text})),
        Ok(json!(true))
    );
    let restart = format!("sim.initScript({script})");
    assert!(shown.ask(json!({"do": "run", "code": restart})).is_ok());
    shown.until(|shown| shown.lines.last().is_some_and(|line| line == "new"));
}

const TEST: &str = "
local sim = require 'sim'
local t = require 'swanilda.test'
it('arrives', function()
    print('stamp', sim.getSystemTime())
    t.step(4)
    assert.equal('there', 'elsewhere')
end)";

#[test]
fn the_capture_of_a_failed_test_is_shown_as_a_recording() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("race_test.lua"), TEST).expect("the test is written");
    let run = Command::new(env!("CARGO_BIN_EXE_swanilda"))
        .args(["test", "race_test.lua", "--capture-failures=."])
        .current_dir(folder.path())
        .output();
    let printed = String::from_utf8(run.expect("it runs").stdout).unwrap();
    let stamp = printed.split("stamp, ").nth(1).expect("it is printed");
    let stamp = stamp.split_whitespace().next().unwrap().to_owned();
    std::fs::remove_file(folder.path().join("race_test.lua")).expect("it is there");
    let name = "race-test-1-0-arrives.swc";
    let served = Served::start_file("view", folder, name, &["--no-open"]);
    let index: Value = serde_json::from_slice(&get(&served, "recording", &[]).body).unwrap();
    let marks = index["marks"].as_array().unwrap();
    let failure = marks
        .iter()
        .find(|mark| mark["kind"] == "failure")
        .expect("it is marked");
    assert!(
        failure["text"].as_str().unwrap().contains("elsewhere"),
        "{failure}"
    );
    assert!(
        (index["end"].as_f64().unwrap() - 0.2).abs() < 0.06,
        "{index}"
    );
    let chunk = get(&served, "recording/0", &[]).body;
    let mut text = Vec::new();
    GzDecoder::new(&*chunk)
        .read_to_end(&mut text)
        .expect("it is compressed");
    let text = String::from_utf8_lossy(&text).into_owned();
    assert!(text.contains(&format!("stamp, {stamp}")), "the console");
}

#[test]
fn scripts_in_python_are_played_and_end_live_with_an_error() {
    let has_python = Command::new("python3").arg("--version").output();
    if !has_python.is_ok_and(|output| output.status.success()) {
        return test_support::skipped_outside_of_ci("there is no python3");
    }
    let script = "#python\ndef sysCall_init():\n    global sim\n    sim = require('sim')\n    d = sim.createDummy(0.1)\n    sim.setObjectAlias(d, 'mover')\ndef sysCall_actuation():\n    print('at', sim.getSimulationTime())\n";
    let served = captured_file("scene.py", script, &["--speed=0"]);
    let mut shown = Shown::of(&served);
    let (late, early) = (shown.at(20), shown.at(5));
    assert_eq!((early.2.len() + 15, shown.at(20)), (late.2.len(), late));
    shown.go_on();
    assert_eq!(shown.ask(json!({"do": "play"})), Ok(json!(true)));
    let ended = "the Python process of this script has ended.";
    shown.until(|shown| shown.lines.iter().any(|line| line.contains(ended)));
}
