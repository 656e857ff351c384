//! `swanilda batch` as its users run it.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use test_support::process::run_for_code;

const SCENE: &str = "
sim = require 'sim'
local batch = require 'swanilda.batch'
local kp = batch.param('kp', 1)
function sysCall_sensing()
    if kp == 3 then error('too much') end
    if kp == 4 then while true do end end
    if sim.getSimulationTime() < 0.2 then return end
    batch.result('score', kp * math.random())
    batch.result('mode', batch.param('mode', 'none'))
    sim.stopSimulation()
end
";

fn batch(folder: &Path, args: &[&str]) -> (i32, String) {
    std::fs::write(folder.join("scene.lua"), SCENE).expect("a file");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .args(["batch", "scene.lua"])
        .args(args)
        .current_dir(folder);
    run_for_code(&mut command, Duration::from_secs(120)).expect("it ends")
}

fn table(folder: &Path, out: &str) -> Vec<String> {
    let text = std::fs::read_to_string(folder.join(out).join("results.csv")).expect("the table");
    text.lines().map(str::to_owned).collect()
}

#[test]
fn every_run_has_its_row_whatever_the_number_of_threads() {
    let dir = tempfile::tempdir().expect("a folder");
    let args = ["--seeds", "5..7", "--sweep", "kp=1,2", "-D", "mode=fast"];
    for (jobs, out) in [("1", "one"), ("4", "four")] {
        let (code, output) = batch(
            dir.path(),
            &[&args[..], &["-j", jobs, "--out", out]].concat(),
        );
        assert!(
            code == 0 && output.contains("6 of 6 runs done, 0 failed"),
            "{output}"
        );
    }
    let rows = table(dir.path(), "one");
    assert_eq!(rows, table(dir.path(), "four"));
    assert_eq!(
        (rows.len(), rows[0].as_str()),
        (7, "run,seed,kp,error,steps,time,mode,score")
    );
    assert!(
        rows[1].starts_with("1,5,1,,")
            && rows[6].starts_with("6,7,2,,")
            && rows[6].contains(",fast,"),
        "{rows:?}"
    );
    let scores: std::collections::BTreeSet<_> =
        rows[1..].iter().map(|row| row.rsplit(',').next()).collect();
    assert_eq!(scores.len(), 6, "each seed has its own numbers: {rows:?}");
}

#[test]
fn a_run_that_fails_is_a_row() {
    let dir = tempfile::tempdir().expect("a folder");
    let (code, output) = batch(dir.path(), &["--sweep", "kp=1,3,4,2", "--timeout", "3"]);
    assert!(
        code == 1 && output.contains("4 of 4 runs done, 2 failed"),
        "{output}"
    );
    let rows = table(dir.path(), "results");
    assert!(
        rows[2].contains("too much") && rows[3].contains("longer than 3 s"),
        "{rows:?}"
    );
    assert!(
        !rows[1].contains("Script") && !rows[4].contains("Script"),
        "{rows:?}"
    );
}

#[test]
fn an_interrupted_batch_goes_on() {
    let dir = tempfile::tempdir().expect("a folder");
    let args = ["--seeds", "1..4", "--sweep", "kp=1"];
    assert_eq!(batch(dir.path(), &args).0, 0);
    let whole = table(dir.path(), "results");
    let log = dir.path().join("results/runs.jsonl");
    let text = std::fs::read_to_string(&log).expect("the log");
    // Cut in the third line, and with a mark in the first that a second run would not have made.
    let cut = text.match_indices('\n').nth(2).expect("four lines").0 - 10;
    std::fs::write(
        &log,
        text[..cut].replacen("\"steps\":", "\"steps\":1000", 1),
    )
    .expect("a file");
    assert_eq!(batch(dir.path(), &args).0, 0);
    let again = table(dir.path(), "results");
    assert!(
        again[1].contains(",1000"),
        "a row that is there is kept: {again:?}"
    );
    assert_eq!(again[2..], whole[2..]);
    let (code, output) = batch(dir.path(), &["--seeds", "1..5"]);
    assert!(
        code == 2 && output.contains("holds the results of another batch"),
        "{output}"
    );
    assert_eq!(batch(dir.path(), &[&args[..], &["--force"]].concat()).0, 0);
    assert_eq!(table(dir.path(), "results"), whole);
}

#[test]
fn a_batch_that_a_full_disk_or_a_kill_has_cut_off_begins_anew() {
    let dir = tempfile::tempdir().expect("a folder");
    let args = ["--seeds", "1..2", "--sweep", "kp=1"];
    assert_eq!(batch(dir.path(), &args).0, 0);
    let whole = table(dir.path(), "results");
    let results = dir.path().join("results");
    let manifest = std::fs::read_to_string(results.join("batch.json")).expect("a file");
    for left in ["", &manifest[..manifest.len() / 2]] {
        std::fs::write(results.join("batch.json"), left).expect("a file");
        std::fs::write(results.join(".swanilda-left.part"), left).expect("a file");
        // The rows may be those of another batch.
        let rows = std::fs::read_to_string(results.join("runs.jsonl")).expect("a file");
        let other = rows.replacen("\"steps\":", "\"steps\":1000", 1);
        std::fs::write(results.join("runs.jsonl"), other).expect("a file");
        let (code, output) = batch(dir.path(), &args);
        assert!(
            code == 0 && output.contains("batch.json is empty or cut off"),
            "{output}"
        );
        assert_eq!(table(dir.path(), "results"), whole);
        let there = std::fs::read_to_string(results.join("batch.json")).expect("a file");
        assert_eq!(there, manifest);
        assert!(!results.join(".swanilda-left.part").exists());
    }
}

const PYTHON_SCENE: &str = "#python
def sysCall_init():
    global sim, batch
    sim = require('sim')

def sysCall_sensing():
    import random
    order = '-'.join({'alpha', 'beta', 'gamma', 'delta', 'epsilon'})
    sim.setNamedStringParam('result.order', order)
    sim.setNamedStringParam('result.number', str(random.random()))
    own = [random.Random().random(), random.Random(7).random()]
    random.seed()
    own += [random.random(), random.Random().random()]
    assert len(set(own)) == 4 and own[1] == 0.32383276483316237, own
    sim.setNamedStringParam('result.own', repr(sum(own)))
    sim.stopSimulation()
";

#[test]
fn scripts_in_python_have_the_same_row_in_each_batch() {
    let dir = tempfile::tempdir().expect("a folder");
    let scene = dir.path().join("scene.py");
    std::fs::write(&scene, PYTHON_SCENE).expect("a file");
    for out in ["one", "two"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command
            .args(["batch", "scene.py", "--seeds", "0..3", "--out", out])
            .current_dir(dir.path());
        let (code, output) = run_for_code(&mut command, Duration::from_secs(120)).expect("it ends");
        if output.contains("could not be called") {
            return test_support::skipped_outside_of_ci("there is no python3");
        }
        assert_eq!(code, 0, "{output}");
    }
    let rows = table(dir.path(), "one");
    assert_eq!(rows, table(dir.path(), "two"));
    let distinct = |column: usize| {
        let values = rows[1..].iter().map(|row| row.split(',').nth(column));
        values.collect::<std::collections::BTreeSet<_>>().len()
    };
    assert_eq!(rows[0], "run,seed,error,steps,time,number,order,own");
    assert_eq!(distinct(5), 4, "each seed has its own numbers: {rows:?}");
    assert!(distinct(6) > 1, "and its own order of sets: {rows:?}");
    assert_eq!(distinct(7), 4, "and its own generators: {rows:?}");
}

#[test]
fn wrong_usage_is_an_error() {
    let dir = tempfile::tempdir().expect("a folder");
    for wrong in [
        ["--seeds", "9..1"],
        ["--seeds", "x"],
        ["--sweep", "kp"],
        ["--out", "/dev/null/x"],
    ] {
        assert_eq!(batch(dir.path(), &wrong).0, 2, "{wrong:?}");
    }
}

#[test]
fn scenes_of_coppeliasim_are_run() {
    let dir = tempfile::tempdir().expect("a folder");
    let files = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let mut unpack = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    unpack
        .arg("unpack")
        .arg(files.join("robot.ttt"))
        .arg("unpacked")
        .current_dir(dir.path());
    assert_eq!(
        run_for_code(&mut unpack, Duration::from_secs(60))
            .expect("it ends")
            .0,
        0
    );
    for scene in ["robot.ttt", "kinds.simscene.xml", "unpacked"] {
        let path = if scene == "unpacked" {
            dir.path().join(scene)
        } else {
            files.join(scene)
        };
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command
            .arg("batch")
            .arg(path)
            .args(["--time", "0.1", "--out", &format!("{scene}.results")])
            .current_dir(dir.path());
        let (_, output) = run_for_code(&mut command, Duration::from_secs(120)).expect("it ends");
        assert!(output.contains("1 of 1 runs done"), "{output}");
        let row = &table(dir.path(), &format!("{scene}.results"))[1];
        assert!(
            !row.contains("[string"),
            "no Lua error of a file read as Lua: {row}"
        );
        assert!(
            row.split(',').any(|value| value.starts_with("0.")),
            "it simulates: {row}"
        );
    }
}

#[test]
fn permissions_of_runs() {
    let dir = tempfile::tempdir().expect("a folder");
    let scene = "local sim = require 'sim'
    function sysCall_init() assert(io.open(sim.getStringProperty(sim.handle_scene, 'scenePath'))) assert(io.open('new', 'w')) end
    function sysCall_sensing() sim.stopSimulation() end";
    std::fs::write(dir.path().join("scene.lua"), scene).expect("a file");
    for (args, expected) in [
        (&["--no-unsafe"][..], 1),
        (&["--allow-write=."], 0),
        (&["--deny-all"], 1),
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command
            .args(["batch", "scene.lua", "--force"])
            .args(args)
            .current_dir(dir.path());
        let (code, output) = run_for_code(&mut command, Duration::from_secs(120)).expect("it ends");
        assert_eq!(code, expected, "{args:?}: {output}");
    }
    let rows = table(dir.path(), "results");
    assert!(rows[1].contains("--allow-read="), "{rows:?}");
}

#[test]
fn a_swept_parameter_that_no_run_reads_is_named() {
    let dir = tempfile::tempdir().expect("a folder");
    let (code, said) = batch(dir.path(), &["--sweep", "kp=1,2", "--sweep", "gain=1,2"]);
    assert_eq!(code, 0, "{said}");
    assert!(
        said.contains("no run has read the parameter gain;"),
        "{said}"
    );
    assert!(!said.contains("the parameter kp"), "{said}");
}
