//! Requests to end: from the keyboard, by signals, and by a reader of the output that is gone.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStdout, Command, Output, Stdio};
use std::time::Duration;

use test_support::process::{LIMIT, wait_until, wait_within};

use super::{Scene, stderr, stdout, swanilda};

#[test]
fn interrupted_runs_clean_up() {
    let scene = Scene::new(
        "sim = require 'sim' print('ready') function sysCall_cleanup() print('cleanup') end
        function sysCall_afterSimulation() print('stopped') end",
    );
    let output = interrupt(&scene, &["--empty", "--quiet"], 1);
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(stdout(&output), "ready\nstopped\ncleanup\n");
}

#[test]
fn a_second_interrupt_ends_a_hanging_script() {
    let scene = Scene::new("print('ready') while true do end");
    assert_eq!(interrupt(&scene, &["--empty"], 2).status.code(), Some(130));
}

/// Scripts that do not end by themselves, in line 2, or 3 where they have two.
const ENDLESS: [&str; 7] = [
    "while true do end",
    "while true do pcall(function() while true do end end) end",
    "coroutine.wrap(function() sim.setThreadAutomaticSwitch(false) while true do end end)()",
    "while true do sim.moveToObject(a, b, 3, 0, 1e-9) end",
    "load('while true do end')()",
    "local x = 0\nwhile true do x = x + 1 end",
    "while true do xpcall(error, function() while true do end end) end",
];

#[test]
fn one_interrupt_ends_lua_code_wherever_it_is() {
    for code in ENDLESS {
        let scene = Scene::new(&format!(
            "sim = require 'sim' a, b = sim.createDummy(0.1), sim.createDummy(0.1) print('ready')\n{code}"
        ));
        let output = interrupt(&scene, &[], 1);
        assert_eq!(
            output.status.code(),
            Some(130),
            "{code}: {}",
            stderr(&output)
        );
        let line = if code.contains('\n') { 3 } else { 2 };
        // A process that had to end itself shows what Lua calls the text.
        let is_said = [".lua", "/Script\"]"]
            .iter()
            .any(|name| stderr(&output).contains(&format!("{name}:{line}")));
        assert!(is_said, "{code}: {}", stderr(&output));
    }
}

#[test]
fn a_script_that_was_interrupted_cleans_up() {
    let scene = Scene::new(
        "sim = require 'sim'
        function sysCall_actuation() print('ready') while true do pcall(string.rep, 'x', 10) end end
        function sysCall_cleanup() print('cleanup') end",
    );
    let output = interrupt(&scene, &["--as", "simulation", "--quiet"], 1);
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(stdout(&output), "ready\ncleanup\n", "{}", stderr(&output));
    assert!(
        stderr(&output).contains("interrupted at ") && stderr(&output).contains(".lua:2"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn functions_that_cannot_be_interrupted_end_with_the_process() {
    let pattern = "(('a'):rep(40)):find(('a?'):rep(40) .. ('a'):rep(40))";
    let output = interrupt(
        &Scene::new(&format!("print('ready')\nlocal x = 1\n{pattern}")),
        &["--empty"],
        1,
    );
    assert_eq!(output.status.code(), Some(130));
    let log = stderr(&output);
    assert!(
        log.contains("ended in the middle of a script, at ") && log.contains("/Script\"]:3"),
        "{log}"
    );
}

#[test]
fn a_long_call_is_reported_and_goes_on() {
    let scene = Scene::new(
        "sim = require 'sim'
        local function busy() local begun = os.clock() while os.clock() - begun < 4.5 do end end
        function sysCall_actuation() busy() coroutine.wrap(print)('came back') end",
    );
    let output = scene.run(&["--steps", "1", "--as", "simulation"]);
    let log = stderr(&output);
    assert!(
        log.contains("sysCall_actuation has been running for 3 s, at /Script:2, called from /Script:3; ctrl-c ends it"),
        "{log}"
    );
    assert_eq!(output.status.code(), Some(0), "{log}");
    assert!(stdout(&output).contains("came back"));
}

#[test]
fn a_blocked_open_is_interrupted() {
    let scene = Scene::new("");
    let made = Command::new("mkfifo")
        .arg(scene.path().with_file_name("fifo"))
        .status();
    assert!(made.expect("mkfifo is there").success());
    let code = format!(
        "print('ready')\nio.open('{}')",
        scene.path().with_file_name("fifo").display()
    );
    std::fs::write(scene.path(), code).expect("our own folder is writable");
    let output = interrupt(&scene, &["--empty"], 1);
    assert_eq!(output.status.code(), Some(130));
    assert!(stderr(&output).contains(".lua:2"), "{}", stderr(&output));
}

#[test]
fn a_termination_has_its_own_exit_code() {
    let endless = Scene::new("print('ready') while true do end");
    assert_eq!(
        signal(&endless, &["--empty"], "-TERM", 1).status.code(),
        Some(143)
    );
    let simulating = Scene::new("print('ready')");
    assert_eq!(
        signal(&simulating, &["--empty"], "-TERM", 1).status.code(),
        Some(143)
    );
}

#[test]
fn a_run_ends_quietly_when_nobody_reads_its_output() {
    let scripts = [
        "sim = require 'sim' print('ready') function sysCall_actuation() print('more') end",
        "print('ready') while true do print('more') end",
        "print('ready') io.stdout:setvbuf('no') while true do io.write('more\\n') end",
        "print('ready') while true do io.stdout:write('more\\n') end",
    ];
    for code in scripts {
        let scene = Scene::new(code);
        let (child, out) = start(&scene, &["--empty"]);
        drop(out);
        let output = end_of(child);
        assert_eq!(
            output.status.code(),
            Some(141),
            "{code}: {}",
            stderr(&output)
        );
        let log = stderr(&output);
        assert!(
            !log.contains("interrupted") && !log.contains("traceback") && !log.contains("panic"),
            "{code}: {log}"
        );
    }
}

#[test]
fn tests_that_cannot_be_interrupted_do_not_hold_up_the_end() {
    let scene = Scene::new("");
    let code = "it('hangs', function() os.remove('begun'); (('a'):rep(40)):find(('a?'):rep(40) .. ('a'):rep(40)) end)";
    let begun = scene.path().with_file_name("begun");
    std::fs::write(&begun, "").expect("our own folder is writable");
    std::fs::write(scene.path().with_file_name("hang_test.lua"), code)
        .expect("our own folder is writable");
    let mut command = swanilda();
    command
        .arg("test")
        .current_dir(begun.parent().expect("the folder"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let child = command.spawn().expect("the command starts");
    wait_until("the test has begun", || !begun.exists());
    send(&child, "-INT");
    let output = end_of(child);
    assert_eq!(output.status.code(), Some(2), "{}", stdout(&output));
    assert!(
        stdout(&output).contains("interrupted"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn a_server_says_how_it_was_ended() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let mut command = swanilda();
        command
            .args(["serve", "--remote-api=0"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null());
        let mut child = command.spawn().expect("the command starts");
        let mut out = BufReader::new(child.stdout.take().expect("piped"));
        out.read_line(&mut String::new())
            .expect("it says where it listens");
        send(&child, signal);
        assert_eq!(end_of(child).status.code(), Some(code), "{signal}");
    }
}

/// Starts a scene and waits until it has printed its first line.
fn start(scene: &Scene, args: &[&str]) -> (Child, BufReader<ChildStdout>) {
    let mut command = swanilda();
    command
        .arg("run")
        .arg(scene.path())
        .args(args)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command starts");
    let mut out = BufReader::new(child.stdout.take().expect("piped"));
    let mut line = String::new();
    out.read_line(&mut line).expect("the scene prints");
    assert_eq!(line, "ready\n");
    (child, out)
}

/// Runs a scene, sends ctrl-c so many times once it has printed a line, and waits for the end.
fn interrupt(scene: &Scene, args: &[&str], times: u32) -> Output {
    signal(scene, args, "-INT", times)
}

/// The same with a signal.
fn signal(scene: &Scene, args: &[&str], signal: &str, times: u32) -> Output {
    let (child, mut out) = start(scene, args);
    for repetition in 0..times {
        // One that comes while another is pending counts for nothing.
        std::thread::sleep(Duration::from_millis(100) * repetition);
        send(&child, signal);
    }
    let mut output = end_of(child);
    let mut rest = Vec::new();
    out.read_to_end(&mut rest).expect("the pipe is readable");
    output.stdout = [b"ready\n".to_vec(), rest].concat();
    output
}

/// Waits for the end, which must come; what is piped has room for what is said until then.
fn end_of(mut child: Child) -> Output {
    assert!(
        wait_within(&mut child, LIMIT).is_some(),
        "the process goes on"
    );
    child.wait_with_output().expect("the child is ours")
}

fn send(child: &Child, signal: &str) {
    let killed = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(killed.expect("kill is there").success());
}
