//! `swanilda test --coverage` as its users run it.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use test_support::process::run_for_code;

const SCENE: &str = "sim = require 'sim'
local pid = require 'lib.pid'

local function far(x)
    if x > 1000 then
        return true
    end
    return false
end

function sysCall_init()
    controller = pid.new(2)
    thread = coroutine.create(function()
        coroutine.yield()
        count = 1
        coroutine.yield()
        count = 2
    end)
end

function sysCall_actuation()
    x = controller:update(0.1)
    if far(x) then
        print('far')
    end
    coroutine.resume(thread)
end
";

const MODULE: &str = "local M = {}

function M.new(kp)
    return setmetatable({ kp = kp }, { __index = M })
end

function M:update(error)
    return self.kp * error
end

function M:reset()
    self.kp = 0
end

return M
";

const TESTS: &str = "local t = require 'swanilda.test'
it('drives', function()
    t.load('scenes/drive.lua')
    t.step(3)
end)
it('moves', function()
    t.load('scenes/robot.ttt')
    t.step(3)
end)
";

const ROBOT: &[u8] = include_bytes!("../../data/robot.ttt");

const REPORT: &str = "TN:
SF:coverage/scenes/robot.ttt/robot/script.lua
FN:1,sysCall_init
FN:5,sysCall_actuation
FNDA:1,sysCall_init
FNDA:1,sysCall_actuation
FNF:2
FNH:2
DA:1,1
DA:2,1
DA:5,1
DA:6,1
LF:4
LH:4
end_of_record
TN:
SF:lib/pid.lua
FN:3,M.new
FN:7,M:update
FN:11,M:reset
FNDA:1,M.new
FNDA:1,M:update
FNDA:0,M:reset
FNF:3
FNH:2
DA:1,1
DA:3,1
DA:4,1
DA:7,1
DA:8,1
DA:11,1
DA:12,0
DA:15,1
LF:8
LH:7
end_of_record
TN:
SF:scenes/drive.lua
FN:4,far
FN:11,sysCall_init
FN:13,anonymous@13
FN:21,sysCall_actuation
FNDA:1,far
FNDA:1,sysCall_init
FNDA:1,anonymous@13
FNDA:1,sysCall_actuation
FNF:4
FNH:4
DA:1,1
DA:2,1
DA:5,1
DA:6,0
DA:8,1
DA:11,1
DA:12,1
DA:13,1
DA:14,1
DA:15,1
DA:16,1
DA:17,1
DA:21,1
DA:22,1
DA:23,1
DA:24,0
DA:26,1
LF:17
LH:15
end_of_record
";

fn project() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let files = [
        ("scenes/drive.lua", SCENE.as_bytes()),
        ("scenes/robot.ttt", ROBOT),
        ("lib/pid.lua", MODULE.as_bytes()),
    ];
    for (name, bytes) in files
        .into_iter()
        .chain([("robot_test.lua", TESTS.as_bytes())])
    {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("below the folder")).expect("folders");
        std::fs::write(path, bytes).expect("a file");
    }
    folder
}

fn run(folder: &Path, args: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("test").args(args).current_dir(folder);
    let (code, output) = run_for_code(&mut command, Duration::from_secs(120)).expect("it ends");
    assert_eq!(code, 0, "{output}");
    output
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect(name)
}

/// Whether a line of the output has these words.
fn has_row(output: &str, row: &str) -> bool {
    output
        .lines()
        .any(|line| line.split_whitespace().eq(row.split_whitespace()))
}

#[test]
fn lines_of_scenes_scripts_and_modules_are_counted() {
    let project = project();
    let output = run(project.path(), &["--coverage", "-j", "1"]);
    assert_eq!(read(project.path(), "lcov.info"), REPORT);
    let copy = read(project.path(), "coverage/scenes/robot.ttt/robot/script.lua");
    assert!(copy.starts_with("function sysCall_init()"), "{copy}");
    for row in [
        "lib/pid.lua 8 7 87.5 12",
        "scenes/drive.lua 17 15 88.2 6, 24",
    ] {
        assert!(has_row(&output, row), "{output}");
    }
    assert!(output.contains("counting makes Lua code up to"), "{output}");
}

#[test]
fn children_report_their_lines_to_the_parent() {
    let project = project();
    run(project.path(), &["--coverage", "--isolate", "-j", "2"]);
    assert_eq!(read(project.path(), "lcov.info"), REPORT);
    let copy = read(project.path(), "coverage/scenes/robot.ttt/robot/script.lua");
    assert!(copy.starts_with("function sysCall_init()"), "{copy}");
}

#[test]
fn the_report_does_not_depend_on_the_number_of_threads() {
    let project = project();
    run(
        project.path(),
        &["--coverage=report.info", "-j", "3", "--repeat", "2"],
    );
    let report = read(project.path(), "report.info");
    assert!(
        report.starts_with("TN:\nSF:coverage/scenes/robot.ttt/robot/script.lua\n"),
        "{report}"
    );
    // Each test ran twice.
    let doubled = REPORT.lines().map(|line| match line.rsplit_once(',') {
        Some((start, count)) if start.starts_with("DA:") => {
            format!("{start},{}\n", count.parse::<u64>().expect("a count") * 2)
        }
        _ => format!("{line}\n"),
    });
    let counts = |text: &str| {
        text.lines()
            .filter(|line| line.starts_with("DA:"))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(counts(&report), counts(&doubled.collect::<String>()));
}

#[test]
fn lines_that_run_late_are_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let module = "local M = {}
local function square(x)
    return x * x
end
function M.sum(n, odd)
    local sum = 0
    for i = 1, n do
        sum = sum + square(i)
    end
    if odd then
        sum = sum + 1
    end
    return sum
end
function M.late()
    local found = pcall(function()
        for _ = 1, 1000 do
            square(1)
        end
        error('found')
    end)
    return found
end
return M
";
    let test = "local m = require 'sums'
it('sums', function() m.sum(1000, true) m.sum(1000, true) m.sum(1000, false) end)
it('comes late', function()
    m.sum(1000, false)
    coroutine.wrap(function() for i = 1, 100 do m.sum(i) end m.late() end)()
end)
";
    std::fs::write(folder.path().join("sums.lua"), module).expect("a file");
    std::fs::write(folder.path().join("sums_test.lua"), test).expect("a file");
    let output = run(folder.path(), &["--coverage"]);
    assert!(has_row(&output, "sums.lua 16 16 100.0"), "{output}");
}

#[test]
fn a_test_that_loops_forever_is_ended() {
    let folder = tempfile::tempdir().expect("a folder");
    let test = "local function work()
    for i = 1, 40 do
        local x = i
    end
end
it('never ends', function()
    while true do
        work()
        if x then
            error('never')
        end
    end
end)
";
    std::fs::write(folder.path().join("loop_test.lua"), test).expect("a file");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .args(["test", "--coverage", "--timeout", "1"])
        .current_dir(folder.path());
    let (code, output) = run_for_code(&mut command, Duration::from_secs(120)).expect("it ends");
    assert_eq!(code, 1, "{output}");
    assert!(
        output.contains("took longer than 1 s") && !output.contains("could not be ended"),
        "{output}"
    );
}

/// A text with every kind of jump, and with more constants than an instruction can name.
fn odd_text() -> String {
    let many: String = (0..300)
        .map(|i| format!("    t.field{i} = {i}.5 + #t\n"))
        .collect();
    include_str!("../../coverage/odd.lua").replace("    -- MANY\n", &many)
}

/// Lua's own hook is asked at the same time: slow, and right.
#[test]
fn lines_are_those_that_luas_hook_tells() {
    let folder = tempfile::tempdir().expect("a folder");
    let test = "it('runs', function()
    local seen, chunk = {}, assert(loadfile('odd.lua'))
    local function note(_, line) if debug.getinfo(2, 'S').source == '@odd.lua' then seen[line] = true end end
    local wrap = coroutine.wrap
    function coroutine.wrap(body)
        return wrap(function(...) debug.sethook(note, 'l') return body(...) end)
    end
    debug.sethook(note, 'l')
    chunk()
    debug.sethook()
    local file = io.open('seen.txt', 'w')
    for line in pairs(seen) do file:write(line, '\\n') end
    file:close()
end)";
    std::fs::write(folder.path().join("odd.lua"), odd_text()).expect("a file");
    std::fs::write(folder.path().join("odd_test.lua"), test).expect("a file");
    run(folder.path(), &["--coverage"]);
    let seen: std::collections::BTreeSet<u32> = read(folder.path(), "seen.txt")
        .lines()
        .map(|line| line.parse().expect("a line"))
        .collect();
    let report = read(folder.path(), "lcov.info");
    let lines = report
        .lines()
        .filter_map(|line| line.strip_prefix("DA:")?.split_once(','));
    let wrong: Vec<_> = lines
        .filter(|(line, count)| seen.contains(&line.parse().expect("a line")) != (*count != "0"))
        .collect();
    assert!(
        wrong.is_empty() && seen.len() > 350,
        "{wrong:?}, {} lines",
        seen.len()
    );
}

/// What a script can notice of the probes: nothing, short of the debug library.
#[test]
fn programs_run_as_without_coverage() {
    let folder = tempfile::tempdir().expect("a folder");
    let module = "local M = {}
function M.fail(t)
    return t.name.first
end
function M.count(...)
    return select('#', ...), debug.getinfo(1, 'l').currentline
end
M.dumped = string.dump(function(x)
    return x + 1
end, true)
return M
";
    let test = "it('runs', function()
    local m = require 'parts'
    local ok, message = pcall(m.fail, {})
    assert.equal(\"./parts.lua:3: attempt to index a nil value (field 'name')\", message)
    assert.same({3, 6}, {m.count(nil, nil, nil)})
    assert.same({'x', 2}, {load('return ...', '@./parts.lua')('x', 2)})
    assert.equal(5, load('return y', '@./parts.lua', 't', {y = 5})())
    assert.equal('./parts.lua:1: unexpected symbol near <eof>', select(2, load('return return', '@./parts.lua')):gsub('near .*', 'near <eof>'))
    assert.equal(m.count, load(string.dump(function() return require('parts').count end))())
    assert.equal(3, load(m.dumped)(2))
    assert.is_nil(_G['9'])
    assert.is_nil(loadfile('missing.lua'))
    assert.is_false(pcall(dofile, 'missing.lua'))
    assert.equal('table', type(dofile('parts.lua')))
    local _, problem = pcall(require, 'broken')
    assert.equal(\"error loading module 'broken' from file './broken.lua'\", problem:match('^(.-):'))
end)";
    for (name, text) in [
        ("parts.lua", module),
        ("parts_test.lua", test),
        ("broken.lua", "if"),
    ] {
        std::fs::write(folder.path().join(name), text).expect("a file");
    }
    run(folder.path(), &[]);
    run(folder.path(), &["--coverage"]);
}
