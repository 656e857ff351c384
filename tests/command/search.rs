//! `swanilda search` and properties as their users run them.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use serde_json::Value;
use test_support::process::run_for_code;

const TIMEOUT: Duration = Duration::from_secs(300);

fn swanilda(folder: &Path, args: &[&str]) -> (i32, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.args(args).current_dir(folder);
    run_for_code(&mut command, TIMEOUT).expect("it ends")
}

/// A folder with that test file.
fn folder(code: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    write(&folder, code);
    folder
}

fn write(folder: &tempfile::TempDir, code: &str) {
    let text = "local sim = require 'sim' local t = require 'swanilda.test'\n".to_owned() + code;
    std::fs::write(folder.path().join("a_test.lua"), text).expect("a file");
}

fn in_folder(code: &str, args: &[&str]) -> (i32, String) {
    swanilda(folder(code).path(), args)
}

/// The bench of controllers, each of which is there in a right and in a broken version.
fn controllers(version: &str, cases: &str) -> Vec<Value> {
    let bench = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/search");
    let folder = tempfile::tempdir().expect("a folder");
    let filter = format!("::{version}: ");
    let bench = bench.to_string_lossy();
    let args = [
        "search", &*bench, "--filter", &filter, "--cases", cases, "--json",
    ];
    let (_, text) = swanilda(folder.path(), &args);
    let lines = text
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok());
    lines.filter(|line| line["type"] == "test").collect()
}

#[test]
fn bugs_of_controllers_are_found_and_shrunk() {
    let found = controllers("broken", "400");
    assert_eq!(found.len(), 20);
    let missed: Vec<_> = found
        .iter()
        .filter(|test| test["status"] == "passed")
        .collect();
    assert!(missed.is_empty(), "{missed:#?}");
    let mut chosen: Vec<_> = found
        .iter()
        .filter_map(|test| test["property"]["chosen"].as_u64())
        .collect();
    chosen.sort_unstable();
    assert_eq!(chosen.len(), 20);
    assert!(
        chosen[10] <= 3,
        "values and faults of the simplest cases: {chosen:?}"
    );
}

#[test]
fn right_controllers_give_no_alarm() {
    for test in controllers("right", "30") {
        assert_eq!(test["status"], "passed", "{test:#}");
        assert_eq!(test["property"]["cases"], 30);
    }
}

const SUM: &str = "
t.property('sums are small', {cases = 100}, function(g)
    local list = g.list(function() return g.integer(0, 9) end, {max = 5})
    local sum = 0
    for _, v in ipairs(list) do sum = sum + v end
    assert.is_true(sum < 15, 'too much')
end)";

/// The simplest list, by whatever path it was found.
#[test]
fn a_failure_is_shrunk_kept_and_tried_first() {
    let folder = folder(SUM);
    let (code, text) = swanilda(folder.path(), &["test"]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("a_test.lua:7: too much"), "{text}");
    assert!(
        text.contains(
            "4: local list = g.list(function() return g.integer(0, 9) end, {max = 5})  -> {6, 9}"
        ),
        "{text}"
    );
    let (code, again) = swanilda(folder.path(), &["test"]);
    assert_eq!(code, 1);
    assert!(again.contains("failed in case 1 of the search"), "{again}");
    // Once it is repaired, nothing is left of it.
    write(&folder, &SUM.replace("< 15", "< 46"));
    assert_eq!(swanilda(folder.path(), &["test"]).0, 0);
    write(&folder, SUM);
    let (_, text) = swanilda(folder.path(), &["test"]);
    assert!(!text.contains("failed in case 1 of the search"), "{text}");
}

const FALL: &str = "
t.property('it falls slowly', function(g)
    t.run_for(1)
    local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(ball, {0, 0, g.float(1, 5)})
    sim.setBoolProperty(ball, 'dynamic', true)
    t.always(function() return 7 + sim.getVelocity(ball)[3] end, 'below 7 m/s')
    t.run_for(1)
end)";

fn capture_in(folder: &Path) -> PathBuf {
    let files = std::fs::read_dir(folder.join(".swanilda/failures")).expect("failures are kept");
    let mut files = files.filter_map(|entry| Some(entry.ok()?.path()));
    files
        .find(|path| path.extension().is_some_and(|e| e == "swc"))
        .expect("a capture")
}

#[test]
fn a_failing_case_is_replayed_from_its_capture() {
    let folder = folder(FALL);
    let (code, text) = swanilda(
        folder.path(),
        &["search", "--cases", "50", "--html", "report.html"],
    );
    assert_eq!(code, 1, "{text}");
    let message = "always 'below 7 m/s' does not hold at";
    assert!(text.contains(message), "{text}");
    let capture = capture_in(folder.path());
    let (code, replayed) = swanilda(folder.path(), &["replay", &capture.to_string_lossy()]);
    assert_eq!(code, 0, "{replayed}");
    assert!(replayed.contains(message), "{replayed}");
    let page = std::fs::read_to_string(folder.path().join("report.html")).expect("a report");
    for part in [
        "The simplest one found",
        "The first case that failed",
        "Robustness over time",
        "least robustness",
        ">its last 1 s</a>",
    ] {
        assert!(page.contains(part), "the report has no '{part}'");
    }
    // Links lead to files beside the report.
    let links: Vec<_> = page
        .split("href=\"")
        .skip(1)
        .filter_map(|rest| rest.split(['"', '#']).next())
        .collect();
    let files: Vec<_> = links
        .iter()
        .filter(|link| link.ends_with(".html") || link.ends_with(".swc"))
        .collect();
    assert!(files.len() >= 3, "{links:?}");
    for file in files {
        assert!(folder.path().join(file).exists(), "there is no {file}");
    }
}

/// The same seed and number of cases give the same result by any number of threads.
#[test]
fn searches_repeat() {
    let code = "
t.property('far from the point', function(g)
    local x, y = g.float(-5, 5), g.float(-5, 5)
    t.always(function() return math.sqrt((x - 1) ^ 2 + (y + 2) ^ 2) - 0.05 end)
    t.step()
end)";
    let search = |jobs: &str, seed: &str| {
        let folder = folder(code);
        let args = [
            "search", "--cases", "300", "-j", jobs, "--seed", seed, "--out", "cases",
        ];
        let (_, _) = swanilda(folder.path(), &args);
        let table = folder
            .path()
            .join("cases/a-test-1-0-far-from-the-point.csv");
        std::fs::read_to_string(table).expect("a table of the cases")
    };
    let table = search("1", "5");
    assert!(
        table.starts_with("status,robustness,choice1,choice2\npassed,"),
        "{table}"
    );
    assert_eq!(search("3", "5"), table);
    assert_ne!(search("1", "6"), table);
}

/// Cases go on from moments of others at which these have chosen values: with the same results as those that run from the beginning, each
/// in a simulator of its own.
#[test]
fn cases_go_on_from_the_run_of_others() {
    let code = "
t.property('stays', {fresh = FRESH}, function(g)
    local begun = io.open(t.file('begun'), 'a')
    begun:write('x')
    begun:close()
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}, 0)
    sim.setObjectPosition(box, {0, 0, 0.05})
    sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
    t.always(function() return 99 - sim.getObjectPosition(box)[1] end)
    g.faults({{'push', box, {choice = {{1, 0, 0}, {2, 0, 0}}}, {0.1, 0.5}}}, {most = 2, within = 3})
    t.run_for(5)
    sim.setObjectPosition(box, {g.float(0, 4), 0, 0.05})
    t.run_for(1)
end)";
    let search = |jobs: &str, fresh: &str| {
        let folder = folder(&code.replace("FRESH", fresh));
        let args = ["search", "--cases", "120", "-j", jobs, "--out", "cases"];
        let (exit, text) = swanilda(folder.path(), &args);
        assert_eq!(exit, 0, "{text}");
        let read = |name| std::fs::read_to_string(folder.path().join(name)).expect("it is there");
        (read("cases/a-test-1-0-stays.csv"), read("begun").len())
    };
    let (table, begun) = search("1", "true");
    // Once more for the outcome.
    assert!((120..=121).contains(&begun), "{begun}");
    let (undone, begun) = search("1", "false");
    assert_eq!(undone, table);
    assert!(begun < 115, "{begun} cases ran from the beginning");
    assert_eq!(search("2", "false").0, table);
}

#[test]
fn only_properties_are_searched() {
    let code = "it('is a test', function() error('it ran') end)";
    let (exit, text) = in_folder(code, &["search", "--cases", "5"]);
    assert_eq!(exit, 5, "{text}");
    assert!(
        text.contains("no properties found: t.property makes them"),
        "{text}"
    );
}

#[test]
fn wrong_properties_are_explained() {
    let cases = [
        (
            "t.property('x', {case = 3}, function() end)",
            "wrong option case",
        ),
        (
            "t.property('x')",
            "a name, a table of options and a function are expected",
        ),
        (
            "t.property('x', function(g) g.float(2, 1) end)",
            "the lower bound 2 is above the upper one, 1",
        ),
        (
            "t.property('x', function(g) g.float(0, 1 / 0) end)",
            "bounds are finite",
        ),
        (
            "t.property('x', function(g) g.integer(0.5, 1) end)",
            "whole numbers",
        ),
        (
            "t.property('x', function(g) g.choice {} end)",
            "a list of alternatives is expected",
        ),
        (
            "t.property('x', function(g) g.faults { {'fog'} } end)",
            "fog is no fault",
        ),
        (
            "t.property('x', {shrinks = 2}, function(g) while true do g.boolean() end end)",
            "at most 10000 times",
        ),
        (
            "it('x', function() t.eventually(3) end)",
            "a function is expected",
        ),
        (
            "it('x', function() t.leadsTo(print, print) end)",
            "within is a number of seconds",
        ),
        (
            "it('x', function() t.always(function() return 'yes' end) t.step() end)",
            "returns a boolean or a number",
        ),
    ];
    for (code, reason) in cases {
        let (exit, text) = in_folder(code, &["test"]);
        assert_eq!(exit, 1, "{code}: {text}");
        assert!(text.contains(reason), "{code}: {text}");
    }
}

/// What cannot be undone is named, since cases are undone.
#[test]
fn a_case_that_cannot_be_undone_is_named() {
    let code = "t.property('x', function(g) f = io.open(t.file('a_test.lua')) g.float(0, 1) end)";
    let (exit, text) = in_folder(code, &["test"]);
    assert_eq!(exit, 1);
    assert!(text.contains("a branch does not undo the file"), "{text}");
    assert!(text.contains("fresh = true"), "{text}");
}

/// What ran in cases that were undone has run.
#[test]
fn lines_of_cases_are_covered() {
    let code = "local pid = require 'pid' t.property('x', {cases = 20, fresh = FRESH}, function(g) pid.of(g.integer(-9, 9)) end)";
    let module = "local M = {}\nfunction M.of(x)\n  if x < 0 then\n    return -1\n  end\n  if x > 99 then\n    return 2\n  end\n  return 1\nend\nreturn M\n";
    for fresh in ["false", "true"] {
        let folder = folder(&code.replace("FRESH", fresh));
        std::fs::write(folder.path().join("pid.lua"), module).expect("a file");
        let (exit, text) = swanilda(folder.path(), &["test", "--coverage"]);
        assert_eq!(exit, 0, "{text}");
        let line = text.lines().find(|line| line.starts_with("pid.lua"));
        let words: Vec<_> = line
            .expect("the module is counted")
            .split_whitespace()
            .collect();
        assert_eq!(words, ["pid.lua", "8", "7", "87.5", "7"], "fresh: {fresh}");
    }
}

/// In simulators of their own cases may open what they like, and are shrunk as any other.
#[test]
fn fresh_cases_may_open_files() {
    let code = "t.property('x', {cases = 30, fresh = true}, function(g)
        f = io.open(t.file('a_test.lua'))
        t.always(function() return true end)
        t.step()
        assert.is_true(g.integer(0, 100) < LIMIT, 'too large')
    end)";
    let (exit, text) = in_folder(&code.replace("LIMIT", "101"), &["test"]);
    assert_eq!(exit, 0, "{text}");
    let (exit, text) = in_folder(&code.replace("LIMIT", "37"), &["test"]);
    assert_eq!(exit, 1);
    assert!(text.contains("-> 37"), "{text}");
}

/// A case that hangs is a failure with its values, and is tried first the next time.
#[test]
fn a_case_that_hangs_is_shown_with_its_values() {
    let folder =
        folder("t.property('x', function(g) local n = g.integer(0, 9) while n > 7 do end end)");
    let (exit, text) = swanilda(folder.path(), &["test", "--timeout", "1"]);
    assert_eq!(exit, 1, "{text}");
    assert!(text.contains("took longer than 1 s"), "{text}");
    assert!(text.contains("it had chosen, in order: 9"), "{text}");
}

#[test]
fn temporal_properties_say_when_they_are_violated() {
    let cases = [
        (
            "t.always(function() return 0.5 - t.time() end, 'early')",
            "always 'early' does not hold at 0.55 s (by 0.05)",
        ),
        (
            "t.eventually(function() return t.time() > 3 end, 0.5)",
            "has not come about within 0.5 s",
        ),
        (
            "t.eventually(function() return t.time() > 3 end, 4)",
            "has not come about when the test ends at 1",
        ),
        (
            "t.eventually(function() return t.time() - 3 end)",
            "has not come about until the end at 1",
        ),
        (
            "t.holdsUntil(function() return t.time() < 0.42 end, function() return t.time() > 0.6 end)",
            "does not hold at 0.45 s",
        ),
        (
            "t.holdsUntil(function() return true end, function() return false end, 0.3)",
            "was not ended within 0.3 s",
        ),
        (
            "t.leadsTo(function() return t.time() > 0.2 end, function() return false end, 0.3)",
            "has led to nothing within 0.3 s",
        ),
    ];
    for (code, reason) in cases {
        let (exit, text) = in_folder(
            &format!("it('x', function() {code} t.run_for(1) end)"),
            &["test"],
        );
        assert_eq!(exit, 1, "{code}: {text}");
        assert!(text.contains(reason), "{code}: {text}");
    }
}

#[test]
fn temporal_properties_that_hold_are_silent() {
    let cases = [
        "t.always(function() return 2 - t.time() end)",
        "t.eventually(function() return t.time() > 0.4 end, 0.5)",
        "t.eventually(function() return t.time() > 0.9 end)",
        "t.holdsUntil(function() return t.time() < 0.5 end, function() return t.time() > 0.4 end, 0.6)",
        "t.leadsTo(function() return t.time() == 0.2 end, function() return t.time() > 0.3 end, 0.3)",
        // The window of what begins at the end is not over.
        "t.leadsTo(function() return t.time() > 0.9 end, function() return false end, 0.5)",
    ];
    for code in cases {
        let (exit, text) = in_folder(
            &format!("it('x', function() {code} t.run_for(1) end)"),
            &["test"],
        );
        assert_eq!(exit, 0, "{code}: {text}");
    }
}

/// The generators, the faults and simMujoco have tests of their own, in Lua.
#[test]
fn what_has_tests_in_lua_passes_them() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/lua");
    let folder = tempfile::tempdir().expect("a folder");
    let (code, text) = swanilda(folder.path(), &["test", &tests.to_string_lossy()]);
    assert_eq!(code, 0, "{text}");
}
