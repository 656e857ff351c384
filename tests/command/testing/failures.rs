//! Tests that do not end, take too much or crash: each fails alone.

use super::{run, simulating};

/// Each of `tests`, name and code, is one error with its message, while a test beside them passes.
fn fail_alone(tests: &[(&str, &str, &str)], args: &[&str]) {
    let code: String = tests
        .iter()
        .map(|(name, code, _)| format!("it('{name}', function() {code} end)\n"))
        .collect();
    let suite = simulating(&(code + "it('goes on', function() t.step() end)"));
    let (code, output) = run(
        &[("bad_test.lua", &suite)],
        &[&["-v", "-j", "2"], args].concat(),
    );
    assert_eq!(code, 1, "{output}");
    for (name, _, message) in tests {
        let start = format!("ERROR bad_test.lua::{name}\n");
        let rest = output
            .split_once(&start)
            .unwrap_or_else(|| panic!("{name} is no error:\n{output}"))
            .1;
        let block: Vec<&str> = rest
            .lines()
            .take_while(|line| line.starts_with(' '))
            .collect();
        assert!(
            block.join("\n").contains(message),
            "{name}:\n{}",
            block.join("\n")
        );
    }
    let total = format!("1 passed, {} errors", tests.len());
    assert!(
        output.contains("PASS bad_test.lua::goes on") && output.contains(&total),
        "{output}"
    );
}

#[test]
fn tests_that_do_not_end_are_ended() {
    let late = "longer than 3 s";
    let tests = [
        ("loops", "while true do end", late),
        (
            "loops in a thread",
            "coroutine.wrap(function() while true do end end)()",
            late,
        ),
        (
            "catches all",
            "while true do pcall(function() while true do end end) end",
            late,
        ),
        (
            "wakes up",
            "local c = coroutine.wrap(function() while true do coroutine.yield() end end) while true do c() end",
            late,
        ),
        ("waits", "while sim.getSimulationTime() < 1 do end", late),
    ];
    fail_alone(&tests, &["--timeout", "3"]);
}

#[test]
fn tests_that_take_too_much_or_crash_fail_alone() {
    let tests = [
        (
            "simulates forever",
            "while true do t.step() end",
            "simulated for more than 20 s",
        ),
        (
            "eats memory",
            "local all = {} while true do all[#all + 1] = {} end",
            "not enough memory",
        ),
        (
            "eats it at once",
            "local s = 'x' while true do s = s .. s end",
            "not enough memory",
        ),
        ("exits", "os.exit(0)", "os.exit"),
        (
            "recurses",
            "local function f() return f() + 1 end f()",
            "stack overflow",
        ),
        (
            "crashes",
            "local nothing nothing.x = 1",
            "attempt to index a nil value",
        ),
        ("raises a table", "error({})", "table"),
        ("raises nothing", "error()", "nil"),
        (
            "prints a lot",
            "for i = 1, 100000 do print('again and again and again') end error('enough')",
            "more lines: a test may write",
        ),
        (
            "steps in a step",
            STEP_IN_STEP,
            "a step cannot be made from within a step",
        ),
    ];
    fail_alone(&tests, &["--sim-timeout", "20", "--memory", "256"]);
}

const STEP_IN_STEP: &str = "
    local code = 'sim = require \"sim\" function sysCall_sensing() sim.getSimulationTime() end'
    local s = t.script(sim.createScript(sim.scripttype_simulation, code))
    t.step()
    s:wrap('sim.getSimulationTime', function() t.step() end)
    t.step()";

#[test]
fn a_test_that_hangs_outside_of_lua_is_given_up() {
    let suite = simulating(
        "it('sleeps', function() os.execute('sleep 20') end) it('goes on', function() t.step() end)",
    );
    let (code, output) = run(
        &[("a_test.lua", &suite)],
        &["--timeout", "5", "-j", "1", "-v"],
    );
    assert!(
        code == 1
            && output.contains("It could not be ended")
            && output.contains("1 passed, 1 error "),
        "{output}"
    );
}
