//! Models take along what belongs to their objects: scripts, user interfaces, images.

use super::super::{Loaded, LoadedScript, SceneFile, save};
use super::everything::{add, dummy, returned};
use super::{load, saved};
use crate::ttt::FileKind;
use geometry::PrimitiveKind;
use scene::appearance::texture::Texture;
use scene::appearance::texture_mapping::{TextureMapping, TextureSource};
use scene::object::script_object::ScriptType;
use scene::shape::Shape;
use scene::tree::button_interfaces::{Button, ButtonInterface};
use scene::{Handle, Kind, Pose, Scene};

fn interface(name: &str, object: Option<Handle>) -> ButtonInterface {
    let slider = Button {
        number: 4,
        attributes: 0x12,
        cell: [1, 2],
        span: [3, 1],
        label: "up".into(),
        down_label: "down".into(),
        slider: -0.5,
        colours: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9],
    };
    ButtonInterface {
        name: name.into(),
        attributes: 5,
        cells: [4, 6],
        position: [10, 20],
        cell_size: [12, 13],
        view: 2,
        object,
        rollup: [1, 2, 3, 4],
        buttons: vec![slider],
    }
}

#[test]
fn user_interfaces_and_models_have_those_of_their_objects() {
    let mut scene = Scene::new();
    let [own, other] = [dummy(&mut scene), dummy(&mut scene)];
    for (name, object) in [("mine", Some(own)), ("theirs", Some(other)), ("free", None)] {
        scene.button_interfaces_mut().add(interface(name, object));
    }
    let again = returned(&scene);
    assert!(
        again
            .button_interfaces()
            .iter()
            .eq(scene.button_interfaces().iter())
    );
    let file = save::model(&scene, own, &[]).unwrap();
    let mut alone = Scene::new();
    SceneFile::new(file)
        .unwrap()
        .add_to(&mut alone, false)
        .unwrap();
    let names = alone
        .button_interfaces()
        .iter()
        .map(|(_, interface)| interface.name.as_str());
    assert_eq!(names.collect::<Vec<_>>(), ["mine"]);
}

fn script(owner: Option<Handle>, script_type: ScriptType) -> LoadedScript {
    LoadedScript {
        script_type,
        owner,
        code: b"x = 1".to_vec(),
        source: None,
        language: "lua".into(),
        disabled: owner.is_some(),
        exec_order: -1,
    }
}

#[test]
fn scripts_beside_the_tree() {
    let mut scene = Scene::new();
    let [own, other] = [dummy(&mut scene), dummy(&mut scene)];
    let scripts = vec![
        script(None, ScriptType::Main),
        script(Some(own), ScriptType::Simulation),
        script(Some(other), ScriptType::Customization),
    ];
    let (_, again) = load(&saved(
        &scene,
        &Loaded {
            scripts: scripts.clone(),
            ..Loaded::default()
        },
    ));
    assert_eq!(again.scripts, scripts);
    let model = save::model(&scene, own, &scripts).unwrap();
    let types = model
        .contents
        .scripts
        .iter()
        .map(|script| script.ids.unwrap()[2]);
    assert_eq!(types.collect::<Vec<_>>(), [ScriptType::Simulation as i32]);
    // Without a main script of its own, a scene has that of the program.
    assert_eq!(load(&saved(&scene, &Loaded::default())).1.scripts, []);
}

/// A cuboid whose frame is turned by a quarter about z, in a model that stands elsewhere.
fn model() -> (Scene, Handle) {
    let mut scene = Scene::new();
    let outer = dummy(&mut scene);
    scene
        .set_world_pose(outer, Pose::translation(5.0, 0.0, 0.0))
        .unwrap();
    let base = dummy(&mut scene);
    scene.set_parent(base, Some(outer), true).unwrap();
    scene
        .set_local_pose(base, Pose::translation(0.0, 1.0, 0.0))
        .unwrap();
    let size = [1.0, 2.0, 4.0];
    let mut shape = Shape::primitive(PrimitiveKind::Cuboid, size, Default::default()).unwrap();
    let image = |scene: &mut Scene| {
        let pixels = [7, 8, scene.len() as u8];
        let image = Texture::new("dot", [1, 1], false, &pixels).unwrap();
        scene.textures_mut().add(image).unwrap()
    };
    let used = image(&mut scene);
    shape.parts[0].texture = Some(Box::new(TextureMapping::new(TextureSource::Texture(used))));
    for (shape, x) in [(shape.clone(), 10.0), (shape, 0.0)] {
        let quarter = [0.0, 0.0, std::f64::consts::FRAC_PI_2];
        let shape = add(&mut scene, Kind::Shape(Box::new(shape)));
        scene.set_parent(shape, Some(base), true).unwrap();
        scene
            .set_local_pose(shape, Pose::new([x, 0.0, 0.0].into(), quarter.into()))
            .unwrap();
    }
    image(&mut scene);
    (scene, base)
}

#[test]
fn a_model_says_where_it_stands_and_how_large_it_is() {
    let (scene, base) = model();
    let file = save::model(&scene, base, &[]).unwrap();
    assert_eq!(file.header.kind, FileKind::Model as u8);
    let (pose, size, _) = file.contents.model_info.unwrap().pose_box_step.unwrap();
    assert_eq!(pose.pose(), Some(Pose::translation(5.0, 1.0, 0.0)));
    // From the middle of one shape to that of the other, and half of each; x and y change places.
    assert!(
        (0..3).all(|i| (size[i] - [12.0, 1.0, 4.0][i]).abs() < 1e-9),
        "{size:?}"
    );
    assert_eq!(
        file.contents.objects[0].common.handles,
        Some([base.0.cast_signed(), -1])
    );
    assert_eq!(file.contents.textures.len(), 1);
    assert_eq!(save::scene(&scene, &[]).unwrap().contents.textures.len(), 2);
    let empty = save::model(&Scene::new(), base, &[]);
    assert!(empty.is_err());
}

#[test]
fn a_model_without_shapes_has_no_size() {
    let mut scene = Scene::new();
    let base = dummy(&mut scene);
    let info = save::model(&scene, base, &[])
        .unwrap()
        .contents
        .model_info
        .unwrap();
    assert_eq!(info.pose_box_step.unwrap().1, [0.0; 3]);
    assert_eq!(scene.len(), 1);
}
