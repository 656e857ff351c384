//! Bodies of the index: where their parts are, and what becomes of those whose objects are gone.

use super::*;
use crate::index::Index;

#[test]
fn parts_turn_and_move_with_their_object() {
    let mut scene = Scene::new();
    let turned = Pose::new(
        [0.0; 3].into(),
        [0.0, 0.0, std::f64::consts::FRAC_PI_2].into(),
    );
    let first = primitive(&mut scene, PrimitiveKind::Cuboid, [0.2; 3], turned);
    let second = cuboid(&mut scene, 1.0);
    // A quarter of a turn brings it onto the x axis.
    let change = |object: &mut scene::Object| {
        object.shape_mut().unwrap().parts[0].pose = Pose::translation(0.0, -0.3, 0.0);
    };
    scene.modify(first, Field::Geometry, change).unwrap();
    let entities = [first, second].map(Entity::Object);
    let found = Perception::new(0, None).distance(&scene, entities, f64::INFINITY);
    let found = found.unwrap();
    assert!((found.distance - 0.5).abs() < 1e-9, "{found:?}");
    assert!((found.points[0][0] - 0.4).abs() < 1e-9, "{found:?}");
}

#[test]
fn what_is_gone_has_no_body_and_keeps_no_mesh() {
    let mut scene = Scene::new();
    let [first, second] = [0.0, 1.0].map(|x| cuboid(&mut scene, x));
    let copy = scene.copy_objects(&[first], scene::CopyOptions::empty());
    let copy = copy.unwrap()[&first];
    let mut index = Index::default();
    let mut after = |scene: &Scene| {
        index.update(scene);
        let has_body = [first, second, copy].map(|object| index.body(object).is_some());
        (has_body, index.kept_meshes())
    };
    // A copy shares its mesh.
    assert_eq!(after(&scene), ([true; 3], 2));
    scene.remove(&[first]).unwrap();
    assert_eq!(after(&scene), ([false, true, true], 2));
    scene.remove(&[copy]).unwrap();
    assert_eq!(after(&scene), ([false, true, false], 1));
    scene.remove(&[second]).unwrap();
    assert_eq!(after(&scene), ([false; 3], 0));
}

#[test]
fn points_of_a_cloud_are_detected_and_measured() {
    use scene::voxels::cloud_points::CloudPoints;
    use scene::voxels::point_cloud::{CloudPoint, PointCloud};
    let mut scene = Scene::new();
    let mut cloud = PointCloud {
        max_cell_size: 0.5,
        max_points_in_cell: 4,
        point_size: 1,
        uses_octree: true,
        display_fraction: 1.0,
        random_colours: false,
        points: CloudPoints::default(),
    };
    let point = |z: f64| CloudPoint {
        position: [0.0, 0.0, z],
        colour: [0; 3],
    };
    cloud.insert([0.5, 1.0].map(point).into_iter(), 0.0);
    let cloud = scene.add("cloud", Kind::PointCloud(Box::new(cloud)));
    let cloud = Entity::Object(cloud.unwrap());
    let cone = sensor(&mut scene, VolumeType::Cone);
    let mut perception = Perception::new(0, None);
    let found = detect(&mut perception, &scene, cone, cloud).unwrap();
    assert_eq!(found.detection.point, [0.0, 0.0, 0.5]);
    let cube = Entity::Object(cuboid(&mut scene, 0.0));
    let found = perception.distance(&scene, [cloud, cube], f64::INFINITY);
    assert!((found.unwrap().distance - 0.4).abs() < 1e-9);
}
