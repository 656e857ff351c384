//! The debugger as others see it: the client with which Microsoft tests debug adapters; and the extension for Visual Studio Code is one.
//!
//! Needs node and npm, and npm's registry once: what is installed stays in `target/`.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::json;
use test_support::debug_client::Client;
use test_support::process::run_bounded;
use test_support::skipped_outside_of_ci;

use crate::gltf::installed;
use crate::server::{folder, python};

const SWANILDA: &str = env!("CARGO_BIN_EXE_swanilda");
const CLIENT: &str = "@vscode/debugadapter-testsupport@1.68.0";
const PACKER: &str = "@vscode/vsce@3.9.0";

/// The script of `tests/command/debugger`.
const SCRIPT: &str = include_str!("../command/debugger/script.lua");

#[test]
fn microsofts_client_stops_steps_and_looks() {
    let Some(modules) = installed("debugger-client", CLIENT) else {
        return skipped_outside_of_ci("there is no node with npm");
    };
    let files = tempfile::tempdir().expect("a temporary folder can be made");
    let script = files.path().join("script.lua");
    std::fs::write(&script, SCRIPT).expect("the script is written");
    let mut node = Command::new("node");
    node.arg(folder().join("debugger.js"))
        .arg(env!("CARGO_BIN_EXE_swanilda"))
        .arg(&script)
        .env("NODE_PATH", modules);
    assert_eq!(run_bounded(&mut node).as_deref(), Ok("done\n"));
}

#[test]
fn the_extension_can_be_packed() {
    let Some(modules) = installed("vsce", PACKER) else {
        return skipped_outside_of_ci("there is no node with npm");
    };
    let files = tempfile::tempdir().expect("a temporary folder can be made");
    let packed = files.path().join("swanilda.vsix");
    let extension: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("editors/vscode");
    let mut pack = Command::new(modules.join(".bin/vsce"));
    pack.current_dir(extension)
        .args([
            "package",
            "--no-dependencies",
            "--allow-missing-repository",
            "--skip-license",
            "--out",
        ])
        .arg(&packed);
    let said = run_bounded(&mut pack);
    assert!(packed.is_file(), "{said:?}");
    let mut check = Command::new("node");
    check
        .arg("--check")
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("editors/vscode/extension.js"));
    assert_eq!(run_bounded(&mut check).as_deref(), Ok(""));
}

/// A script in Python that counts its steps.
const PYTHON_SCRIPT: &str = "\
#python
def sysCall_init():
    global steps
    steps = 0

def sysCall_actuation():
    global steps
    steps = steps + 1
";

#[test]
#[cfg(unix)]
fn scripts_in_python_have_pythons_debugger() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder
        .path()
        .canonicalize()
        .expect("it is there")
        .join("scene.py");
    std::fs::write(&scene, PYTHON_SCRIPT).expect("our own folder is writable");
    let option = format!("python={}", python.display());
    let args = [
        &*scene.to_string_lossy(),
        "--debug-python",
        "--",
        "--realtime",
        "--time",
        "60",
        "-D",
        &option,
    ];
    let mut simulation = Client::start(SWANILDA, &args);
    simulation.launch(json!({}));
    simulation.run();
    let line = simulation.output("debugpy listens at ");
    let address = line.trim().rsplit(' ').next().expect("an address");
    let mut debugger = Client::connected_to(address);
    debugger.request("initialize", json!({"adapterID": "debugpy"}));
    let attach = debugger.send("attach", json!({"justMyCode": false}));
    debugger.event("initialized");
    debugger.set_breakpoints(&scene, json!([{"line": 8}]));
    debugger.run();
    assert_eq!(debugger.answer_to(attach)["success"], true);
    let stopped = debugger.stopped("breakpoint");
    assert_eq!(stopped.calls()[0], "sysCall_actuation:8");
    let steps = debugger.evaluate(&stopped, "steps");
    debugger.go("continue", &stopped);
    let later = debugger.stopped("breakpoint");
    let [before, after] =
        [steps, debugger.evaluate(&later, "steps")].map(|steps| steps.parse::<u32>());
    assert_eq!(before.map(|steps| steps + 1), after);
    debugger.request("disconnect", json!({}));
    simulation.request("disconnect", json!({}));
}
