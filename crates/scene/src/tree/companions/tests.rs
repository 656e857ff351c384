//! Copies of companions, and the names that they get.

use super::*;
use crate::object::dummy::Dummy;
use crate::sensor::{VisionOptions, VisionSensor};
use crate::{CopyOptions, ItemOptions, Kind};

/// A model of two dummies and a sensor that sees one of them: a collection, a group of inverse kinematics, a distance and a collision
/// object are about them.
fn arm(scene: &mut Scene) -> [Handle; 3] {
    let dummy = || Kind::Dummy(Dummy::new(0.01));
    let eye = VisionSensor::new(VisionOptions::empty(), [4, 4], None);
    let kinds = [dummy(), dummy(), Kind::VisionSensor(Box::new(eye))];
    let names = ["arm", "arm_tip", "arm_eye"];
    let mut parts = kinds.into_iter().zip(names).map(|(kind, name)| {
        let part = scene.add("part", kind).expect("there is room");
        scene.set_old_name(part, name).expect("it exists");
        part
    });
    let parts: [Handle; 3] = std::array::from_fn(|_| parts.next().expect("there are three"));
    let [base, tip, eye] = parts;
    let links = scene.collections_mut().add(true, None);
    let item = |base| CollectionItem::new(Members::Tree(base), ItemOptions::empty());
    let collection = scene.collections_mut().get_mut(links).expect("it exists");
    collection.items = vec![item(base), item(tip)];
    let named = scene.collections_mut().set_name(links, "arm_links".into());
    named.expect("it exists");
    let sees = |object: &mut Object| {
        object.vision_sensor_mut()?.entity = Entity::from_raw(links);
        Ok(())
    };
    scene
        .try_modify(eye, crate::Field::Sensor, sees)
        .expect("it is a sensor");
    scene.ik_groups_mut().add(IkGroup {
        persistent_uid: "uid".into(),
        elements: vec![IkElement {
            base: Some(base),
            ..IkElement::new(tip)
        }],
        ..IkGroup::new("arm_ik")
    });
    scene
        .collision_objects_mut()
        .add(pair("arm_hit", [links, special::ALL]));
    scene
        .distance_objects_mut()
        .add(pair("arm_gap", [base.raw(), tip.raw()]));
    parts
}

fn pair<R>(name: &str, entities: [i64; 2]) -> CalculationObject<R> {
    CalculationObject {
        name: name.into(),
        persistent_uid: String::new(),
        entities,
        threshold: 0.5,
        explicit: true,
        switches: 0,
        result: None,
    }
}

fn copy(scene: &mut Scene, parts: &[Handle]) -> Copies {
    let options = CopyOptions::empty();
    scene.copy_objects(parts, options).expect("there is room")
}

#[test]
fn copies_of_a_model_have_companions_of_their_own() {
    let mut scene = Scene::new();
    let parts = arm(&mut scene);
    let copies = copy(&mut scene, &parts);
    let [base, tip, eye] = parts.map(|part| copies[&part]);
    assert_eq!(scene.object(base).expect("it exists").old_name(), "arm#0");
    let links = scene
        .collections()
        .named("arm_links#0")
        .expect("it was copied");
    let members = scene.collection_objects(links).expect("it exists");
    assert_eq!(members, [base, tip]);
    assert!(scene.collections().get(links).expect("it exists").overrides);
    let entity = scene
        .object(eye)
        .and_then(|eye| Ok(eye.vision_sensor()?.entity));
    assert_eq!(entity, Ok(Entity::from_raw(links)));
    let group = scene.ik_groups().named("arm_ik#0").expect("it was copied");
    let group = scene.ik_groups().get(group).expect("it exists");
    assert_eq!(
        (group.elements[0].tip, group.elements[0].base),
        (tip, Some(base))
    );
    assert_eq!(group.persistent_uid, "");
    let hit = scene
        .collision_objects()
        .named("arm_hit#0")
        .expect("it was copied");
    let hit = scene.collision_objects().get(hit).expect("it exists");
    assert_eq!((hit.entities, hit.explicit), ([links, special::ALL], true));
    let distance = scene
        .distance_objects()
        .named("arm_gap#0")
        .expect("it was copied");
    let distance = scene.distance_objects().get(distance).expect("it exists");
    assert_eq!(
        (distance.entities, distance.threshold),
        ([base.raw(), tip.raw()], 0.5)
    );
}

#[test]
fn what_is_about_other_objects_too_is_not_copied() {
    let mut scene = Scene::new();
    let [base, tip, eye] = arm(&mut scene);
    let unnamed = scene.collections_mut().add(false, None);
    let all = CollectionItem::new(Members::Single(base), ItemOptions::empty());
    let collection = scene.collections_mut().get_mut(unnamed).expect("it exists");
    collection.items = vec![all];
    let copies = copy(&mut scene, &[base, eye]);
    assert_eq!(scene.collections().iter().count(), 2);
    assert_eq!(scene.ik_groups().iter().count(), 1);
    assert_eq!(scene.collision_objects().iter().count(), 1);
    assert_eq!(scene.distance_objects().iter().count(), 1);
    // The copied sensor sees what the original sees.
    let links = scene
        .collections()
        .named("arm_links")
        .expect("it is still there");
    let entity = scene
        .object(copies[&eye])
        .and_then(|eye| Ok(eye.vision_sensor()?.entity));
    assert_eq!(entity, Ok(Entity::from_raw(links)));
    // Without its base a chain begins at the world.
    copy(&mut scene, &[tip]);
    let group = scene.ik_groups().named("arm_ik#0").expect("it was copied");
    let group = scene.ik_groups().get(group).expect("it exists");
    assert_eq!(group.elements[0].base, None);
}

#[test]
fn copies_and_their_companions_have_one_number() {
    let mut scene = Scene::new();
    let parts = arm(&mut scene);
    let first = copy(&mut scene, &parts);
    let second = copy(&mut scene, &parts);
    let name = |scene: &Scene, copies: &Copies| {
        let copy = scene.object(copies[&parts[0]]).expect("it exists");
        copy.old_name().to_owned()
    };
    assert_eq!(name(&scene, &second), "arm#1");
    // Companions end with their objects, so that the number is free again.
    scene
        .remove(&first.into_values().collect::<Vec<_>>())
        .expect("they exist");
    assert_eq!(scene.collections().named("arm_links#0"), None);
    let third = copy(&mut scene, &parts);
    assert_eq!(name(&scene, &third), "arm#0");
    assert!(scene.is_companion(Companion::IkGroup, "arm_ik#0"));
    // A number whose name another companion has is passed over.
    scene.ik_groups_mut().add(IkGroup::new("arm_ik#2"));
    let fourth = copy(&mut scene, &parts);
    assert_eq!(name(&scene, &fourth), "arm#3");
    assert!(scene.is_companion(Companion::Collision, "arm_hit#3"));
}
