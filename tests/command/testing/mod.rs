//! `swanilda test` as its users run it.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

mod branches;
mod coverage;
mod failures;
mod goldens;
mod recordings;
mod reports;
mod runs;

use test_support::process::run_for_code;

/// Writes test files into a folder and runs them there; the exit code, and what was written to standard output and error.
fn run(files: &[(&str, &str)], args: &[&str]) -> (i32, String) {
    run_in(tempfile::tempdir().expect("a folder").path(), files, args)
}

fn run_in(folder: &Path, files: &[(&str, &str)], args: &[&str]) -> (i32, String) {
    for (name, text) in files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().expect("below the folder")).expect("folders");
        std::fs::write(path, text).expect("a file");
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("test").args(args).current_dir(folder);
    run_for_code(&mut command, Duration::from_secs(120)).expect("it ends")
}

/// A line of the output that begins so.
fn has_line(output: &str, start: &str) -> bool {
    output.lines().any(|line| line.starts_with(start))
}

const HEAD: &str = "local sim = require 'sim' local t = require 'swanilda.test'\n";

fn simulating(code: &str) -> String {
    HEAD.to_owned() + code
}

/// A box that falls from a height.
const BOX: &str = "
local function box(height)
    local handle = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectInt32Param(handle, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(handle, sim.shapeintparam_respondable, 1)
    sim.setObjectAlias(handle, 'box')
    sim.setObjectPosition(handle, {0, 0, height})
    return handle
end
";

#[test]
fn exit_codes_are_those_of_pytest() {
    let pass = [("a_test.lua", "it('passes', function() end)")];
    let fail = [(
        "a_test.lua",
        "it('fails', function() assert.equal(1, 2) end)",
    )];
    assert_eq!(run(&pass, &[]).0, 0);
    assert_eq!(run(&fail, &[]).0, 1);
    assert_eq!(run(&[("a_test.lua", "it(")], &[]).0, 1);
    assert_eq!(run(&pass, &["missing"]).0, 4);
    assert_eq!(run(&pass, &["--nonsense"]).0, 4);
    assert_eq!(run(&pass, &["--shard", "3/2"]).0, 4);
    assert_eq!(run(&pass, &["--help"]).0, 0);
    assert_eq!(run(&[("a.lua", "")], &[]).0, 5);
    assert_eq!(run(&pass, &["--filter", "other"]).0, 5);
}

#[test]
fn tests_are_found_listed_filtered_and_shared_out() {
    let files = [
        (
            "a/drive_test.lua",
            "describe('car', function() it('one', function() end) it('two', function() end) end)",
        ),
        (
            "test_plain.lua",
            "function test_b() end function test_a() end",
        ),
        ("other.lua", "error('not a test')"),
    ];
    let all = "a/drive_test.lua::car one\na/drive_test.lua::car two\ntest_plain.lua::test_a\ntest_plain.lua::test_b\n";
    let listed = run(&files, &["--list"]).1;
    let mut lines: Vec<&str> = listed.lines().collect();
    lines.sort_unstable();
    assert_eq!(
        lines.join("\n") + "\n",
        all,
        "both plain tests are in one line of the file"
    );
    assert_eq!(
        run(
            &files,
            &["--list", "--filter", "car t", "--filter", "plain"]
        )
        .1
        .lines()
        .count(),
        3
    );
    assert_eq!(run(&files, &["--list", "a"]).1.lines().count(), 2);
    let shares = [
        run(&files, &["--list", "--shard", "1/2"]).1,
        run(&files, &["--list", "--shard", "2/2"]).1,
    ];
    assert!(shares.iter().all(|share| share.lines().count() == 2) && shares[0] != shares[1]);
    assert!(
        run(&files, &["--fail-fast", "-v", "--repeat", "2"])
            .1
            .contains("8 passed")
    );
}

#[test]
fn a_suite_of_pure_lua_shares_its_state_as_in_busted() {
    let suite = "
        describe('shared', function()
            local log = {}
            setup(function() log[#log + 1] = 'setup' end)
            before_each(function() log[#log + 1] = 'each' end)
            after_each(function() log[#log + 1] = 'after' end)
            it('one', function() assert.same({'setup', 'each'}, log) end)
            describe('inner', function()
                setup(function() log[#log + 1] = 'inner' end)
                teardown(function() log[#log + 1] = 'down' end)
                before_each(function() log[#log + 1] = 'more' end)
                it('two', function()
                    finally(function() log[#log + 1] = 'finally' end)
                    assert.same({'setup', 'each', 'after', 'inner', 'each', 'more'}, log)
                end)
            end)
            it('three', function()
                assert.same({'setup', 'each', 'after', 'inner', 'each', 'more', 'finally', 'after', 'down', 'each'}, log)
            end)
            pending('four')
            it('five')
            it('six', function() pending('not today') error('is not reached') end)
        end)
        insulate('alone', function() it('sets', function() leaked = 1 end) end)
        it('does not leak', function() assert.is_nil(leaked) end)";
    let (code, output) = run(&[("suite_test.lua", suite)], &["-v"]);
    assert_eq!(code, 0, "{output}");
    assert!(output.contains("5 passed, 3 pending"), "{output}");
}

/// The bodies of other tests are not loaded; what anything else can reach is.
#[test]
fn a_test_of_a_robot_finds_all_that_its_file_has_beside_tests() {
    let suite = simulating(
        "local log, one = {}, function() return 1 end
        it('first', function() log[#log + 1] = 'first' end)
        it('shared', one)
        describe('group', function()
            before_each(function() log[#log + 1] = 'each' end)
            it('is alone', function() assert.same({'each'}, log) end)
            for i = 1, 2 do it('in a loop ' .. i, function() assert.same({'each'}, log) return i end) end
        end)
        local function case(name, body) it(name, function() assert.equal(2, body()) end) end
        case('through a function', function() return one() + 1 end)
        it('calls one', function() assert.equal(1, one()) end) it('on one line', function() assert.equal(1, one()) end)
        function test_plain() assert.equal(1, one()) end
        it('fails', function()
            assert.equal(2, one())
        end)",
    );
    let (code, output) = run(&[("a_test.lua", &suite)], &["-v"]);
    assert_eq!(code, 1, "{output}");
    assert!(
        output.contains("9 passed, 1 failed") && output.contains("a_test.lua:15"),
        "{output}"
    );
}

#[test]
fn a_file_may_have_its_own_idea_of_a_test() {
    let suite = simulating(
        "local saved, real = {}, it
        it = function(name, body) saved[name] = body real(name, body) end
        it('gives', function() return 7 end)
        it('takes', function() assert.equal(7, saved.gives()) end)",
    );
    let (code, output) = run(&[("a_test.lua", &suite)], &[]);
    assert_eq!(code, 0, "{output}");
}

#[test]
fn each_test_of_a_robot_has_a_fresh_simulator() {
    let suite = simulating(
        "local count = 0
        for i = 1, 3 do
            it('is alone ' .. i, function()
                count = count + 1
                assert.equal(1, count)
                assert.equal(-1, sim.getObject('/mark', {noError = true}))
                sim.setObjectAlias(sim.createDummy(0.1), 'mark')
                t.step(5)
                assert.near(0.25, t.time(), 1e-9)
            end)
        end",
    );
    let (code, output) = run(&[("fresh_test.lua", &suite)], &[]);
    assert_eq!(code, 0, "{output}");
}

#[test]
fn the_hash_tells_whether_states_are_the_same() {
    let suite = simulating(
        "it('is that of the state', function()
            local dummy = sim.createDummy(0.1)
            local before = t.hash()
            assert.is_truthy(before:find('^%x+$') and #before == 16)
            sim.setObjectPosition(dummy, {1, 0, 0})
            assert.not_equal(before, t.hash())
            sim.setObjectPosition(dummy, {0, 0, 0})
            assert.equal(before, t.hash())
            t.step()
            assert.not_equal(before, t.hash())
        end)",
    );
    let (code, output) = run(&[("hash_test.lua", &suite)], &[]);
    assert_eq!(code, 0, "{output}");
}

#[test]
fn the_fixture_drives_simulation_and_scripts() {
    let scene = "sim = require 'sim'
        gain = 2
        function sysCall_init() robot = sim.createDummy(0.1) sim.setObjectAlias(robot, 'robot') end
        function sysCall_actuation()
            local x = sim.getFloatSignal('goal') or 0
            sim.setObjectPosition(robot, {x * gain, 0, 0})
            print('goal ' .. x)
        end
        function double(x) return 2 * x end
        function sysCall_msg(message) if message.id == 'hello' then heard = message.id end end";
    let suite = simulating(
        "local s
        before_each(function() t.load('scenes/robot.lua') s = t.script('/Script') end)
        local function x() return sim.getObjectPosition(t.object('/robot'))[1] end
        it('reaches functions and globals', function()
            assert.equal(8, s:call('double', 4))
            assert.equal(2, s:get('gain'))
            assert.has_error(function() s:run('nonsense(') end)
            s:set('gain', 3)
            t.signal('goal', 1.5)
            t.step()
            assert.near(4.5, x(), 1e-9)
            assert.same({'goal 1.5'}, t.prints())
        end)
        it('runs things at their time', function()
            local at
            t.at(0.5, function() at = t.time() t.signal('goal', 1.0) end)
            assert.near(0.55, t.run_until(function() return x() > 1 end), 1e-9)
            assert.near(0.5, at, 1e-9)
        end)
        it('sends messages', function() t.message({id = 'hello'}) t.step() assert.equal('hello', s:get('heard')) end)
        it('stubs and spies on functions of a script', function()
            local stubbed = s:stub('sim.getFloatSignal', 7.0)
            local seen = s:spy('sim.setObjectPosition')
            t.step(2)
            assert.spy(stubbed).was.called(2)
            assert.spy(seen).was.called(2)
            assert.near(14, x(), 1e-9)
            s:unwrap('sim.getFloatSignal')
            t.step()
            assert.near(0, x(), 1e-9)
        end)
        it('kills a script', function()
            t.signal('goal', 1.0) t.step() s:kill() t.signal('goal', 2.0) t.step(3)
            assert.near(2, x(), 1e-9)
        end)
        it('makes faults that the seed repeats', function()
            t.signal('goal', 1.0)
            t.faults.noise(s, 'sim.getFloatSignal', 0.1)
            t.step()
            local noisy = x()
            assert.is_true(noisy ~= 2 and math.abs(noisy - 2) < 2)
            t.step()
            assert.is_true(x() ~= noisy)
            print('noise', noisy)
        end)
        it('drops and delays', function()
            t.signal('goal', 1.0)
            t.faults.dropout(s, 'sim.getFloatSignal', 1, 5.0)
            t.faults.delay(s, 'sim.setObjectPosition', 0.2)
            t.step(3)
            assert.near(0, x(), 1e-9)
            t.step(2)
            assert.near(10, x(), 1e-9)
        end)",
    );
    let files = [("scenes/robot.lua", scene), ("robot_test.lua", &suite)];
    let (code, output) = run(&files, &["-v"]);
    assert_eq!(code, 0, "{output}");
    assert!(output.contains("7 passed"), "{output}");
}

#[test]
fn errors_of_scripts_fail_the_test_and_tell_where() {
    let suite = simulating(
        "local function broken()
            local s = sim.createScript(sim.scripttype_simulation, 'function sysCall_sensing() nothing.at = 1 end')
            sim.setObjectAlias(s, 'broken')
        end
        it('is told', function() broken() t.step(3) end)
        it('is allowed', function() broken() t.allow_script_errors() t.step(3) assert.equal(1, #t.logs('nothing')) end)",
    );
    let (code, output) = run(&[("a_test.lua", &suite)], &["-v"]);
    assert_eq!(code, 1, "{output}");
    assert!(
        has_line(&output, "ERROR a_test.lua::is told")
            && has_line(&output, "PASS a_test.lua::is allowed"),
        "{output}"
    );
    assert!(
        output.contains("script /broken raised an error")
            && output.contains("simulated time 0.050 s"),
        "{output}"
    );
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let code = format!(
        "{BOX} for i = 1, 6 do it('t' .. i, function() t.run_for(0.2) print(i, math.random(), t.gauss()) error('show') end) end"
    );
    let run = |jobs: &str| {
        let (_, output) = run(
            &[("a_test.lua", &simulating(&code))],
            &["-j", jobs, "--seed", "7"],
        );
        let mut lines: Vec<String> = output
            .lines()
            .filter(|line| line.starts_with("      0.2"))
            .map(str::to_owned)
            .collect();
        lines.sort();
        lines
    };
    assert_eq!(run("1"), run("4"));
    assert_eq!(run("1").len(), 6);
}

#[test]
fn the_first_test_that_init_writes_passes() {
    let dir = tempfile::tempdir().expect("a folder");
    assert_eq!(run_in(dir.path(), &[], &["--init"]).0, 0);
    assert!(
        dir.path()
            .join(".github/workflows/robot-tests.yml")
            .exists()
    );
    let (code, output) = run_in(dir.path(), &[], &[]);
    assert!(code == 0 && output.contains("3 passed"), "{output}");
    assert_eq!(
        run_in(dir.path(), &[], &["--init"]).0,
        4,
        "nothing is overwritten"
    );
}

/// Scripts of tests have the permissions of the command line; the scene's folder is that of the test's file.
#[test]
fn permissions_of_tests() {
    let code = simulating(
        "it('reads beside itself', function() assert.equal('beside', io.open(t.file('beside.txt')):read()) end)
        it('reads elsewhere', function() assert(io.open('elsewhere.txt')) end)
        it('writes', function() assert(io.open('written.txt', 'w')) end)
        it('runs', function() os.execute('exit 0') end)
        it('runs scenes', function() assert.equal(1, t.run('scene.lua', {loops = 1, start = false}).errors) end)",
    );
    let files = [
        ("tests/a_test.lua", code.as_str()),
        ("tests/beside.txt", "beside"),
        ("tests/scene.lua", "assert(io.open('elsewhere.txt'))"),
        ("elsewhere.txt", "elsewhere"),
    ];
    let (code, output) = run(&files, &["--no-unsafe"]);
    assert!(
        code == 1 && output.contains("2 passed, 2 failed, 1 error"),
        "{output}"
    );
    for option in ["--allow-read=", "--allow-write=", "--allow-run"] {
        assert!(
            output.contains(&format!("is not allowed: run with {option}")),
            "{option}: {output}"
        );
    }
    let (_, output) = run(
        &files,
        &[
            "--allow-write",
            "--allow-run",
            "--filter",
            "writes",
            "--filter",
            "runs",
        ],
    );
    assert!(output.contains("3 passed"), "{output}");
    let (_, output) = run(&files, &["--deny-all"]);
    assert!(output.contains("0 passed, 2 failed, 3 errors"), "{output}");
}
