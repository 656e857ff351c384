//! Standard output on a full disk: what could not be written is an error of every command.

use std::fs::File;
use std::process::{Command, Stdio};

use test_support::process::{LIMIT, wait_within};

use super::{Scene, swanilda};

/// The exit code of a command without room for its output, and whether it says so.
fn end_of(command: &mut Command) -> (Option<i32>, bool) {
    let full = File::options()
        .write(true)
        .open("/dev/full")
        .expect("it is there");
    let mut child = command
        .stdin(Stdio::null())
        .stdout(full)
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    assert!(
        wait_within(&mut child, LIMIT).is_some(),
        "{command:?} goes on"
    );
    let output = child.wait_with_output().expect("the child is ours");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    (
        output.status.code(),
        said.contains("cannot write to standard output"),
    )
}

#[test]
fn lost_output_is_an_error() {
    let scene = Scene::new("function sysCall_sensing() print('a line') end");
    let folder = scene.path().with_file_name("");
    std::fs::write(folder.join("some_test.lua"), "it('passes', function() end)")
        .expect("our own folder is writable");
    let saves = "sim = require 'sim' sim.createDummy(0.1) sim.saveScene('made.ttt') sim.createDummy(0.2) sim.saveScene('more.ttt')";
    std::fs::write(folder.join("saves.lua"), saves).expect("our own folder is writable");
    let made = swanilda()
        .current_dir(&folder)
        .args([
            "run",
            "saves.lua",
            "--time",
            "0",
            "--empty",
            "--quiet",
            "--data-dir",
            ".",
        ])
        .status();
    assert!(made.expect("the command starts").success());
    for args in [
        "run scene.lua --empty --quiet --time 1000000",
        "run scene.lua --empty --quiet --time 1000000 --json",
        "test",
        "test --tap",
        "test --json",
        "api sim.getObject",
        "api --help",
        "doctor scene.lua",
        "inspect made.ttt",
        "diff made.ttt more.ttt",
        "completions bash",
    ] {
        let mut command = swanilda();
        command.args(args.split(' ')).current_dir(&folder);
        assert_eq!(end_of(&mut command), (Some(2), true), "{args}");
    }
}
