//! The folder with what takes long to compute: it makes starts shorter, and shows in nothing else.

use std::fs;
use std::path::{Path, PathBuf};

use super::{Scene, stderr, stdout};

/// Two boxes as one mesh that is not convex, and falls on the floor.
const FALLS: &str = "sim = require 'sim'
function sysCall_init()
    local boxes = {}
    for i, at in ipairs{{0, 0, 0.5}, {0.2, 0, 0.7}} do
        boxes[i] = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.5, 0.1, 0.1})
        sim.setObjectPosition(boxes[i], at)
        sim.setObjectOrientation(boxes[i], {0, i * math.pi / 2, 0.1})
    end
    shape = sim.groupShapes(boxes, true)
    sim.setBoolProperty(shape, 'dynamic', true)
    sim.setBoolProperty(shape, 'respondable', true)
end
function sysCall_sensing() print(string.format(('%.17g '):rep(7), table.unpack(sim.getObjectPose(shape)))) end";

/// What the scene prints.
fn run(scene: &Scene, args: &[&str]) -> String {
    let output = scene.run(&[args, &["--steps", "20", "--quiet"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stderr(&output), "");
    stdout(&output)
}

/// The files in a folder and below.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .flat_map(|entry| match entry.file_type() {
            Ok(kind) if kind.is_dir() => files(&entry.path()),
            _ => vec![entry.path()],
        })
        .collect()
}

#[test]
fn pieces_of_meshes_are_kept_and_show_in_nothing() {
    let scene = Scene::new(FALLS);
    let folder = scene.path().with_file_name("cache");
    let cache = format!("--cache-dir={}", folder.display());
    let expected = run(&scene, &["--no-cache"]);
    assert_ne!(expected, "");
    assert_eq!(run(&scene, &[&cache, "--no-unsafe"]), expected);
    assert!(
        !folder.exists(),
        "a scene that is not trusted leaves nothing"
    );
    assert_eq!(run(&scene, &[&cache]), expected);
    let kept = files(&folder);
    assert_eq!(kept.len(), 1);
    let bytes = fs::read(&kept[0]).expect("it was written");
    assert_eq!(run(&scene, &[&cache, "--no-unsafe"]), expected);
    for damaged in [&bytes[..bytes.len() / 2], &[], &[0xff; 1000]] {
        fs::write(&kept[0], damaged).expect("our own file is writable");
        assert_eq!(run(&scene, &[&cache]), expected);
        assert_eq!(fs::read(&kept[0]).expect("it is there"), bytes);
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_no_error() {
    let scene = Scene::new(FALLS);
    let file = scene.path();
    let cache = format!("--cache-dir={}", file.display());
    assert_eq!(run(&scene, &[&cache]), run(&scene, &["--no-cache"]));
}
