//! What files are, and where their texts are from.

use super::super::{SceneFile, save};
use super::everything::{add, dummy};
use crate::scene_file::{ScriptSources, is_scene};
use scene::object::script_object::{ScriptObject, ScriptType};
use scene::{Kind, Scene};

#[test]
fn a_file_that_is_copied_keeps_where_its_texts_are_from() {
    let mut scene = Scene::new();
    let script = ScriptObject::new(ScriptType::Simulation, b"x = 1".to_vec(), "lua", false);
    add(&mut scene, Kind::Script(Box::new(script)));
    let file = SceneFile::new(save::scene(&scene, &[]).unwrap()).unwrap();
    assert!(!file.is_model());
    let from = |name: &str| Some(name.to_owned());
    let sources = ScriptSources {
        objects: vec![from("a.lua")],
        attached: vec![from("main.lua")],
    };
    let copy = file.with_sources(sources).copied().unwrap();
    let mut again = Scene::new();
    let loaded = copy.add_to(&mut again, true).unwrap();
    let Kind::Script(script) = &again.object(loaded.objects[0]).unwrap().kind else {
        panic!("no script")
    };
    assert_eq!(script.source, from("a.lua"));
}

#[test]
fn scenes_are_known_by_their_first_bytes_and_models_by_what_they_say() {
    let mut scene = Scene::new();
    let base = dummy(&mut scene);
    let model = save::model(&scene, base, &[]).unwrap();
    assert!(is_scene(&model.write()) && is_scene(b"<?xml version=\"1.0\"?><CoppeliaSim>"));
    assert!(!is_scene(b"") && !is_scene(b"VRE") && !is_scene(b"function f() end"));
    let kinds = |kind: u8, info: bool| {
        let mut file = model.clone();
        file.header.kind = kind;
        file.contents.model_info = file.contents.model_info.filter(|_| info);
        SceneFile::new(file).unwrap().is_model()
    };
    assert_eq!(
        [
            kinds(0, true),
            kinds(2, false),
            kinds(0, false),
            kinds(1, false)
        ],
        [true, true, false, false]
    );
}
