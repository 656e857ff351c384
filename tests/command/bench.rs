//! `swanilda bench` as its users run it.

use std::process::Command;
use std::time::Duration;

use test_support::process::run_for_code;

/// A body that falls, a sensor that sees it, and a print for each step, which is not shown.
const SCENE: &str = "
sim = require 'sim'
function sysCall_init()
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setBoolProperty(box, 'dynamic', true)
    sim.createVisionSensor(2, {64, 64, 0, 0}, {0.01, 5, 1, 0.1, 0, 0, 0, 0, 0, 0, 0})
end
function sysCall_sensing()
    print('a step')
    if sim.getNamedStringParam('fails') then error('no more') end
    if sim.getNamedStringParam('stops') then sim.stopSimulation() end
end
";

fn bench(args: &[&str]) -> (i32, String) {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("scene.lua"), SCENE).expect("a file");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .args(["bench", "scene.lua", "--seconds", "1", "--steps", "5"])
        .args(args)
        .current_dir(folder.path());
    run_for_code(&mut command, Duration::from_secs(120)).expect("it ends")
}

/// The number before a word.
fn number(text: &str, before: &str) -> f64 {
    let head = text
        .split(before)
        .next()
        .and_then(|head| head.split_whitespace().last());
    let number = head.and_then(|word| word.parse().ok());
    number.unwrap_or_else(|| panic!("no number before '{before}' in {text}"))
}

#[test]
fn rates_and_phases_are_shown_for_one_world_and_many() {
    let (code, text) = bench(&["--worlds", "3", "--dt", "0.02"]);
    assert_eq!(code, 0, "{text}");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 4, "{text}");
    assert!(lines[0].starts_with("scene.lua: 20 ms a step"), "{text}");
    assert!(lines[1].starts_with("1 world: ") && lines[3].starts_with("3 worlds, "));
    let (rate, factor) = (
        number(lines[1], " steps/s"),
        number(lines[1], " times real time"),
    );
    assert!((factor / (0.02 * rate) - 1.0).abs() < 0.05, "{text}");
    assert!(number(lines[3], " steps/s") > 0.0);
    let phases = ["physics ", "sensors ", "rest "].map(|phase| {
        let rest = lines[2].split_once(phase).expect("the phase is shown").1;
        number(rest, " us")
    });
    assert!(phases.iter().all(|&time| time > 0.0), "{text}");
    let step = 1e6 / rate;
    let sum: f64 = phases.iter().sum();
    assert!((sum / step - 1.0).abs() < 0.05, "{text}");
}

#[test]
fn scenes_that_end_themselves_begin_again() {
    let (code, text) = bench(&["--worlds", "2", "-D", "stops=1"]);
    assert_eq!(code, 0, "{text}");
    assert!(number(&text, " steps/s") > 10.0, "{text}");
}

#[test]
fn errors_of_scripts_are_shown_with_the_world() {
    let (code, text) = bench(&["--worlds", "2", "-D", "fails=1"]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("scene.lua:10: no more"), "{text}");
    assert!(text.contains("2 worlds, world 0: "), "{text}");
}
