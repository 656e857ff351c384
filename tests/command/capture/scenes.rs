//! Every scene of the examples replays with equal hashes.

use std::path::{Path, PathBuf};
use std::process::Command;

use test_support::parallel::map;
use test_support::process::output_of;

use super::{outcome, replay, text};

/// Scenes that wait for others, which other tests bring along.
const WITH_OTHERS: &[&str] = &["fetch_url.lua", "plugin_hello.lua", "zmq_requester.lua"];

fn scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut scenes: Vec<_> = [folder.clone(), folder.join("messaging")]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).expect("there are scenes"))
        .map(|entry| entry.expect("it can be read").path())
        .filter(|path| path.is_file())
        .collect();
    scenes.sort();
    scenes.retain(|scene| {
        let name = scene.file_name().unwrap_or_default().to_string_lossy();
        let is_scene = [".lua", ".urdf", ".py"]
            .iter()
            .any(|ending| name.ends_with(ending));
        is_scene && !WITH_OTHERS.contains(&&*name)
    });
    scenes
}

#[test]
fn every_scene_replays() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let failures = map(&scenes(), |scene| {
        let capture = folder
            .path()
            .join(scene.file_name().expect("a scene has a name"));
        let mut command = Command::new(env!("CARGO_BIN_EXE_swanilda"));
        command
            .args(["run", "--time", "0.5", "--capture"])
            .arg(&capture)
            .arg(scene);
        let first = output_of(&mut command);
        let (word, step, said) = outcome(&capture);
        if word != "same" {
            return Some(format!(
                "{}: step {step}: {said}\n{}",
                scene.display(),
                text(&first.stderr)
            ));
        }
        let again = replay(&capture, &["--threads", "3"]);
        (text(&again.stdout) != text(&first.stdout))
            .then(|| format!("{} prints something else", scene.display()))
    });
    let failures: Vec<_> = failures.into_iter().flatten().collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
