//! Scripts in Python: what those of `python/cases` print, and what becomes of their processes.

#![allow(clippy::disallowed_methods, reason = "tests look at the environment")]

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use test_support::process::{LIMIT, processes_with, run_bounded, wait_until, wait_within};

pub(super) fn has_python() -> bool {
    let found = Command::new("python3")
        .arg("--version")
        .output()
        .is_ok_and(|output| output.status.success());
    if !found {
        test_support::skipped_outside_of_ci("there is no python3");
    }
    found
}

fn swanilda(file: &Path, options: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("run").arg(file).arg("--quiet").args(options);
    command
}

/// What a Python script prints and logs.
fn output_of(text: &str, options: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    let file = folder.path().join("scene.py");
    fs::write(&file, text).expect("it can be written");
    let output = run_bounded(&mut swanilda(&file, options)).expect("it ends");
    output.replace(&*file.to_string_lossy(), "scene.py")
}

#[test]
fn cases_print_what_is_expected() {
    if !has_python() {
        return;
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/cases");
    let mut cases: Vec<PathBuf> = fs::read_dir(&folder)
        .expect("the folder is there")
        .flatten()
        .map(|entry| entry.path())
        .collect();
    cases.retain(|path| {
        path.extension()
            .is_some_and(|extension| extension == "py" || extension == "lua")
    });
    cases.sort();
    assert!(cases.len() >= 7);
    let wrong: Vec<String> = cases
        .iter()
        .filter_map(|case| difference(case, &folder))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What a case printed, if that is not what was expected. `UPDATE` writes new expectations.
fn difference(case: &Path, folder: &Path) -> Option<String> {
    let output =
        run_bounded(&mut swanilda(case, &["--steps", "12"])).unwrap_or_else(|reason| reason);
    let output = output.replace(&format!("{}/", folder.display()), "");
    let expected_file = case.with_extension("expected");
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&expected_file, &output).expect("it can be written");
    }
    let expected = fs::read_to_string(expected_file).unwrap_or_default();
    (output != expected).then(|| format!("{}:\n{output}\ninstead of\n{expected}", case.display()))
}

/// A script that fails as `body` says in its second step, beside one in Lua that counts steps.
fn failing(body: &str) -> String {
    format!(
        "LUA = '''
sim = require 'sim'
function sysCall_init() n = 0 end
function sysCall_sensing()
    n = n + 1
    if n == 5 then print('the simulation goes on') end
end
'''

def sysCall_init():
    global sim, steps
    sim = require('sim')
    steps = 0
    if sim.getSimulationState() == sim.simulation_stopped:
        sim.createScript(sim.scripttype_simulation, LUA, 0, 'lua')

def sysCall_sensing():
    global steps
    import os, signal, sys, time
    steps += 1
    if steps == 2:
        {body}
"
    )
}

#[test]
fn a_process_that_fails_is_an_error_of_its_script() {
    if !has_python() {
        return;
    }
    for (body, options, error) in [
        ("os._exit(3)", &[][..], "has ended: exit status 3."),
        (
            "os.kill(os.getpid(), signal.SIGKILL)",
            &[],
            "has ended: signal 9.",
        ),
        (
            "time.sleep(1000)",
            &["-D", "python.callTimeout=2"],
            "did nothing for 2 seconds",
        ),
        (
            "while True: pass",
            &["-D", "python.callTimeout=2"],
            "did nothing for 2 seconds",
        ),
        (
            "import swanilda_link; os.write(swanilda_link.fd, b'\\xff' * 100)",
            &[],
            "longer than 256 MiB",
        ),
        (
            "import swanilda_link; os.write(swanilda_link.fd, b'\\x01\\0\\0\\0?'); time.sleep(9)",
            &[],
            "cannot be read",
        ),
        (
            "os.close(__import__('swanilda_link').fd); time.sleep(9)",
            &[],
            "it closed its connection",
        ),
        ("os.write(2, b'from C\\n'); os._exit(1)", &[], "from C"),
        (
            "while True: print('x' * 10000000)",
            &["--verbosity", "errors"],
            "wrote more than 64 MiB in one call",
        ),
    ] {
        let output = output_of(&failing(body), &[&["--steps", "8"], options].concat());
        let output: String = output
            .lines()
            .filter(|line| line.len() < 1000)
            .collect::<Vec<_>>()
            .join("\n");
        let is_reported = output.contains(error) || options.contains(&"errors");
        assert!(
            is_reported && output.contains("the simulation goes on"),
            "{body}:\n{output}"
        );
    }
}

#[test]
fn a_forked_process_cannot_call() {
    if !has_python() {
        return;
    }
    let body = "
        if os.fork() == 0:
            try:
                sim.getSimulationTime()
            except RuntimeError as error:
                os.write(2, str(error).encode() + b'\\n')
            os._exit(0)
        os.wait()
        time.sleep(0.1)
        print('the script goes on', sim.getSimulationTime() > 0)";
    let output = output_of(&failing(body), &["--steps", "8"]);
    assert!(
        output.contains("a process that a script has forked cannot call the simulator"),
        "{output}"
    );
    assert!(output.contains("the script goes on, True"), "{output}");
}

#[test]
fn without_python_the_error_says_what_to_install() {
    let output = output_of(
        "def sysCall_init(): pass",
        &["-D", "python=/no/such/python", "--loops", "1", "--no-start"],
    );
    assert!(output.contains(
        "The Python interpreter could not be called. It is currently set as: '/no/such/python'"
    ));
    assert!(output.contains("Install Python 3.9 or newer"), "{output}");
}

#[test]
fn what_may_not_start_programs_may_not_run_python() {
    let output = output_of(
        "def sysCall_init(): print('ran')",
        &["--no-unsafe", "--loops", "1", "--no-start"],
    );
    assert!(
        output.contains("is not allowed: run with --allow-run") && !output.contains("ran\n"),
        "{output}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn nothing_outlives_the_simulator() {
    use std::os::unix::process::CommandExt;

    if !has_python() {
        return;
    }
    let word = format!("SWANILDA_ORPHANS={}", std::process::id());
    let text = "
def sysCall_init():
    import subprocess
    subprocess.Popen(['sleep', '1000'])
    print('ready')

def sysCall_nonSimulation():
    while True: pass
";
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    let file = folder.path().join("scene.py");
    fs::write(&file, text).expect("it can be written");
    for (signal, whom) in [("KILL", ""), ("TERM", ""), ("KILL", "-")] {
        let mut command = swanilda(&file, &["--no-start", "--loops", "1000000"]);
        let (name, value) = word.split_once('=').expect("it has a value");
        let mut child = command
            .env(name, value)
            .process_group(0)
            .stdout(Stdio::piped())
            .spawn()
            .expect("it starts");
        let mut lines = BufReader::new(child.stdout.take().expect("it is piped")).lines();
        while lines.next().expect("it says so").expect("it is text") != "ready" {}
        // Simulator, guardian, script, and what the script started; the last one may still be starting.
        wait_until("four processes", || processes_with(&word) >= 4);
        Command::new("kill")
            .args(["-s", signal, "--", &format!("{whom}{}", child.id())])
            .status()
            .expect("there is a kill");
        wait_within(&mut child, LIMIT).expect("it ends");
        wait_until(
            &format!("no process is left after SIG{signal} {whom}"),
            || processes_with(&word) == 0,
        );
    }
}

const ROBOT: &str = "#python
#luaExec lua_value = 1
import helper

def sysCall_init():
    global sim, speed
    sim = require('sim')
    speed = 1.5
    self.target = 0

def sysCall_actuation():
    helper.drive(read(), speed)

def read():
    return [1, 2, 3]

def never():
    x = 1
    return x
";

const HELPER: &str = "calls = []

def drive(values, speed):
    calls.append((sum(values), speed))

def unused():
    pass
";

const TESTS: &str = "local t = require 'swanilda.test'

describe('a robot in Python', function()
    local robot

    before_each(function()
        t.load('robot.py')
        robot = t.script('/Script')
    end)

    it('runs', function()
        t.step(3)
        assert.same({{6, 1.5}}, robot:get('helper.calls[-1:]'))
        assert.equal(1.5, robot:get('speed'))
        assert.same({1, 2, 3}, {robot:call('read')})
    end)

    it('has variables', function()
        robot:set('speed', 9)
        robot:set('self.target', {1, 2})
        assert.equal(9, robot:get('speed'))
        assert.same({1, 2}, robot:get('self.target'))
    end)

    it('has stubs and spies', function()
        local read = robot:stub('read', {7, 8})
        local drive = robot:spy('helper.drive')
        t.step(2)
        assert.stub(read).was.called()
        assert.spy(drive).was.called_with({7, 8}, 1.5)
        assert.same({15, 1.5}, robot:get('list(helper.calls[-1])'))
        robot:unwrap('read')
        assert.same({1, 2, 3}, {robot:call('read')})
    end)
end)
";

/// A folder with a robot in Python and its tests.
fn robot_folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    for (name, text) in [
        ("robot.py", ROBOT),
        ("helper.py", HELPER),
        ("robot_test.lua", TESTS),
    ] {
        fs::write(folder.path().join(name), text).expect("it can be written");
    }
    folder
}

#[test]
fn tests_call_replace_and_count_python() {
    if !has_python() {
        return;
    }
    let folder = robot_folder();
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .current_dir(folder.path())
        .args(["test", "--coverage=lcov.info", "robot_test.lua"]);
    let output = run_bounded(&mut command).expect("it ends");
    assert!(output.contains("3 passed"), "{output}");
    let lcov = fs::read_to_string(folder.path().join("lcov.info")).expect("there is a report");
    let record = |file: &str| {
        let at = lcov
            .find(&format!("SF:{file}"))
            .unwrap_or_else(|| panic!("{file} is not in {lcov}"));
        lcov[at..]
            .split("end_of_record")
            .next()
            .unwrap_or_default()
            .to_owned()
    };
    let robot = record("robot.py");
    let count = |record: &str, line: u32| {
        let prefix = format!("DA:{line},");
        let found = record
            .lines()
            .find_map(|row| row.strip_prefix(&prefix))
            .map(|count| count != "0");
        found.unwrap_or_else(|| panic!("line {line} does not run in {record}"))
    };
    assert!(
        count(&robot, 3) && count(&robot, 12) && count(&robot, 15),
        "{robot}"
    );
    assert!(!count(&robot, 18) && !count(&robot, 19), "{robot}");
    assert!(
        robot.contains("FN:17,never") && !robot.contains("\nDA:2,"),
        "{robot}"
    );
    let helper = record("helper.py");
    assert!(count(&helper, 4) && !count(&helper, 7), "{helper}");
}

#[test]
fn doctor_reads_python() {
    if !has_python() {
        return;
    }
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    let file = folder.path().join("a.py");
    let text = "#python\n#luaExec sim.frobnicate()\ns = require('sim')\ns.getObject('/a')\ns.handle_all\nsim.nothing()\nsim.mine = 1\nsim.mine()\n";
    fs::write(&file, text).expect("it can be written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    let output = run_bounded(command.arg("doctor").arg(&file)).expect("it ends");
    assert!(
        output.contains("missing      sim.frobnicate: line 1"),
        "{output}"
    );
    assert!(
        output.contains("missing      sim.nothing: line 6"),
        "{output}"
    );
    assert!(
        output.contains("call 3 functions: 1 work, 0 are approximated, 2 are missing"),
        "{output}"
    );
    fs::write(&file, "def f(:\n").expect("it can be written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    let output = run_bounded(command.arg("doctor").arg(&file)).expect("it ends");
    assert!(
        output.contains("a script that cannot be read (line 1: "),
        "{output}"
    );
}

#[test]
fn the_example_prints_the_same_in_every_run() {
    if !has_python() {
        return;
    }
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/python_robot.py");
    let run = || run_bounded(&mut swanilda(&scene, &["--time", "3"])).expect("it ends");
    let output = run();
    assert!(
        output.contains("  90 degrees: arm at 0.000, 0.200")
            && output.contains("between -45.0 and 90.0"),
        "{output}"
    );
    assert_eq!(output, run());
}
