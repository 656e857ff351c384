//! Scenes and models: what is loaded agrees with an independent reader of the format, and a few steps of each run.
//!
//! Our own are in `tests/data`. The reader and the scenes of other people are in `../shared`, beside the repository; tests say when they are
//! missing.

use std::path::{Path, PathBuf};
use std::process::Command;

use swanilda::scene::{Kind, Object};
use swanilda::{Options, SceneFile, ScriptKind, Simulator};

/// Larger files take too long without optimisation, in Python and here.
const LARGEST: u64 = 300_000;

fn shared() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared")
}

fn files() -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(shared().join("scenes/files")) else {
        test_support::skipped("the scenes of other people: there is no ../shared");
        return own_files();
    };
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a readable folder").path())
        .collect();
    files.retain(|path| path.metadata().is_ok_and(|file| file.len() < LARGEST));
    files.extend(own_files());
    files.sort();
    files
}

fn own_files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    ["world.ttt", "robot.ttt", "part.ttm", "robot.ttm"]
        .map(|name| folder.join(name))
        .to_vec()
}

fn loaded(path: &Path) -> Simulator {
    let bytes = std::fs::read(path).expect("a readable file");
    let file =
        SceneFile::read(&bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut sim = Simulator::new(Options::default());
    sim.load(file).expect("there is room");
    sim
}

#[test]
fn scenes_agree_with_an_independent_reader() {
    if let Some(compared) = compare_files(&files()) {
        assert!(compared > 40, "the files hold objects");
    }
}

/// What our saver writes: groups in groups, voxels, points.
const OWN: &str = "
sim = require 'sim'
local function cube(x)
    local cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.3})
    sim.setObjectPosition(cube, {x, 0, 0})
    return cube
end
sim.groupShapes{sim.groupShapes{cube(0), cube(1)}, cube(2)}
local octree = sim.createOctree(0.05, 0, 1)
local points = {}
for i = 1, 300 do points[i] = math.sin(i * i) end
assert(sim.insertVoxelsIntoOctree(octree, 0, points, {255, 0, 0}, {7}) > 90)
local cloud = sim.createPointCloud(0.02, 5, 0, 4)
assert(sim.insertPointsIntoPointCloud(cloud, 0, points) == 100)
";

#[test]
fn the_independent_reader_reads_what_is_saved() {
    let mut sim = Simulator::new(Options::default());
    sim.add_script(ScriptKind::Customization, "own", OWN.as_bytes())
        .expect("the script runs");
    assert_eq!(sim.errors(), 0);
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let path = folder.path().join("own.ttt");
    std::fs::write(
        &path,
        SceneFile::bytes_of(&sim.scene(), &[]).expect("a sound tree"),
    )
    .expect("writable");
    compare_files(&[path]);
}

/// How many objects agreed; none where there is no reader.
fn compare_files(files: &[PathBuf]) -> Option<usize> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/independent.py");
    if !shared().join("tools/ttt").exists() {
        test_support::skipped("there is no reader of others: ../shared is missing");
        return None;
    }
    let reader = Command::new("python3")
        .arg(script)
        .arg(shared().join("tools/ttt"))
        .args(files)
        .output();
    let Ok(output) = reader else {
        test_support::skipped_outside_of_ci("there is no python3");
        return None;
    };
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let mut compared = 0;
    for part in text.split("file\t").skip(1) {
        let (path, lines) = part.split_once('\n').expect("a line");
        let sim = loaded(Path::new(path));
        let expected: Vec<&str> = lines
            .lines()
            .filter(|line| line.starts_with("object\t"))
            .collect();
        let scene = sim.scene();
        let objects: Vec<&Object> = scene.objects().collect();
        assert_eq!(objects.len(), expected.len(), "{path}");
        for (object, line) in objects.iter().zip(expected) {
            compare(object, &objects, line, path);
            compared += 1;
        }
        for line in lines
            .lines()
            .filter_map(|line| line.strip_prefix("cells\t"))
        {
            let (place, count) = line.split_once('\t').expect("a place and a count");
            let object = objects[place.parse::<usize>().expect("a place")];
            assert_eq!(
                cells(object),
                count.parse::<usize>().expect("a count"),
                "{path}: {}",
                object.alias()
            );
        }
    }
    Some(compared)
}

fn compare(object: &Object, all: &[&Object], line: &str, path: &str) {
    let fields: Vec<&str> = line.split('\t').collect();
    let [_, kind, alias, parent, pose @ .., mass] = &fields[..] else {
        panic!("{line}")
    };
    assert_eq!(object.alias(), *alias, "{path}");
    assert_eq!(word(&object.kind), *kind, "{path}: {alias}");
    let place = object
        .parent()
        .and_then(|parent| all.iter().position(|other| other.handle() == parent));
    assert_eq!(
        place.map_or(-1, |place| place as i64),
        parent.parse::<i64>().expect("a place"),
        "{path}: {alias}"
    );
    let pose: Vec<f64> = pose
        .iter()
        .map(|number| number.parse().expect("a number"))
        .collect();
    let (p, q) = (object.pose().translation, object.pose().rotation);
    let same = [p.x, p.y, p.z]
        .iter()
        .zip(&pose)
        .all(|(a, b)| (a - b).abs() < 1e-9);
    let overlap: f64 = [q.i, q.j, q.k, q.w]
        .iter()
        .zip(&pose[3..])
        .map(|(a, b)| a * b)
        .sum();
    assert!(
        same && (overlap.abs() - 1.0).abs() < 1e-6,
        "{path}: {alias} is at {:?}, not {pose:?}",
        object.pose()
    );
    if let Ok(shape) = object.shape() {
        let mass: f64 = mass.parse().expect("a mass");
        let mass = if mass == 0.0 { 0.001 } else { mass };
        assert!(
            (shape.mass.mass - mass).abs() <= 1e-6 * mass,
            "{path}: {alias} weighs {} kg",
            shape.mass.mass
        );
    }
}

/// Voxels, or points.
fn cells(object: &Object) -> usize {
    match &object.kind {
        Kind::OcTree(tree) => tree.len(),
        Kind::PointCloud(cloud) => cloud.points.len(),
        _ => panic!("{} has no cells", object.alias()),
    }
}

/// The type as the independent reader calls it; types that are gone are dummies here.
fn word(kind: &Kind) -> &'static str {
    match kind {
        Kind::Shape(_) => "shape",
        Kind::Joint(_) => "joint",
        Kind::Graph(_) => "graph",
        Kind::Camera(_) => "camera",
        Kind::Dummy(_) => "dummy",
        Kind::Path(_) => "path",
        Kind::ProximitySensor(_) => "proximitySensor",
        Kind::VisionSensor(_) => "visionSensor",
        Kind::ForceSensor(_) => "forceSensor",
        Kind::Light(_) => "light",
        Kind::OcTree(_) => "octree",
        Kind::PointCloud(_) => "pointCloud",
        Kind::Script(_) => "script",
    }
}

#[test]
fn scenes_run() {
    for path in files() {
        let mut sim = loaded(&path);
        sim.step(5);
        sim.stop();
        assert!(!sim.scene().is_empty(), "{}", path.display());
    }
}
