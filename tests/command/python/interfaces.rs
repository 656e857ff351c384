//! Interfaces in QML whose process is no Python with PySide6, or fails. Those that run are tried with a browser (`tests/interop/view_qml.py`).

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use test_support::process::output_of;

const SCENE: &str = "simQML = require 'simQML'
function sysCall_init()
    local engine = simQML.createEngine()
    simQML.loadData(engine, 'import QtQuick')
    simQML.sendEvent(engine, 'a', {})
    print('goes on', table.unpack(simQML.qtVersion()))
end";

/// What a run of the scene says with that program in place of Python.
fn run(folder: &Path, program: &str) -> String {
    run_scene(folder, SCENE, program)
}

fn run_scene(folder: &Path, text: &str, program: &str) -> String {
    let (scene, python) = (folder.join("scene.lua"), folder.join("python"));
    fs::write(&scene, text).expect("it can be written");
    fs::write(&python, format!("#!/bin/sh\n{program}\n")).expect("it can be written");
    fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).expect("it is ours");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("run").arg(&scene).args(["--steps", "2"]);
    let output = output_of(
        command
            .arg("-D")
            .arg(format!("python={}", python.display())),
    );
    let (out, log) = (output.stdout, output.stderr);
    format!(
        "{}{}",
        String::from_utf8_lossy(&out),
        String::from_utf8_lossy(&log)
    )
}

#[test]
fn a_process_that_fails_leaves_the_source() {
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    // The messages of a program go where its input comes from.
    for (program, said) in [
        (
            "echo 'no luck' >&2; exit 3",
            "The process of the interface has ended (exit status: 3). no luck",
        ),
        (
            "printf '\\001\\000\\000\\000x' >&0; exec sleep 5",
            "The interface begins with what cannot be read.",
        ),
        (
            "printf '\\377\\377\\377\\377' >&0; exec sleep 5",
            "The interface has ended: a message is longer than 256 MiB.",
        ),
    ] {
        let output = run(folder.path(), program);
        assert!(output.contains(said), "{program}: {output}");
        assert!(output.contains("goes on, 0, 0, 0"), "{program}: {output}");
    }
}

/// As the process speaks: a tuple of a text and more, behind its length. The greeting, and that the interface is there.
const HELLO: &str = "\\043\\000\\000\\000(\\002\\000\\000\\000u\\005\\000\\000\\000hello[\\003\\000\\000\\000i\\006\\000\\000\\000i\\001\\000\\000\\000i\\002\\000\\000\\000";
const LOADED: &str = "\\020\\000\\000\\000(\\001\\000\\000\\000u\\006\\000\\000\\000loaded";

#[test]
fn a_process_that_says_something_else_ends() {
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    let program = format!("printf '{HELLO}' >&0; printf '\\001\\000\\000\\000x' >&0; exec sleep 5");
    let output = run(folder.path(), &program);
    let said = "The interface sent what cannot be read: values of type 0x78 are unknown.";
    assert!(output.contains(said), "{output}");
}

#[test]
fn a_process_that_reads_nothing_ends() {
    let folder = tempfile::tempdir().expect("there is a folder for temporary files");
    let program = format!("printf '{HELLO}{LOADED}' >&0; exec sleep 60");
    let scene = SCENE.replace(
        "'a', {}",
        "'a', ('x'):rep(1 << 20)) simQML.sendEvent(engine, 'b', {}",
    );
    let output = run_scene(folder.path(), &scene, &program);
    assert!(output.contains("goes on, 6, 1, 2"), "{output}");
    let said = "The interface reads nothing any more: it is ended.";
    assert!(output.contains(said), "{output}");
}
