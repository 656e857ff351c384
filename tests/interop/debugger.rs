//! The debugger as others see it: the client with which Microsoft tests debug adapters; and the extension for Visual Studio Code is one.
//!
//! Needs node and npm, and npm's registry once: what is installed stays in `target/`.

use std::path::{Path, PathBuf};
use std::process::Command;

use test_support::process::run_bounded;
use test_support::skipped_outside_of_ci;

use crate::gltf::installed;
use crate::server::folder;

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
