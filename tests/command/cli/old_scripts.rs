//! What scripts in Lua 5.1 and of CoppeliaSim up to 4.1 counted on: `--compat`.

use super::{Scene, stderr, stdout};

const ARGS: [&str; 5] = ["--steps", "1", "--as", "simulation", "--empty"];

/// Output of a script with `--compat`, which must not fail.
#[track_caller]
fn old(text: &str) -> String {
    let output = Scene::new(text).run(&[&ARGS[..], &["--compat"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    stdout(&output)
}

#[test]
fn formatted_integers_are_truncated() {
    let text = "function sysCall_init()
        print(string.format('%d', 1.5), ('%5d|%-3i|%03d'):format(-1.5, '2.9', 7.99))
        print(string.format('%u %x %c%% %.1f %s', 3.7, 255.9, 65.2, 0.25, 'a%d'))
        local ok, text = pcall(function() local x = string.format('%d', {}) return x end)
        print(ok, text:match(':(%d+: .*)'))
        print(select('#', string.format('%d', 2)), string.format('%d', 2^53), #string.format('%q', 1))
    end";
    assert_eq!(
        old(text),
        "1,    -1|2  |007\n3 ff A% 0.2 a%d\nfalse, 4: bad argument #2 to 'format' (number expected, got table)\n1, 9007199254740992, 1\n"
    );
    let output = Scene::new("string.format('%d', 1.5)").run(&ARGS);
    assert!(
        stderr(&output).contains("number has no integer representation"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn planning_sets_itself_up() {
    let text = "function sysCall_init()
        local point = sim.createDummy(0.01)
        local task = simOMPL.createTask('task')
        local space = simOMPL.createStateSpace('plane', simOMPL.StateSpaceType.position2d, point, {-1, -1}, {1, 1}, 1)
        simOMPL.setStateSpace(task, {space})
        simOMPL.setStartState(task, {-0.5, 0})
        for i = 1, 2 do
            simOMPL.setGoalState(task, {0.5, 0.25 * i})
            local found, path = simOMPL.compute(task, 1)
            print(found, path[1], path[#path - 1], path[#path])
        end
        print((pcall(simOMPL.compute, task, 1)))
    end";
    assert_eq!(
        old(text),
        "true, -0.5, 0.5, 0.25\ntrue, -0.5, 0.5, 0.5\ntrue\n"
    );
    let output = Scene::new(text).run(&ARGS);
    assert!(
        stderr(&output).contains("simOMPL.setup(taskHandle) has not been called"),
        "{}",
        stderr(&output)
    );
}
