//! Tests whose subject is a whole run: `t.run`, the conformance suite, what scripts write, and the order in which results are told.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use test_support::process::{
    LIMIT, processes_with, run_for_code, run_within, wait_until, wait_within,
};

/// Writes test files into a folder and runs them there; the exit code, and what was written to standard output and error.
fn run(files: &[(&str, &str)], args: &[&str]) -> (i32, String) {
    try_run(files, args).expect("it ends")
}

/// The same; an error with the output if it was ended by a signal.
fn try_run(files: &[(&str, &str)], args: &[&str]) -> Result<(i32, String), String> {
    let dir = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        std::fs::write(dir.path().join(name), text).expect("a file");
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("test").args(args).current_dir(dir.path());
    run_for_code(&mut command, Duration::from_secs(120))
}

const SCENE: &str = "sim = require 'sim'
local batch = require 'swanilda.batch'
local goal = batch.param('goal', 1)
function sysCall_init() print('goal ' .. goal) io.write('a ', 'line\\n') end
function sysCall_sensing()
    batch.result('time', sim.getSimulationTime())
    if sim.getSimulationTime() > 0.2 then error('too late') end
end
function sysCall_afterSimulation() io.stderr:write('no end') end";

#[test]
fn a_scene_runs_in_a_simulator_of_its_own() {
    let suite = "local t = require 'swanilda.test'
    it('tells what it did', function()
        local ran = t.run('scene.lua', { time = 0.1, params = { goal = 3 } })
        assert.equal('goal 3\\na line\\nno end\\n', ran.output)
        assert.same({0, 5, '0.2'}, {ran.errors, ran.steps, ran.params['result.time']})
        assert.equal('stderr', ran.lines[3].level)
    end)
    it('does not touch that of the test', function()
        t.step()
        local ran = t.run('scene.lua', { time = 1 })
        assert.equal(1, ran.errors)
        assert.is_truthy(ran.output:find('[/Script:error]', 1, true))
        assert.near(0.05, t.time(), 1e-9)
        assert.same({}, t.lines())
    end)
    it('can be a script of any kind', function()
        local ran = t.run('scene.lua', { as = 'simulation', empty = true, start = false, loops = 2 })
        assert.same({'', 0}, {ran.output, ran.steps})
    end)
    it('says what is wrong', function()
        assert.has_error(function() t.run('missing.lua') end)
        assert.has_error(function() t.run('scene.lua', { speed = 1 }) end)
        assert.has_error(function() t.run('scene.lua', { as = 'robot' }) end)
        assert.has_error(function() t.run('scene.lua', { steps = 'x' }) end)
    end)";
    let (code, output) = run(&[("run_test.lua", suite), ("scene.lua", SCENE)], &["-v"]);
    assert!(code == 0 && output.contains("4 passed"), "{output}");
}

#[test]
fn a_scene_that_does_not_end_is_ended() {
    let suite = "local t = require 'swanilda.test'
    it('loops', function() t.run('loop.lua', { steps = 1 }) end)
    it('goes on', function() t.run('idle.lua') end)";
    let files = [
        ("long_test.lua", suite),
        (
            "loop.lua",
            "function sysCall_sensing() while true do end end",
        ),
        ("idle.lua", "function sysCall_sensing() end"),
    ];
    let (code, output) = run(&files, &["--timeout", "4", "--sim-timeout", "2"]);
    assert!(
        code == 1 && output.contains("longer than 4 s") && output.contains("more than 2 s"),
        "{output}"
    );
}

#[test]
fn a_test_that_is_stopped_tells_where_it_was() {
    let suite = "
    local sim = require 'sim'
    local t = require 'swanilda.test'
    it('loops', function()
        while true do end
    end)
    it('has a script that loops', function()
        local code = 'function sysCall_actuation()\\n  while true do end\\nend'
        sim.setObjectAlias(sim.createScript(sim.scripttype_simulation, code), 'robot')
        t.step()
    end)";
    let (code, output) = run(&[("loop_test.lua", suite)], &["--timeout", "3"]);
    assert_eq!(code, 1);
    for place in [
        "It was at loop_test.lua:5:",
        "It was at [string \"/robot\"]:2:",
        "--> /robot:2",
    ] {
        assert!(output.contains(place), "{place}:\n{output}");
    }
}

#[test]
fn a_test_that_hangs_while_it_is_closed_fails_alone() {
    let suite = "
    local sim = require 'sim'
    it('hangs', function() left = setmetatable({}, { __gc = function() while true do end end }) end)
    it('goes on', function() end)
    it('empties what it can reach', function()
        local registry = debug.getregistry()
        for key in next, registry do registry[key] = false end
        for key in next, package.loaded do package.loaded[key] = false end
    end)";
    let (code, output) = run(&[("close_test.lua", suite)], &["-v", "--timeout", "3"]);
    assert_eq!(code, 1, "{output}");
    assert!(
        output.contains("ERROR close_test.lua::hangs") && output.contains("in a finalizer (__gc)"),
        "{output}"
    );
    assert!(
        output.contains("PASS close_test.lua::goes on") && output.contains("1 error"),
        "{output}"
    );
}

#[test]
#[cfg(unix)]
fn isolated_tests_crash_alone() {
    let suite = "
    local sim = require 'sim'
    local t = require 'swanilda.test'
    it('goes on', function() print('first') t.step(2) end)
    it('is killed', function() os.execute('kill -ABRT $PPID; exec sleep 1 >/dev/null 2>&1') end)
    it('fails', function() print('last words') assert.equal(1, 2) end)
    it('loops', function() while true do end end)
    pending('is to be written')";
    let (code, output) = run(
        &[("crash_test.lua", suite)],
        &["-v", "--isolate", "--timeout", "3", "-j", "2"],
    );
    assert_eq!(code, 1, "{output}");
    assert!(
        output.contains("the test has ended its process") && output.contains("SIGABRT"),
        "{output}"
    );
    assert!(
        output.contains("1 passed, 1 failed, 2 errors, 1 pending"),
        "{output}"
    );
    assert!(
        output.contains("last words") && output.contains("longer than 3 s"),
        "{output}"
    );
    assert!(output.contains("crash_test.lua:6"), "{output}");
}

#[cfg(target_os = "linux")]
#[test]
fn isolated_tests_end_with_the_process_that_has_started_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let suite = "it('loops', function() assert.is_nil(io.read()) io.open('begun', 'w'):close() while true do end end)";
    std::fs::write(folder.path().join("endless_test.lua"), suite).expect("a file");
    let word = std::process::id().to_string();
    let mut tests = Command::new(env!("CARGO_BIN_EXE_swanilda"))
        .args(["test", "--isolate", "--timeout", "1000"])
        .env("SWANILDA_ISOLATED_ORPHANS", &word)
        .current_dir(folder.path())
        .spawn()
        .expect("it starts");
    let word = format!("SWANILDA_ISOLATED_ORPHANS={word}");
    wait_until("the test runs", || folder.path().join("begun").exists());
    assert_eq!(processes_with(&word), 2);
    tests.kill().expect("it runs");
    wait_within(&mut tests, LIMIT).expect("it ends");
    wait_until("no process is left", || processes_with(&word) == 0);
}

#[test]
#[cfg(unix)]
fn after_a_crash_all_tests_run_again_in_children() {
    for signal in ["ABRT", "ILL"] {
        let suite = "
    it('goes on', function() end)
    it('crashes', function() os.execute('kill -SIGNAL $PPID; exec sleep 1 >/dev/null 2>&1') end)
    it('fails', function() assert.equal(1, 2) end)";
        let suite = suite.replace("SIGNAL", signal);
        let (code, output) = run(&[("crash_test.lua", &suite)], &["-v", "-j", "1"]);
        assert_eq!(code, 1, "{output}");
        assert_eq!(
            output
                .matches("All tests run again, each in a child process")
                .count(),
            1,
            "{output}"
        );
        assert!(output.contains(&format!("SIG{signal}")), "{output}");
        assert!(output.contains("1 passed, 1 failed, 1 error"), "{output}");
    }
}

#[test]
#[cfg(unix)]
fn a_stream_of_results_is_not_begun_twice() {
    let suite = "it('crashes', function() os.execute('kill -ABRT $PPID; exec sleep 1 >/dev/null 2>&1') end)";
    let output =
        try_run(&[("crash_test.lua", suite)], &["--json", "-j", "1"]).expect_err("a crash");
    assert!(output.starts_with("ended by a signal"), "{output}");
    assert_eq!(output.matches("\"begin\"").count(), 1, "{output}");
    assert!(!output.contains("All tests run again"), "{output}");
}

#[test]
fn a_hook_of_a_script_runs_beside_the_time_limit() {
    let suite = "
    local sim = require 'sim'
    it('has none', function() debug.sethook() while true do end end)
    it('has one for lines', function() debug.sethook(function() end, 'l') while true do
        end end)
    it('has one that counts', function() debug.sethook(function() end, '', 100) while true do end end)
    it('has one in a coroutine', function()
        local co = coroutine.create(function() while true do end end)
        debug.sethook(co)
        coroutine.resume(co)
    end)
    it('is called and found', function()
        local lines, counts = 0, 0
        local function line() lines = lines + 1 end
        debug.sethook(line, 'l')
        local x = 1
        x = 2
        assert.same({line, 'l', 0}, {debug.gethook()})
        debug.sethook(function() counts = counts + 1 end, '', 10)
        for i = 1, 1000 do x = i end
        assert.equal(10, select(3, debug.gethook()))
        debug.sethook()
        assert.is_true(lines > 1 and counts > 50)
    end)";
    let (code, output) = run(&[("hook_test.lua", suite)], &["-v", "--timeout", "3"]);
    assert_eq!(code, 1, "{output}");
    assert!(output.contains("1 passed, 4 errors"), "{output}");
    assert_eq!(
        output.matches("It was at hook_test.lua").count(),
        4,
        "each is stopped where it is: {output}"
    );
}

#[test]
fn what_scripts_write_belongs_to_their_test() {
    let suite = "
    local sim = require 'sim'
    local t = require 'swanilda.test'
    it('writes', function()
        print('first')
        io.write('second ', 2, ' ', 0.5, '\\n')
        io.stdout:write('third'):write(' is one line\\n')
        io.stderr:write('fourth\\n')
        io.write('fif') print('th')
        sim.executeScriptString('io.write(\"sixth\\\\n\")', sim.createScript(sim.scripttype_customization, 'sim = require \"sim\"'))
        io.write('seventh has no end')
        assert.same({'first', 'second 2 0.5', 'third is one line', 'fifth', 'sixth', 'seventh has no end'}, t.prints())
        assert.has_error(function() io.write({}) end, \"bad argument #1 to 'write' (string expected, got table)\")
        error('to be shown')
    end)
    it('writes files as ever', function()
        local name = t.file('written.txt')
        io.output(name) io.write('text', 1.0) io.output():close() io.output(io.stdout)
        assert.equal('text1.0', io.open(name):read('a'))
        assert.same({}, t.prints())
    end)";
    let (code, output) = run(&[("write_test.lua", suite)], &["--tap"]);
    assert_eq!(code, 1, "{output}");
    for line in [
        "second 2 0.5",
        "third is one line",
        "fourth",
        "fifth",
        "sixth",
        "seventh has no end",
    ] {
        let lines: Vec<_> = output
            .lines()
            .filter(|shown| shown.contains(line))
            .collect();
        assert!(
            lines.iter().all(|line| line.starts_with(' ')) && !lines.is_empty(),
            "{line}: {output}"
        );
    }
    assert!(
        output.contains("ok 2") || output.contains("ok 1 - write_test.lua::writes files as ever"),
        "{output}"
    );
}

#[test]
fn results_with_recordings_are_reported_as_they_come() {
    let suite = "
    local sim = require 'sim'
    local t = require 'swanilda.test'
    local function record(name) t.golden(name, { x = function() return 1 end }) t.step(2) end
    it('a', function() record('one') end)
    it('b', function() while true do end end)
    it('c', function() record('one') end)";
    let (code, output) = run(
        &[("a_test.lua", suite)],
        &["--update-golden", "-v", "-j", "3", "--timeout", "3"],
    );
    let at = |text: &str| {
        output
            .find(text)
            .unwrap_or_else(|| panic!("{text} is missing:\n{output}"))
    };
    assert_eq!(code, 1);
    assert!(
        at("PASS a_test.lua::a") < at("ERROR a_test.lua::b"),
        "a waits for nobody: {output}"
    );
    assert!(
        at("ERROR a_test.lua::b") < at("FAIL a_test.lua::c"),
        "c waits for those before it: {output}"
    );
}

/// With coverage, which must not change what a script does.
#[test]
fn the_conformance_suite_runs_through_the_runner() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let cases = cases_below(&root.join("tests/conformance"));
    let known = std::fs::read_to_string(root.join("tests/conformance/KNOWN.md"))
        .expect("the list is there");
    let pending = known.lines().filter(|line| line.starts_with("| `")).count();
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    let dir = tempfile::tempdir().expect("a folder");
    let coverage = format!("--coverage={}", dir.path().join("lcov.info").display());
    command
        .args(["test", "tests/conformance", &coverage])
        .current_dir(root);
    let output = run_within(&mut command, Duration::from_secs(300)).expect("it ends");
    assert!(
        output.contains(&format!("{} passed, {pending} pending", cases - pending)),
        "{output}"
    );
}

fn cases_below(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder)
        .expect("the folder is readable")
        .flatten()
        .map(|entry| entry.path());
    let count = |path: std::path::PathBuf| {
        if path.is_dir() {
            cases_below(&path)
        } else {
            usize::from(path.extension().is_some_and(|e| e == "expected"))
        }
    };
    entries.map(count).sum()
}

/// Suites that pass in busted pass here, and assertions that do not hold say the same as there.
#[test]
fn suites_of_busted_run_unchanged() {
    let suites = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/busted");
    let (code, output) = run(&[], &[suites.to_str().expect("a path in UTF-8")]);
    assert_eq!(code, 0, "{output}");
}

#[test]
fn a_table_raised_as_an_error_is_shown_with_its_elements() {
    let (code, output) = run(
        &[(
            "a_test.lua",
            "it('raises', function() error({code = 7}) end)",
        )],
        &[],
    );
    assert_eq!(code, 1);
    assert!(output.contains("[code] = 7"), "{output}");
}

#[test]
fn the_scenes_of_the_project_pass_their_tests() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .args(["test", "scenes", "--timeout", "500"])
        .current_dir(env!("CARGO_MANIFEST_DIR"));
    let (code, output) = run_for_code(&mut command, Duration::from_secs(500)).expect("it ends");
    assert_eq!(code, 0, "{output}");
}
