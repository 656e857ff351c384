//! Round trips of scenes through XML.

use std::path::Path;

use test_support::random::Random;

use super::{Variant, read, write};
use crate::scene_file::tests::{assert_same, load, own_files, real_files};
use crate::scene_file::{Loaded, SceneFile, save};
use crate::ttt::{File, FileResult};
use permissions::Permissions;
use scene::Scene;
use scene::object::dummy::LinkType;

fn read_all(bytes: &[u8], folder: Option<&Path>) -> FileResult<File> {
    read(bytes, folder, &Permissions::all())
}

fn through(bytes: &[u8], variant: Variant, what: &str) -> (Scene, Scene) {
    let (first, loaded) = load(bytes);
    let text = write(&save::scene(&first, &loaded.scripts).unwrap(), variant);
    let file = read_all(text.as_bytes(), None).unwrap_or_else(|e| panic!("{what}: {e}"));
    assert_eq!(file.skipped, [], "{what}");
    let mut second = Scene::new();
    let again = SceneFile::new(file)
        .unwrap_or_else(|e| panic!("{what}: {e}"))
        .add_to(&mut second, true)
        .unwrap();
    let scripts = |loaded: &Loaded| {
        let mut all: Vec<_> = loaded
            .scripts
            .iter()
            .map(|s| (s.code.clone(), s.script_type as i64, s.disabled))
            .collect();
        all.sort();
        all
    };
    assert!(scripts(&loaded) == scripts(&again), "{what}: other scripts");
    (first, second)
}

#[test]
fn exhaustive_scenes_come_back_equal() {
    for path in own_files().into_iter().chain(real_files()) {
        let what = path.file_name().unwrap().to_string_lossy().into_owned();
        let (first, second) = through(&std::fs::read(&path).unwrap(), Variant::Exhaustive, &what);
        assert_same(&first, &second, &what);
    }
}

/// Attributes of objects that the simple variant stores: path, position and mass.
fn outline(scene: &Scene) -> Vec<String> {
    let line = |object: &scene::Object| {
        let pose = scene.world_pose(object.handle()).unwrap();
        let round = |v: f64| (v * 1e5).round() / 1e5 + 0.0;
        let place: [f64; 3] = pose.translation.vector.into();
        let mass = object.shape().map_or(0.0, |shape| round(shape.mass.mass));
        let parts = object.shape().map_or(0, |shape| shape.parts.len());
        format!("{} {:?} {mass} {parts}", object.alias(), place.map(round))
    };
    let mut lines: Vec<String> = scene.objects().map(line).collect();
    lines.sort();
    lines
}

#[test]
fn simple_scenes_keep_objects_places_and_masses() {
    for path in own_files().into_iter().chain(real_files()) {
        let what = path.file_name().unwrap().to_string_lossy().into_owned();
        let (first, second) = through(&std::fs::read(&path).unwrap(), Variant::Simple, &what);
        assert_eq!(outline(&first), outline(&second), "{what}");
    }
}

fn kinds() -> Vec<u8> {
    std::fs::read(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/data/kinds.simscene.xml"
    ))
    .unwrap()
}

#[test]
fn every_kind_of_the_simple_variant_is_understood() {
    let file = read_all(&kinds(), None).unwrap();
    let skipped: Vec<&str> = file
        .skipped
        .iter()
        .map(|skipped| skipped.path.as_str())
        .collect();
    assert_eq!(skipped, ["CoppeliaSim/mirror"]);
    let mut scene = Scene::new();
    let loaded = SceneFile::new(file)
        .unwrap()
        .add_to(&mut scene, true)
        .unwrap();
    let [script] = loaded.scripts.as_slice() else {
        panic!("{:?}", loaded.scripts)
    };
    assert!(
        String::from_utf8_lossy(&script.code).contains("a[b[c[1]]]>0)\nend"),
        "{script:?}"
    );
    let find = |alias: &str| {
        scene
            .objects()
            .find(|object| object.alias() == alias)
            .unwrap_or_else(|| panic!("{alias}"))
    };
    let base = find("base");
    assert!(base.is_model());
    assert_eq!(base.user_params, [("speed".to_owned(), "2.5".to_owned())]);
    let shape = base.shape().unwrap();
    assert!(
        (shape.mass.mass - 3.0).abs() < 1e-9 && (shape.mass.inertia[(0, 0)] - 0.1).abs() < 1e-9
    );
    assert!(!shape.dynamics.is_static && !shape.dynamics.kinematic && shape.dynamics.respondable);
    assert!((shape.dynamics.initial_velocity.angular[2] - std::f64::consts::PI).abs() < 1e-9);
    let colour = shape.parts[0].appearance.colour.ambient_diffuse;
    assert!((colour[1] - 128.0 / 255.0).abs() < 1e-6);
    let motor = find("motor").joint().unwrap();
    assert!(
        (motor.position - 45f64.to_radians()).abs() < 1e-12
            && (motor.target_force - 50.0).abs() < 1e-12
    );
    assert!((motor.target_velocity - 90f64.to_radians()).abs() < 1e-12);
    assert_eq!(find("arm").shape().unwrap().parts.len(), 2);
    assert_eq!(
        find("tip").dummy().unwrap().link,
        Some(find("target").handle())
    );
    let slave = find("slave").joint().unwrap();
    let law = slave.dependency.unwrap();
    assert_eq!(
        (law.master, law.coefficient, law.offset),
        (find("motor").handle(), 2.0, 0.5)
    );
    assert_eq!((slave.min, slave.range), (0.1, 2.0));
    let ground = find("ground").shape().unwrap();
    assert!(
        (ground.bounding_box.size[0] - 4.0).abs() < 1e-6 && ground.parts[0].primitive.is_some()
    );
    let vision = find("vision").vision_sensor().unwrap();
    assert_eq!(
        (vision.view.resolution, vision.entity),
        ([64, 32], base.handle().into())
    );
    let eye = find("eye").proximity_sensor().unwrap();
    assert!(
        scene
            .collections()
            .get(eye.entity.raw())
            .unwrap()
            .items
            .len()
            == 1
            && (eye.volume.angle - 60f64.to_radians()).abs() < 1e-9
    );
    assert_eq!(find("wrist").force_sensor().unwrap().force_threshold, 7.0);
    assert_eq!(find("path").path().unwrap().control_points().len(), 2);
    for alias in [
        "camera", "light", "graph", "octree", "points", "script", "mirror", "follower",
    ] {
        find(alias);
    }
    let settings = scene.settings();
    assert_eq!(
        (
            settings.time_step,
            settings.dynamics.engine.engine.number(),
            settings.dynamics.gravity[2]
        ),
        (0.02, 1, -3.7)
    );
}

/// Loads what can be loaded; what is wrong says so.
fn load_damaged(bytes: &[u8]) -> Result<(), String> {
    let file = read_all(bytes, None).map_err(|error| error.to_string())?;
    let file = SceneFile::new(file).map_err(|error| error.to_string())?;
    let mut scene = Scene::new();
    let loaded = file.add_to(&mut scene, true).unwrap();
    write(
        &save::scene(&scene, &loaded.scripts).unwrap(),
        Variant::Simple,
    );
    Ok(())
}

#[test]
fn every_shortened_file_is_an_error_with_its_place() {
    let bytes = kinds();
    let end = bytes.iter().rposition(|byte| *byte == b'>').unwrap();
    for end in 0..end {
        let error = load_damaged(&bytes[..end]).unwrap_err();
        assert!(error.starts_with("line "), "{end}: {error}");
    }
}

#[test]
fn changed_bytes_do_no_harm() {
    let bytes = kinds();
    let mut random = Random::new(7);
    for _ in 0..500 {
        let mut damaged = bytes.clone();
        for _ in 0..=random.below(4) {
            let at = random.below(damaged.len());
            damaged[at] = b"0123456789.-e<>&/ "[random.below(18)];
        }
        // Any result is right, as long as it ends.
        let _ = load_damaged(&damaged);
    }
}

#[track_caller]
#[test]
fn both_words_of_dynamic_links_are_understood() {
    for word in ["dynLoopClosure", "dynamics_loopClosure"] {
        let text = format!(
            "<CoppeliaSim><filetype>simpleScene</filetype><dummy><linkType>{word}</linkType></dummy></CoppeliaSim>"
        );
        let mut scene = Scene::new();
        SceneFile::new(read_all(text.as_bytes(), None).unwrap())
            .unwrap()
            .add_to(&mut scene, true)
            .unwrap();
        let dummy = scene.objects().find_map(|object| object.dummy().ok());
        assert_eq!(dummy.unwrap().link_type, LinkType::LoopClosure, "{word}");
    }
}

fn assert_wrong(inner: &str, expected: &str) {
    let text = format!("<CoppeliaSim>\n<filetype>simpleScene</filetype>\n{inner}\n</CoppeliaSim>");
    let error = load_damaged(text.as_bytes()).unwrap_err();
    assert!(error.contains(expected), "{error}");
}

#[test]
fn errors_name_the_place() {
    let joint = "<joint><position>1e</position></joint>";
    assert_wrong(
        joint,
        "line 3, column 8, in CoppeliaSim/joint/position: '1e' is no number.",
    );
    assert_wrong(
        "<joint><type>round</type></joint>",
        "CoppeliaSim/joint/type: 'round' is unknown here",
    );
    assert_wrong(
        "<dummy><common><layer>99999999999</layer></common></dummy>",
        "is no whole number",
    );
    assert_wrong(
        "<dummy><common><layer>70000</layer></common></dummy>",
        "out of range",
    );
    assert_wrong(
        "<shape/>",
        "a shape needs one primitive, heightfield, mesh or compound",
    );
    let mesh = |mesh: &str| format!("<shape><mesh>{mesh}</mesh></shape>");
    assert_wrong(
        &mesh("<vertices>0 0 0 1 0 0 0 1 0</vertices><indices>0 1 3</indices>"),
        "CoppeliaSim/shape/mesh",
    );
    assert_wrong(
        &mesh("<fileName>a.ply</fileName>"),
        "meshes in files ('a.ply') are not implemented in Swanilda",
    );
    let terrain = "<shape><heightfield><size>1e9 1e9</size><data>0</data><gridStep>1</gridStep></heightfield></shape>";
    assert_wrong(terrain, "a heightfield needs");
    let depth = 200;
    let compounds = ["<compound>".repeat(depth), "</compound>".repeat(depth)].concat();
    assert_wrong(&format!("<shape>{compounds}</shape>"), "nested too deeply");
    let error = read_all(
        b"<CoppeliaSim><filetype>exhaustiveScene</filetype></CoppeliaSim>",
        None,
    )
    .unwrap_err();
    assert!(error.to_string().contains("`prgVer` is missing"), "{error}");
    assert!(
        read_all(b"<html></html>", None)
            .unwrap_err()
            .to_string()
            .contains("no scene or model")
    );
}

#[test]
fn objects_may_be_nested_as_deep_as_elements() {
    let depth = 990;
    let text = ["<dummy>".repeat(depth), "</dummy>".repeat(depth)].concat();
    let text = format!("<CoppeliaSim><filetype>simpleScene</filetype>{text}</CoppeliaSim>");
    load_damaged(text.as_bytes()).unwrap();
}

#[test]
fn arrays_and_pictures_beside_the_scene_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let mut mesh: Vec<u8> = [0i32, 9].iter().flat_map(|n| n.to_le_bytes()).collect();
    mesh.extend(
        [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
            .iter()
            .flat_map(|n| n.to_le_bytes()),
    );
    mesh.extend([3i32, 0, 1, 2, 0, 0].iter().flat_map(|n| n.to_le_bytes()));
    std::fs::write(folder.path().join("s_mesh.bin"), &mesh).unwrap();
    let picture: Vec<u8> = [1i32, 1]
        .iter()
        .flat_map(|n| n.to_le_bytes())
        .chain([0, 7, 8, 9])
        .collect();
    std::fs::write(folder.path().join("s_texture.bin"), &picture).unwrap();
    let scene = |name: &str| {
        format!(
            "<CoppeliaSim><filetype>exhaustiveScene</filetype><prgVer>41000</prgVer><sceneObject><shape>\
             <common><alias>tile</alias><handle>0</handle></common><meshProxy><mesh><meshData><file name='{name}'/>\
             </meshData></mesh></meshProxy></shape></sceneObject><texture><id>2180009</id><size>1 1</size>\
             <data_base64Coded><file name='s_texture.bin'/></data_base64Coded></texture></CoppeliaSim>"
        )
    };
    let file = read_all(scene("s_mesh.bin").as_bytes(), Some(folder.path())).unwrap();
    assert_eq!(
        file.contents.textures[0].pixels.as_ref().unwrap().0,
        [7, 8, 9]
    );
    assert_eq!(file.skipped, []);
    assert!(SceneFile::new(file).is_ok());
    for (name, what) in [
        ("s_mesh.dae", "not"),
        ("../s_mesh.bin", "not in the folder"),
        ("s_texture.bin", "too short"),
    ] {
        let error = read_all(scene(name).as_bytes(), Some(folder.path()))
            .unwrap_err()
            .to_string();
        assert!(error.contains(what), "{error}");
    }
    assert!(read_all(scene("s_mesh.bin").as_bytes(), None).is_err());
}
