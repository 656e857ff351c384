//! Names of objects and of copies of models.

use super::*;
use crate::Kind;
use crate::object::dummy::Dummy;

fn add(scene: &mut Scene, name: &str) -> Handle {
    let handle = scene
        .add("dummy", Kind::Dummy(Dummy::new(0.01)))
        .expect("there is room");
    scene.set_old_name(handle, name).expect("it exists");
    handle
}

fn name(scene: &Scene, handle: Handle) -> String {
    scene
        .object(handle)
        .expect("it exists")
        .old_name()
        .to_owned()
}

#[test]
fn created_objects_get_the_next_number() {
    let mut scene = Scene::new();
    let made: Vec<Handle> = (0..3).map(|_| add(&mut scene, "dummy")).collect();
    assert_eq!(
        made.iter().map(|&h| name(&scene, h)).collect::<Vec<_>>(),
        ["dummy", "dummy0", "dummy1"]
    );
    scene.remove(&[made[1]]).expect("it exists");
    let next = add(&mut scene, "dummy");
    assert_eq!(name(&scene, next), "dummy0");
    let arm = [add(&mut scene, "arm7"), add(&mut scene, "arm7")];
    assert_eq!(name(&scene, arm[1]), "arm8");
    let padded = ["arm09", "arm9", "arm8", "arm09"].map(|name| add(&mut scene, name));
    let padded = padded.map(|handle| name(&scene, handle));
    assert_eq!(padded, ["arm09", "arm9", "arm10", "arm11"]);
}

#[test]
fn models_are_numbered_as_a_whole() {
    let mut scene = Scene::new();
    for expected in [
        ["bot", "bot_motor"],
        ["bot#0", "bot_motor#0"],
        ["bot#1", "bot_motor#1"],
    ] {
        let names = ["bot", "bot_motor"];
        let group: Vec<_> = names
            .iter()
            .map(|name| (add(&mut scene, name), (*name).to_owned()))
            .collect();
        scene.number_names(&group, &[]).expect("they exist");
        assert_eq!([0, 1].map(|at| name(&scene, group[at].0)), expected);
    }
    assert!(scene.find_old_name("bot_motor#1").is_ok());
}

#[test]
fn copies_of_a_model_get_the_smallest_number_with_which_all_names_are_free() {
    let mut scene = Scene::new();
    let copy = |scene: &mut Scene| {
        let group: Vec<_> = ["bot", "motor"]
            .map(|name| (add(scene, "copy"), name.to_owned()))
            .into();
        scene.number_names(&group, &[]).expect("they exist");
        group
            .into_iter()
            .map(|(handle, _)| handle)
            .collect::<Vec<_>>()
    };
    let copies: Vec<_> = (0..5).map(|_| copy(&mut scene)).collect();
    assert_eq!(name(&scene, copies[4][1]), "motor#3");
    scene.remove(&copies[2]).expect("they exist");
    scene.remove(&copies[3][..1]).expect("it exists");
    let next = [copy(&mut scene), copy(&mut scene)].map(|copy| name(&scene, copy[0]));
    assert_eq!(next, ["bot#1", "bot#4"]);
    let alone = add(&mut scene, "copy");
    scene
        .number_names(&[(alone, "bot#7".to_owned())], &[])
        .expect("it exists");
    assert_eq!(name(&scene, alone), "bot#2");
}

#[test]
fn suffixes_are_split() {
    assert_eq!(
        [suffix("arm#12"), suffix("arm12"), suffix("arm#")],
        [(12, "arm"), (-1, "arm12"), (-1, "arm")]
    );
}

#[test]
fn illegal_names_are_refused() {
    for name in [
        "",
        "#1",
        "arm#",
        "arm#00",
        "my arm",
        "a#b",
        "a#1#2",
        &"x".repeat(128),
    ] {
        assert!(!is_legal(name), "{name}");
    }
    for name in ["arm", "arm#0", "arm#12", "arm(2)", "a_b", &"x".repeat(127)] {
        assert!(is_legal(name), "{name}");
    }
}
