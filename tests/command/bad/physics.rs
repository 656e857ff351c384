//! The physics under what no scene should do to it: it goes on, and nothing scripts can read ceases to be a number.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use test_support::process::run_within;

/// Debug builds are slow where meshes are divided into convex pieces.
const LIMIT: Duration = Duration::from_secs(240);

/// What a script is told that removes the object it is attached to.
const SELF_REMOVAL: &str = "object removal can't be triggered from within the object itself";

/// Runs a scene of `tests/bad_physics`, which says itself whether all is well.
fn run(scene: &str, args: &[&str]) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_physics");
    let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
    command
        .current_dir(folder)
        .args([
            "run",
            scene,
            "--empty",
            "--data-dir",
            env!("CARGO_TARGET_TMPDIR"),
        ])
        .args(args);
    let output = run_within(&mut command, LIMIT).unwrap_or_else(|error| panic!("{scene}: {error}"));
    let complains = |line: &str| line.contains(":error]") && !line.contains(SELF_REMOVAL);
    assert!(
        !output.contains("panicked") && !output.lines().any(complains),
        "{scene}: {output}"
    );
    assert!(output.contains("all is well"), "{scene}: {output}");
    output
}

#[test]
fn masses_inertias_forces_and_speeds_nobody_has() {
    run("values.lua", &["--steps", "20"]);
}

#[test]
fn a_body_without_a_next_state_stops_and_is_reported() {
    let output = run("frozen.lua", &["--steps", "10"]);
    assert_eq!(
        output
            .matches("/victim: its motion has no finite values")
            .count(),
        1,
        "{output}"
    );
    assert!(output.contains("falls again, true, true"), "{output}");
}

#[test]
fn degenerate_meshes_and_coincident_frames() {
    run("geometry.lua", &["--steps", "5"]);
}

#[test]
fn callbacks_that_take_the_scene_apart() {
    let output = run("callbacks.lua", &["--no-start", "--loops", "5000"]);
    assert!(output.contains("115, of, 115, moments came"), "{output}");
}

#[test]
fn random_edits_of_a_running_scene() {
    run("random.lua", &["--steps", "300"]);
}
