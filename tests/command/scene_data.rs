//! The scene files of `tests/data`: each form of a scene holds all that `world.lua` put in, as `check.lua` finds by the functions of scripts.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;
use test_support::process::output_of;

/// How many things `check.lua` looks at, so that it cannot pass by looking at nothing.
const CHECKS: (&str, &str) = ("87 checks\n", "31 checks\n");

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data")
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder can be made")
}

fn swanilda(args: &[&Path]) -> Output {
    output_of(Command::new(env!("CARGO_BIN_EXE_swanilda")).args(args))
}

/// Runs a command for scene files, which succeeds.
fn convert(command: &str, from: &Path, to: &Path) {
    let output = swanilda(&[Path::new(command), from, to]);
    assert!(
        output.status.success(),
        "{command}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// What `check.lua` says of a file.
fn checked(file: &Path, options: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command.arg("run").arg(data().join("check.lua"));
    command.args(["--as", "sandbox", "--empty", "--no-start", "--quiet", "-D"]);
    command
        .arg(format!("file={}", file.display()))
        .args(options);
    let output = output_of(&mut command);
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

#[test]
fn binary_scenes_are_read() {
    assert_eq!(checked(&data().join("world.ttt"), &[]), CHECKS.0);
}

#[test]
fn binary_models_are_read() {
    assert_eq!(
        checked(&data().join("part.ttm"), &["-D", "part=true"]),
        CHECKS.1
    );
}

#[test]
fn unpacked_folders_are_read_and_packed() {
    let folder = folder();
    let (world, again) = (folder.path().join("world"), folder.path().join("again.ttt"));
    convert("unpack", &data().join("world.ttt"), &world);
    assert_eq!(checked(&world, &[]), CHECKS.0);
    convert("pack", &world, &again);
    assert_eq!(checked(&again, &[]), CHECKS.0);
}

#[test]
fn xml_scenes_are_written_and_read() {
    let folder = folder();
    let world = folder.path().join("world.simscene.xml");
    convert("pack", &data().join("world.ttt"), &world);
    assert_eq!(checked(&world, &[]), CHECKS.0);
}

#[test]
#[cfg(unix)]
fn the_files_can_be_made_again() {
    let folder = folder();
    let mut make = Command::new(data().join("make.sh"));
    let output = output_of(make.arg(env!("CARGO_BIN_EXE_swanilda")).arg(folder.path()));
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    for name in ["world.ttt", "part.ttm", "robot.ttt", "robot.ttm"] {
        let (kept, made) = (data().join(name), folder.path().join(name));
        let difference = swanilda(&[Path::new("diff"), &kept, &made]);
        assert!(
            difference.status.success(),
            "{name}: {}",
            String::from_utf8_lossy(&difference.stdout)
        );
    }
}

#[test]
fn a_missing_property_is_found() {
    let folder = folder();
    let world = folder.path().join("world");
    convert("unpack", &data().join("world.ttt"), &world);
    let description = world.join("scene.json");
    let text = std::fs::read_to_string(&description).expect("a description");
    let changed = text.replace("\"elbow\"", "\"knee\"");
    assert_ne!(changed, text);
    std::fs::write(description, changed).expect("our own folder is writable");
    assert!(checked(&world, &[]).contains("error"));
}
