//! Which objects a query compares, and what it finds between them.

use super::*;
use crate::entity::Group;
use scene::{CollectionItem, ItemOptions, Members, ModelFlags, SpecialFlags};

/// A collection of these objects.
fn collection(scene: &mut Scene, objects: &[Handle]) -> Entity {
    let collection = scene.collections_mut().add(true, None);
    let item =
        |object: &Handle| CollectionItem::new(Members::Single(*object), ItemOptions::empty());
    scene.collections_mut().get_mut(collection).unwrap().items = objects.iter().map(item).collect();
    Entity::Collection(collection)
}

#[test]
fn neighbours_of_a_collection_are_not_compared_with_each_other() {
    let mut scene = Scene::new();
    let [first, second] = [cuboid(&mut scene, 0.0), cuboid(&mut scene, 0.1)];
    let [all, same] = [(); 2].map(|()| collection(&mut scene, &[first, second]));
    for (number, expected) in [
        (0, true),
        (1, false),
        (2, true),
        (10, false),
        (11, true),
        (100_000, false),
    ] {
        let change = |object: &mut scene::Object| object.self_collision_indicator = number;
        scene.modify(second, Field::Other, change).unwrap();
        let mut perception = Perception::new(0, None);
        assert_eq!(
            perception.collision(&scene, [all, all]).is_some(),
            expected,
            "{number}"
        );
        // Of two collections all are.
        assert_eq!(
            perception.collision(&scene, [all, same]),
            Some([first, second])
        );
        assert_eq!(
            perception.collision(&scene, [Entity::Object(first); 2]),
            None
        );
    }
}

#[test]
fn what_is_in_one_collection_alone_is_compared_with_what_is_in_both() {
    let mut scene = Scene::new();
    let [early, late] = [0.0, 0.1].map(|x| cuboid(&mut scene, x));
    let [one, both] = [&[late][..], &[early, late]].map(|list| collection(&mut scene, list));
    let mut perception = Perception::new(0, None);
    for (entities, expected) in [([one, both], [late, early]), ([both, one], [early, late])] {
        assert_eq!(perception.collision(&scene, entities), Some(expected));
    }
}

#[test]
fn the_surfaces_of_two_cubes_intersect_along_six_edges() {
    let mut scene = Scene::new();
    let first = cuboid(&mut scene, 0.0);
    let second = primitive(
        &mut scene,
        PrimitiveKind::Cuboid,
        [0.2; 3],
        Pose::translation(0.1, 0.1, 0.1),
    );
    cuboid(&mut scene, 5.0);
    let [one, all] = [
        collection(&mut scene, &[first, second]),
        collection(&mut scene, &[second, first]),
    ];
    // Once, in whatever way the pair is named.
    for entities in [
        [Entity::Object(first), Entity::All],
        [one, all],
        [Entity::Object(second), Entity::Object(first)],
    ] {
        let segments = Perception::new(0, None).intersections(&scene, entities);
        let length = |[a, b]: &[[f64; 3]; 2]| (Vector3::from(*a) - Vector3::from(*b)).norm();
        let whole: f64 = segments.iter().map(length).sum();
        assert!((whole - 0.6).abs() < 1e-9, "{whole}");
        let on_both = |point: &[f64; 3]| {
            let far = |centre: f64| point.iter().map(|c| (c - centre).abs()).fold(0.0, f64::max);
            (far(0.0) - 0.1).abs() < 1e-9 && (far(0.1) - 0.1).abs() < 1e-9
        };
        assert!(segments.as_flattened().iter().all(on_both));
    }
}

#[test]
fn distances_are_those_between_the_nearest_faces() {
    let mut scene = Scene::new();
    let [first, second, third] = [0.0, 1.0, -0.75].map(|x| cuboid(&mut scene, x));
    let mut perception = Perception::new(0, None);
    let mut ask = |entities: [Entity; 2], below: f64| perception.distance(&scene, entities, below);
    let [a, b] = [Entity::Object(first), Entity::Object(second)];
    let found = ask([a, b], f64::INFINITY).unwrap();
    assert!((found.distance - 0.8).abs() < 1e-9 && found.objects == [first, second]);
    assert!((found.points[0][0] - 0.1).abs() < 1e-9 && (found.points[1][0] - 0.9).abs() < 1e-9);
    assert!(ask([a, b], 0.79).is_none() && ask([a, b], 0.81).is_some());
    assert_eq!(ask([a, Entity::All], 2.0).unwrap().objects, [first, third]);
    assert!((ask([Entity::All, Entity::All], 2.0).unwrap().distance - 0.55).abs() < 1e-9);
}

#[test]
fn displaced_objects_collide_where_they_stand_in_the_test() {
    let mut scene = Scene::new();
    let [moved, child, wall] = [0.0, 0.5, 5.0].map(|x| cuboid(&mut scene, x));
    scene.set_parent(child, Some(moved), true).unwrap();
    let mut perception = Perception::new(0, None);
    let pair = [Entity::Object(child), Entity::Object(wall)];
    let test = perception.collision_test(
        &scene,
        &[[Entity::Object(moved), Entity::Object(wall)], pair],
        [moved],
    );
    assert!(!perception.collides(&scene, &test));
    for (x, expected) in [
        (4.5, true),
        (5.0, true),
        (3.0, false),
        (4.5, true),
        (0.0, false),
    ] {
        scene
            .set_world_pose(moved, Pose::translation(x, 0.0, 0.0))
            .unwrap();
        assert_eq!(perception.collides(&scene, &test), expected, "{x}");
    }
    assert_eq!(perception.collision(&scene, pair), None);
}

#[test]
fn each_query_has_its_flags() {
    let mut scene = Scene::new();
    let cube = cuboid(&mut scene, 0.0);
    let purposes = [Purpose::Collision, Purpose::Distance, Purpose::Detection];
    let [collidable, measurable, detectable] = [
        SpecialFlags::COLLIDABLE,
        SpecialFlags::MEASURABLE,
        SpecialFlags::DETECTABLE,
    ];
    let of = |scene: &Scene| purposes.map(|p| p.includes(scene, scene.object(cube).unwrap()));
    for (at, flag) in [collidable, measurable, detectable].into_iter().enumerate() {
        let change = |object: &mut scene::Object| object.special_property = flag;
        scene.modify(cube, Field::SpecialProperty, change).unwrap();
        assert_eq!(of(&scene), [0, 1, 2].map(|other| other == at));
    }
    let all =
        |object: &mut scene::Object| object.special_property = collidable | measurable | detectable;
    scene.modify(cube, Field::SpecialProperty, all).unwrap();
    let switched_off = [
        ModelFlags::NOT_COLLIDABLE,
        ModelFlags::NOT_MEASURABLE,
        ModelFlags::NOT_DETECTABLE,
    ];
    for (at, flag) in switched_off.into_iter().enumerate() {
        let change = |object: &mut scene::Object| object.set_model_property(flag);
        scene.modify(cube, Field::ModelProperty, change).unwrap();
        assert_eq!(of(&scene), [0, 1, 2].map(|other| other != at));
    }
    let group = Entity::All.group(&scene, Purpose::Detection);
    assert_eq!(
        group,
        Group::All {
            except: Default::default()
        }
    );
}
