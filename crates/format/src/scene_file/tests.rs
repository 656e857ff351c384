//! Real scenes and models, loaded, saved and loaded again, are the same.

mod everything;
mod models;
mod old_files;
mod on_disk;
mod other_programs;
mod recognised;
mod surfaces;
mod whole_scene;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;
use std::rc::Rc;

use geometry::PrimitiveKind;

use super::{Loaded, SceneFile, save};
use crate::ttt::File;
use scene::joint::{Joint, JointMode, JointType};
use scene::object::dummy::Dummy;
use scene::parameters::engine::Engine;
use scene::parameters::engine_blocks::EngineValues;
use scene::shape::Shape;
use scene::{DynamicsSettings, Handle, InertValues, Kind, Object, Pose, Scene, Settings};
use test_support::random::Random;

/// The smaller ones of other people's scenes and models, in a folder beside the repository. Without that folder the terminal shows that a
/// test has only our own files; the writer of standard error itself is used, since the output of tests that pass is hidden.
pub(crate) fn real_files() -> Vec<PathBuf> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/scenes/files");
    let Ok(entries) = std::fs::read_dir(folder) else {
        let thread = std::thread::current();
        let name = thread.name().unwrap_or("a test");
        let _ = writeln!(
            std::io::stderr(),
            "{name}: scenes of other people are skipped: there is no ../shared"
        );
        return Vec::new();
    };
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a readable folder").path())
        .collect();
    files.retain(|path| path.metadata().is_ok_and(|file| file.len() < 240_000));
    files.sort();
    files
}

/// Small files written by the saver; together they hold objects of every kind.
pub(crate) fn own_files() -> [PathBuf; 4] {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data");
    ["robot.ttt", "world.ttt", "robot.ttm", "part.ttm"].map(|name| folder.join(name))
}

pub(crate) fn load(bytes: &[u8]) -> (Scene, Loaded) {
    let mut scene = Scene::new();
    let loaded = SceneFile::read(bytes)
        .unwrap()
        .add_to(&mut scene, true)
        .unwrap();
    (scene, loaded)
}

fn saved(scene: &Scene, loaded: &Loaded) -> Vec<u8> {
    save::scene(scene, &loaded.scripts).unwrap().write()
}

/// Where an object is: the places among its siblings from the root down.
fn place(scene: &Scene, handle: Handle) -> String {
    let order = |h: Handle| {
        scene
            .siblings(h)
            .unwrap()
            .iter()
            .position(|s| *s == h)
            .unwrap()
    };
    let above: Vec<usize> = scene.ancestors(handle).map(order).collect();
    above
        .iter()
        .rev()
        .chain([&order(handle)])
        .map(|at| format!("/{at}"))
        .collect()
}

/// All that is known of an object, handles and identifiers of the session apart; meshes by their numbers and extents.
fn description(scene: &Scene, object: &Object) -> String {
    let mut slim = object.clone();
    let mut text = String::new();
    let engines =
        |values: &dyn Fn(Engine) -> (Vec<f64>, Vec<i32>)| format!("{:?}", Engine::ALL.map(values));
    match &mut slim.kind {
        Kind::Shape(shape) => {
            for part in &mut shape.parts {
                text += &format!(
                    "{} {} {:?} ",
                    part.mesh.vertices.len(),
                    part.mesh.triangles.len(),
                    part.mesh.aabb()
                );
                part.mesh = Rc::default();
            }
            text += &engines(&|engine| shape.material.engine_rows(engine));
            shape.material.engine_values = InertValues::default();
        }
        Kind::Joint(joint) => {
            text += &engines(&|engine| joint.engine_rows(engine));
            joint.engine_values = InertValues::default();
        }
        Kind::Dummy(dummy) => {
            text += &engines(&|engine| dummy.engine_rows(engine));
            dummy.engine_values = InertValues::default();
        }
        _ => {}
    }
    let all = format!("{slim:?}");
    let mut rest = all.as_str();
    while let Some((before, after)) = rest.split_once("Handle(") {
        let (number, after) = after.split_once(')').unwrap();
        text.push_str(before);
        text.push_str(&place(scene, Handle(number.parse().unwrap())));
        rest = after;
    }
    text + rest
}

/// Models are saved and loaded again; now and then the whole scene is replaced by what its file contains.
#[test]
fn cached_poses_are_right_after_loading() {
    let (mut scene, mut random, mut loads) = (Scene::new(), Random::new(1), 0);
    for turn in 0..4_000 {
        move_something(&mut scene, &mut random);
        if random.below(20) == 0 {
            scene = reloaded(scene, &mut random);
            loads += 1;
        }
        // Changes accumulate for the objects that are not read now.
        let all: Vec<Handle> = scene.objects().map(Object::handle).collect();
        let read = if turn % 50 == 0 {
            all
        } else {
            vec![all[random.below(all.len())]]
        };
        read.into_iter()
            .for_each(|handle| check_pose(&scene, handle));
    }
    assert!(loads > 100, "{loads}");
}

/// Adds, moves or scales an object, or hangs it elsewhere.
fn move_something(scene: &mut Scene, random: &mut Random) {
    let all: Vec<Handle> = scene.objects().map(Object::handle).collect();
    if all.is_empty() || all.len() < 40 && random.below(4) == 0 {
        let joint = Joint::new(JointType::Revolute, JointMode::Kinematic);
        let kind = if random.below(2) == 0 {
            Kind::Joint(Box::new(joint))
        } else {
            Kind::Dummy(Dummy::new(0.01))
        };
        scene.add("o", kind).unwrap();
        return;
    }
    let (handle, other) = (all[random.below(all.len())], all[random.below(all.len())]);
    let pose = Pose::new(random.vector().into(), random.vector().into());
    match random.below(5) {
        0 => drop(scene.set_parent(handle, Some(other), true)),
        1 => scene.set_local_pose(handle, pose).unwrap(),
        2 => scene.set_world_pose(handle, pose).unwrap(),
        3 => drop(scene.set_joint_position(handle, random.signed())),
        _ => scene.scale_objects(&[handle], 1.1, true).unwrap(),
    }
}

/// The scene as its file has it, or with one more copy of a model.
fn reloaded(mut scene: Scene, random: &mut Random) -> Scene {
    let all: Vec<Handle> = scene.objects().map(Object::handle).collect();
    let is_model = all.len() < 60 && random.below(2) == 0;
    let file = if is_model {
        save::model(&scene, all[random.below(all.len())], &[])
    } else {
        save::scene(&scene, &[])
    };
    let file = SceneFile::read(&file.unwrap().write()).unwrap();
    if !is_model {
        scene = Scene::new();
    }
    file.add_to(&mut scene, !is_model).unwrap();
    scene
}

#[track_caller]
fn check_pose(scene: &Scene, handle: Handle) {
    let composed = scene.composed_pose(scene.object(handle).unwrap()).unwrap();
    assert_eq!(scene.world_pose(handle).unwrap(), composed, "{handle:?}");
}

fn descriptions(scene: &Scene) -> BTreeMap<String, String> {
    scene
        .objects()
        .map(|object| (place(scene, object.handle()), description(scene, object)))
        .collect()
}

/// Words and numbers; what identifies an object in a session only is left out.
fn words(text: &str) -> Vec<&str> {
    let all = text
        .split(|c: char| !(c.is_alphanumeric() || matches!(c, '.' | '-' | '_' | '/')))
        .filter(|w| !w.is_empty());
    let mut words: Vec<&str> = Vec::new();
    for word in all {
        match words.last() {
            Some(&("uid" | "rank")) => drop(words.pop()),
            _ => words.push(word),
        }
    }
    words
}

fn same(a: &str, b: &str) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= 2e-6 * (1.0 + a.abs());
    a == b || a.parse().is_ok_and(|a| b.parse().is_ok_and(|b| near(a, b)))
}

#[track_caller]
pub(crate) fn assert_same(a: &Scene, b: &Scene, what: &str) {
    let (first, second) = (descriptions(a), descriptions(b));
    assert!(first.keys().eq(second.keys()), "{what}: other objects");
    for (place, text) in &first {
        let (x, y) = (words(text), words(&second[place]));
        let differ = x
            .iter()
            .zip(&y)
            .position(|(x, y)| !same(x, y))
            .or((x.len() != y.len()).then_some(x.len().min(y.len())));
        if let Some(at) = differ {
            let around = |w: &[&str]| w[at.saturating_sub(12)..(at + 6).min(w.len())].join(" ");
            panic!(
                "{what} {place}:\n{}\n{}\n{}",
                &text[..text.len().min(160)],
                around(&x),
                around(&y)
            );
        }
    }
    let rows =
        |scene: &Scene| Engine::ALL.map(|engine| scene.settings().dynamics.engine_rows(engine));
    assert_eq!(rows(a), rows(b), "{what}");
    let plain = |scene: &Scene| {
        let settings = scene.settings().clone();
        let dynamics = DynamicsSettings {
            engine_values: InertValues::default(),
            ..settings.dynamics
        };
        Settings {
            dynamics,
            ..settings
        }
    };
    assert_eq!(plain(a), plain(b), "{what}");
    assert_eq!(a.custom_data, b.custom_data, "{what}");
    assert_eq!(a.inert, b.inert, "{what}");
    assert!(a.textures() == b.textures(), "{what}: other textures");
}

#[test]
fn real_scenes_come_back_from_the_saver() {
    for path in own_files().into_iter().chain(real_files()) {
        let what = path.file_name().unwrap().to_string_lossy().into_owned();
        let (first, loaded) = load(&std::fs::read(&path).unwrap());
        let bytes = saved(&first, &loaded);
        let (second, again) = load(&bytes);
        assert_same(&first, &second, &what);
        let texts = |l: &Loaded| {
            l.scripts
                .iter()
                .map(|s| {
                    (
                        s.script_type,
                        s.code.clone(),
                        s.language.clone(),
                        s.disabled,
                        s.exec_order,
                    )
                })
                .collect::<Vec<_>>()
        };
        assert_eq!(texts(&loaded), texts(&again), "{what}");
        assert_eq!(File::read(&bytes).unwrap().skipped, [], "{what}");
    }
}

#[test]
fn a_model_comes_back_where_it_stood() {
    let is_model = |path: &PathBuf| path.extension().is_some_and(|e| e == "ttm");
    for path in own_files().into_iter().chain(real_files()).filter(is_model) {
        let (first, loaded) = load(&std::fs::read(&path).unwrap());
        let Some(base) = loaded.root else { continue };
        let bytes = save::model(&first, base, &loaded.scripts).unwrap().write();
        let file = SceneFile::read(&bytes).unwrap();
        assert!(file.is_model());
        let mut scene = Scene::new();
        let root = file.add_to(&mut scene, false).unwrap().root.unwrap();
        assert_eq!(scene.len(), first.subtree(base).len());
        let (there, here) = (
            first.world_pose(base).unwrap(),
            scene.world_pose(root).unwrap(),
        );
        assert!((there.translation.vector - here.translation.vector).norm() < 1e-12);
    }
}

#[test]
fn groups_in_groups_come_apart_level_by_level_after_loading() {
    let mut scene = Scene::new();
    let mut cube = |x: f64| {
        let shape =
            Shape::primitive(PrimitiveKind::Cuboid, [0.1, 0.2, 0.3], Default::default()).unwrap();
        let cube = scene.add("c", Kind::Shape(Box::new(shape))).unwrap();
        scene
            .set_world_pose(cube, Pose::translation(x, 2.0 * x, 0.0))
            .unwrap();
        cube.raw()
    };
    let cubes = [cube(0.0), cube(1.0), cube(2.0), cube(3.0)];
    let mut joined = |a: i64, b: i64| {
        let (group, members) = scene.group_shapes(&[a, b], false).unwrap();
        scene.remove(&members).unwrap();
        group.raw()
    };
    let pair = joined(cubes[0], cubes[1]);
    let three = joined(pair, cubes[2]);
    joined(three, cubes[3]);
    let (mut scene, loaded) = load(&saved(&scene, &Loaded::default()));
    let mut taken = |group| {
        let pieces = scene.ungroup_shape(group).unwrap().unwrap();
        let parts = pieces
            .iter()
            .map(|h| scene.object(*h).unwrap().shape().unwrap().parts.len())
            .collect::<Vec<_>>();
        let places = pieces
            .iter()
            .map(|h| scene.world_pose(*h).unwrap().translation.x.round());
        (pieces[0], parts, places.collect::<Vec<_>>())
    };
    let (three, parts, places) = taken(loaded.root.unwrap());
    assert_eq!((parts, places), (vec![3, 1], vec![2.0, 3.0]));
    let (pair, parts, places) = taken(three);
    assert_eq!((parts, places), (vec![2, 1], vec![1.0, 2.0]));
    let (_, parts, places) = taken(pair);
    assert_eq!((parts, places), (vec![1, 1], vec![0.0, 1.0]));
}

#[test]
#[expect(clippy::too_many_lines, reason = "one scene with everything")]
fn what_v_rep_had_is_kept() {
    use scene::object::dummy::Dummy;
    use scene::path_object::{
        ControlPoint, PathAttributes, PathFollowing, PathMeasures, PathObject, Shaping,
    };
    use scene::tree::ik_groups::{IkElement, IkGroup};

    let mut scene = Scene::new();
    let mut path = PathObject::new(PathAttributes::DEFAULT, PathMeasures::default());
    let at = |x: f64, y: f64| ControlPoint {
        pose: Pose::translation(x, y, 0.5),
        before: 0.3,
        after: 0.7,
        count: 9,
        velocity: 0.5,
        on_spot: 0.25,
        flags: 6,
        channels: [1.0, 2.0, 3.0, 4.0],
    };
    path.insert(0, vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)], true)
        .unwrap();
    path.set_motion(0.5, 0.02, 0.1, 0.2);
    path.explicit = true;
    path.shaping = Some(Shaping {
        flags: 1,
        scale: 2.0,
        element: (0.25, 3),
        section: vec![0.5, -0.5],
        colour: scene::appearance::colour::Colour::new([0.5, 0.25, 0.125]),
    });
    let path = scene.add("path", Kind::Path(Box::new(path))).unwrap();
    let following = PathFollowing {
        bits: 2,
        offsets: [0.25, 0.5],
    };
    let dummy = Dummy {
        path_following: following,
        ..Dummy::new(0.01)
    };
    let pad = scene.add("pad", Kind::Dummy(dummy)).unwrap();
    scene.set_parent(pad, Some(path), true).unwrap();
    scene.ik_groups_mut().add(IkGroup {
        name: "reach".into(),
        persistent_uid: "1".into(),
        explicit: true,
        method: 1,
        flags: 1,
        performed_after: -1,
        max_iterations: 5,
        damping: 0.25,
        elements: vec![IkElement {
            tip: pad,
            base: Some(path),
            constraint_base: None,
            precisions: [0.5, 0.25],
            weights: [1.0, 0.5],
            constraints: 7,
            flags: 1,
            enabled: true,
        }],
        ..IkGroup::new("")
    });
    let collection = scene.collections_mut().add(false, None);
    scene
        .collections_mut()
        .set_name(collection, "goods".into())
        .unwrap();

    let loaded = Loaded {
        objects: vec![path, pad],
        root: None,
        scripts: Vec::new(),
    };
    let (again, loaded) = load(&saved(&scene, &loaded));
    let [path_again, pad_again] = loaded.objects[..] else {
        panic!("there are two")
    };
    assert_eq!(
        again.object(path_again).unwrap().path(),
        scene.object(path).unwrap().path()
    );
    assert_eq!(
        again
            .object(pad_again)
            .unwrap()
            .dummy()
            .unwrap()
            .path_following,
        following
    );
    assert!(again.collections().named("goods").is_some());
    let group = again
        .ik_groups()
        .get(again.ik_groups().named("reach").unwrap())
        .unwrap();
    assert_eq!(
        (group.elements[0].tip, group.elements[0].base),
        (pad_again, Some(path_again))
    );
    assert!(group.explicit);
    assert_eq!(
        (
            group.damping,
            group.max_iterations,
            group.elements[0].constraints
        ),
        (0.25, 5, 7)
    );
}
