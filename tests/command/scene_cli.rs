//! The commands for scene files as their users meet them: exit codes, output, bad paths, and git.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;
use test_support::process::output_of;

fn swanilda(args: &[&Path]) -> Output {
    output_of(Command::new(env!("CARGO_BIN_EXE_swanilda")).args(args))
}

/// Runs a command of words and paths: `command("diff", &[a, b])`.
fn command(name: &str, paths: &[&Path]) -> Output {
    swanilda(&[&[Path::new(name)], paths].concat())
}

fn robot(extension: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(format!("robot.{extension}"))
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder can be made")
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The robot in a folder, its script changed.
fn unpacked(folder: &Path, change: impl Fn(&str) -> String) -> PathBuf {
    let scene = folder.join("robot");
    assert_eq!(
        command("unpack", &[&robot("ttt"), &scene]).status.code(),
        Some(0)
    );
    let script = script_of(&scene);
    let text = fs::read_to_string(&script).expect("a script");
    fs::write(script, change(&text)).expect("our own folder is writable");
    scene
}

fn script_of(scene: &Path) -> PathBuf {
    scene.join("scripts/robot/script.lua")
}

#[test]
fn inspect_tells_what_is_in_a_scene() {
    let output = command("inspect", &[&robot("ttt")]);
    let text = stdout(&output);
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert!(text.starts_with("scene of 4.10.0 (format 25): "), "{text}");
    assert!(
        text.contains("arm (Shape") && text.contains("script /robot/script (lua, "),
        "{text}"
    );
    let json = command("inspect", &[&robot("ttm"), Path::new("--json")]);
    let report: Value = serde_json::from_slice(&json.stdout).expect("JSON");
    assert_eq!(report["scripts"][0]["name"], "/robot/script");
    assert_eq!(report["needs"]["sim.setJointTargetPosition"], "works");
}

#[test]
fn inspect_tells_what_is_missing() {
    let folder = folder();
    let scene = unpacked(folder.path(), |text| {
        text.replace("sim.setJointTargetPosition", "sim.frobnicate")
    });
    let output = command("inspect", &[&scene]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stdout(&output).contains("missing      sim.frobnicate"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn an_unpacked_scene_packs_to_the_same() {
    let folder = folder();
    let scene = unpacked(folder.path(), str::to_owned);
    assert!(scene.join("scene.json").is_file() && scene.join("meshes/0.obj").is_file());
    let packed = folder.path().join("packed.ttt");
    assert_eq!(command("pack", &[&scene, &packed]).status.code(), Some(0));
    let same = command("diff", &[&robot("ttt"), &packed]);
    assert_eq!(
        (same.status.code(), stdout(&same)),
        (Some(0), String::new())
    );
    // The folder may be written again, but not what is none of ours.
    assert_eq!(command("unpack", &[&packed, &scene]).status.code(), Some(0));
    assert_eq!(
        command("unpack", &[&packed, folder.path()]).status.code(),
        Some(2)
    );
}

#[test]
fn edits_of_an_unpacked_scene_are_not_lost() {
    let folder = folder();
    let scene = unpacked(folder.path(), str::to_owned);
    let unpack = |args: &[&Path]| command("unpack", args).status.code();
    let text = scene.join("scene.json");
    let edited = fs::read_to_string(&text).expect("it was unpacked") + "\n";
    fs::write(&text, &edited).expect("our own folder is writable");
    let refused = command("unpack", &[&robot("ttt"), &scene]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("--force"), "{}", stderr(&refused));
    let kept = fs::read_to_string(&text).expect("it is still there");
    assert_eq!(kept, edited);
    // What is packed is not lost.
    let packed = folder.path().join("packed.ttt");
    assert_eq!(command("pack", &[&scene, &packed]).status.code(), Some(0));
    assert_eq!(unpack(&[&robot("ttt"), &scene]), Some(0));
    // A folder without a note, such as a fresh clone, may be written again where nothing changes.
    fs::remove_file(scene.join(".unpacked")).expect("it was noted");
    assert_eq!(unpack(&[&robot("ttt"), &scene]), Some(0));
    fs::write(&text, &edited).expect("our own folder is writable");
    fs::remove_file(scene.join(".unpacked")).expect("it was noted");
    assert_eq!(unpack(&[&robot("ttt"), &scene]), Some(2));
    let force = Path::new("--force");
    assert_eq!(unpack(&[&robot("ttt"), &scene, force]), Some(0));
    let replaced = fs::read_to_string(&text).expect("it was unpacked");
    assert_ne!(replaced, edited);
}

#[test]
fn diff_tells_what_changed() {
    let folder = folder();
    let scene = unpacked(folder.path(), |text| text.replace("math.sin", "math.cos"));
    let output = command("diff", &[&robot("ttt"), &scene]);
    assert_eq!(output.status.code(), Some(1));
    let text = stdout(&output);
    assert!(
        text.lines()
            .any(|line| line.starts_with('-') && line.contains("math.sin")),
        "{text}"
    );
    assert!(
        text.lines()
            .any(|line| line.starts_with('+') && line.contains("math.cos")),
        "{text}"
    );
}

#[test]
fn doctor_tells_what_works() {
    let works = command("doctor", &[&robot("ttt")]);
    assert_eq!(works.status.code(), Some(0), "{}", stdout(&works));
    let folder = folder();
    let file = folder.path().join("robot.lua");
    fs::write(
        &file,
        "sim = require 'sim'\nsim.getObject('/a')\nsim.frobnicate(1, 2, 0)\n",
    )
    .expect("writable");
    let output = command("doctor", &[folder.path()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stdout(&output).contains("sim.frobnicate: line 3"),
        "{}",
        stdout(&output)
    );
    let json = command("doctor", &[&file, Path::new("--json")]);
    let report: Value = serde_json::from_slice(&json.stdout).expect("JSON");
    assert_eq!(report["summary"]["missing"], 1);
    fs::write(folder.path().join("broken.ttt"), "VREP and no more").expect("writable");
    fs::write(
        folder.path().join("old.lua"),
        "simRMLPos() sim.getObjectName(1)",
    )
    .expect("writable");
    let output = command("doctor", &[folder.path(), Path::new("--deprecated")]);
    assert_eq!(output.status.code(), Some(2));
    let text = stdout(&output);
    assert!(
        text.contains("sim.frobnicate: line 3")
            && text.contains("deprecated   sim.getObjectName: line 1"),
        "{text}"
    );
}

#[test]
fn bad_paths_are_refused() {
    let folder = folder();
    let missing = folder.path().join("missing.ttt");
    let broken = folder.path().join("broken.ttt");
    let bytes = fs::read(robot("ttt")).expect("a scene");
    fs::write(&broken, &bytes[..bytes.len() / 2]).expect("our own folder is writable");
    let out = folder.path().join("nowhere/out.ttt");
    for paths in [
        ["inspect", "missing"],
        ["inspect", "broken"],
        ["doctor", "missing"],
    ] {
        let path = if paths[1] == "missing" {
            &missing
        } else {
            &broken
        };
        let output = command(paths[0], &[path]);
        assert_eq!(output.status.code(), Some(2), "{paths:?}");
        assert!(
            stderr(&output).contains(paths[1]),
            "{paths:?}: {}",
            stderr(&output)
        );
    }
    for (name, first, second) in [
        ("diff", robot("ttt"), missing.clone()),
        ("diff", broken.clone(), robot("ttt")),
        ("unpack", broken, folder.path().join("new")),
        ("unpack", missing.clone(), folder.path().join("new")),
        ("pack", missing, out.clone()),
        ("pack", unpacked(folder.path(), str::to_owned), out.clone()),
    ] {
        let output = command(name, &[&first, &second]);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{name} {} {}",
            first.display(),
            second.display()
        );
        assert!(
            !stderr(&output).is_empty() && stdout(&output).is_empty(),
            "{name}"
        );
    }
    assert!(!out.exists());
}

#[test]
fn an_unpacked_folder_runs_and_errors_name_its_files() {
    let folder = folder();
    let scene = unpacked(folder.path(), |text| {
        text.replace("    sim.setJointTargetPosition", "    error('boom')\n--")
    });
    let output = swanilda(&[
        Path::new("run"),
        &scene,
        Path::new("--steps"),
        Path::new("3"),
    ]);
    assert_eq!(output.status.code(), Some(1));
    let text = stderr(&output);
    // Long paths are cut at their front.
    assert!(text.contains("robot/script.lua:6: boom"), "{text}");
}

/// Git in a repository of its own; none where there is no git.
fn git(repository: &Path, args: &[&str]) -> Option<Output> {
    let mut command = Command::new("git");
    command
        .args(["-c", "user.name=test", "-c", "user.email=test@example.org"])
        .args(args)
        .current_dir(repository);
    command
        .env("GIT_CONFIG_GLOBAL", "/dev/null")
        .env("GIT_CONFIG_NOSYSTEM", "1")
        .env("GIT_PAGER", "cat");
    let output = command.output().ok()?;
    assert!(output.status.success(), "git {args:?}: {}", stderr(&output));
    Some(output)
}

#[test]
fn git_shows_differences_of_scenes() {
    let folder = folder();
    let repository = folder.path().join("repository");
    fs::create_dir(&repository).expect("our own folder is writable");
    if git(&repository, &["init", "-q"]).is_none() {
        return test_support::skipped_outside_of_ci("there is no git");
    }
    let run = |args: &[&str]| stdout(&git(&repository, args).expect("git is there"));
    let program = env!("CARGO_BIN_EXE_swanilda");
    run(&[
        "config",
        "diff.swanilda.textconv",
        &format!("'{program}' inspect --textconv"),
    ]);
    run(&[
        "config",
        "difftool.swanilda.cmd",
        &format!("'{program}' diff \"$LOCAL\" \"$REMOTE\""),
    ]);
    fs::write(repository.join(".gitattributes"), "*.ttt diff=swanilda\n").expect("writable");
    let file = repository.join("robot.ttt");
    fs::copy(robot("ttt"), &file).expect("writable");
    run(&["add", "-A"]);
    run(&["commit", "-q", "-m", "a robot"]);
    let changed = unpacked(folder.path(), |text| text.replace("math.sin", "math.cos"));
    assert_eq!(command("pack", &[&changed, &file]).status.code(), Some(0));
    for shown in [run(&["diff"]), run(&["difftool", "-y", "-t", "swanilda"])] {
        let has = |sign, word| {
            shown
                .lines()
                .any(|line| line.starts_with(sign) && line.contains(word))
        };
        assert!(has('-', "math.sin") && has('+', "math.cos"), "{shown}");
    }
}
