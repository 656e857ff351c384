//! glTF files as others see them: Khronos' validator finds nothing wrong with what simGLTF and simAssimp write.
//!
//! Needs node and npm, and npm's registry once: the validator stays in `target/`.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use test_support::process::run_bounded;
use test_support::skipped_outside_of_ci;

use crate::server::folder;

const VALIDATOR: &str = "gltf-validator@2.0.0-dev.3.10";

#[test]
fn khronos_validator_finds_no_fault() {
    let Some(modules) = installed("gltf-validator", VALIDATOR) else {
        return skipped_outside_of_ci("there is no node with npm");
    };
    let files = tempfile::tempdir().expect("a temporary folder can be made");
    let mut scene = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    scene
        .args(["run", "--quiet"])
        .arg(folder().join("gltf_scene.lua"));
    scene
        .arg("-D")
        .arg(format!("folder={}", files.path().display()));
    assert_eq!(run_bounded(&mut scene).as_deref(), Ok(""));
    let mut node = Command::new("node");
    node.arg(folder().join("gltf_validate.js"))
        .arg(files.path())
        .env("NODE_PATH", modules);
    assert_eq!(run_bounded(&mut node).as_deref(), Ok("4 files\n"));
}

/// The folder of node's modules with a package, which is installed in a folder of that name; None where there is no node.
pub fn installed(name: &str, package: &str) -> Option<PathBuf> {
    let works = |program: &str| {
        let status = Command::new(program)
            .arg("--version")
            .stdout(Stdio::null())
            .status();
        status.is_ok_and(|status| status.success())
    };
    if !(works("node") && works("npm")) {
        return None;
    }
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let modules = dir.join("node_modules");
    let without_version = package.rsplit_once('@').map_or(package, |(name, _)| name);
    if !modules.join(without_version).join("package.json").exists() {
        let mut install = Command::new("npm");
        install
            .args([
                "install",
                "--no-audit",
                "--no-fund",
                "--silent",
                package,
                "--prefix",
            ])
            .arg(&dir);
        assert!(
            install.status().expect("npm starts").success(),
            "{install:?}"
        );
    }
    Some(modules)
}
