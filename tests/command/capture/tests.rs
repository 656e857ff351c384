//! Tests of users and runs of a batch that fail: their captures run again.

use std::fs;

use test_support::process::output_of;

use super::{Bench, replay, text};

const TEST: &str = "
local sim = require 'sim'
local t = require 'swanilda.test'
describe('a race', function()
    it('is lost', function()
        local value = sim.getSystemTime()
        print('stamp', value)
        t.step(3)
        local file = io.open('data.txt')
        assert.equal('other', file and file:read 'a' or value)
    end)
    it('is won', function() t.step(2) end)
end)";

#[test]
fn a_failed_test_leaves_a_capture_that_runs_again() {
    let bench = Bench::new(&[("race_test.lua", TEST), ("data.txt", "text")]);
    let args = [
        "test",
        "race_test.lua",
        "--capture-failures=captures",
        "--junit",
        "report.xml",
        "--html",
        "report.html",
    ];
    let first = output_of(&mut bench.swanilda(&args));
    assert_eq!(first.status.code(), Some(1), "{}", text(&first.stderr));
    let folder = bench.scene.path().join("captures");
    let captures: Vec<_> = fs::read_dir(&folder)
        .expect("a test has failed")
        .map(|entry| entry.expect("it can be read").path())
        .collect();
    let [capture] = captures.as_slice() else {
        panic!("a capture of the failed test only: {captures:?}");
    };
    let name = capture.file_name().expect("it has a name");
    for report in ["report.xml", "report.html"] {
        let report = bench.scene.path().join(report);
        let report = fs::read_to_string(report).expect("it is written");
        assert!(report.contains(&*name.to_string_lossy()), "{report}");
    }
    let kept = bench.captures.path().join("race.swc");
    fs::copy(capture, &kept).expect("our own folder is writable");
    let printed = text(&first.stdout);
    // Behind the source, which the report shows as well.
    let stamp = printed.rsplit("stamp, ").next().unwrap_or_default();
    let stamp = stamp.lines().next().unwrap_or_default().to_owned();
    let _folder = bench.without_scene();
    let again = replay(&kept, &[]);
    let (out, said) = (text(&again.stdout), text(&again.stderr));
    assert_eq!(again.status.code(), Some(0), "{said}");
    assert!(out.contains(&format!("stamp, {stamp}")), "{out}\n{printed}");
    assert!(
        said.contains("the test has failed") && said.contains("text"),
        "{said}"
    );
    assert!(said.ends_with("as in the capture, to the end\n"), "{said}");
}

const RUN: &str = "
local sim = require 'sim'
local batch = require 'swanilda.batch'
function sysCall_sensing()
    print(batch.param('kp'), math.random(1000000), sim.getSystemTime())
    if batch.param('kp') == 2 and sim.getSimulationTime() > 0.2 then error('too much') end
end
";

#[test]
fn a_failed_run_of_a_batch_leaves_a_capture_that_runs_again() {
    let bench = Bench::new(&[("scene.lua", RUN)]);
    let args = [
        "batch",
        "scene.lua",
        "--sweep",
        "kp=1,2",
        "--seeds",
        "7,8",
        "--time",
        "0.5",
        "--capture-failures=captures",
    ];
    let first = output_of(&mut bench.swanilda(&args));
    let said = text(&first.stderr);
    assert_eq!(first.status.code(), Some(1), "{said}");
    let folder = bench.scene.path().join("captures");
    let mut captures: Vec<_> = fs::read_dir(&folder)
        .expect("runs have failed")
        .map(|entry| entry.expect("it can be read").path())
        .collect();
    captures.sort();
    assert_eq!(captures.len(), 2, "only those with kp = 2: {captures:?}");
    for capture in &captures {
        let name = capture
            .file_name()
            .expect("it has a name")
            .to_string_lossy();
        assert!(said.contains(&*name), "{said}");
    }
    let moved = bench.captures.path().join("run.swc");
    fs::copy(&captures[0], &moved).expect("it can be copied");
    let captures = bench.without_scene();
    let again = [(); 2].map(|()| replay(&captures.path().join("run.swc"), &[]));
    for output in &again {
        let said = text(&output.stderr);
        assert!(
            said.contains("too much") && said.ends_with("to the end\n"),
            "{said}"
        );
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert_eq!(output.stdout, again[0].stdout);
    }
    assert!(text(&again[0].stdout).starts_with("2, "));
}
