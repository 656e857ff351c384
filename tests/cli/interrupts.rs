//! Interrupts from the keyboard.

use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use super::{Scene, stdout, swanilda};

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

/// Runs a scene, sends ctrl-c so many times once it has printed a line, and waits for the end.
fn interrupt(scene: &Scene, args: &[&str], times: u32) -> Output {
    let mut command = swanilda();
    command.arg("run").arg(scene.path()).args(args).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command starts");
    let mut out = BufReader::new(child.stdout.take().expect("piped"));
    let mut line = String::new();
    out.read_line(&mut line).expect("the scene prints");
    for _ in 0..times {
        let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        assert!(killed.expect("kill is there").success());
        std::thread::sleep(Duration::from_millis(100));
    }
    let mut rest = Vec::new();
    out.read_to_end(&mut rest).expect("the pipe is readable");
    let mut output = child.wait_with_output().expect("the child is ours");
    output.stdout = [line.into_bytes(), rest].concat();
    output
}
