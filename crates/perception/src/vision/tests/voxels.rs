//! Octrees: cubes in the light, or points.

use super::pictures::{SIDE, WIDTH, studio};
use super::*;

/// A voxel of 0.5 m whose face is 2 m away, in the light of a lamp at the sensor.
#[test]
fn a_voxel_is_lit_as_a_cube_of_its_colour() {
    let mut studio = studio();
    studio
        .scene
        .modify_settings(|settings| settings.environment.ambient_light = [0.0; 3]);
    let light = Kind::Light(Box::new(Light::new(LightType::Directional)));
    studio.scene.add("light", light).unwrap();
    let mut tree = OcTree::new(0.5, 1.0);
    let voxel = Voxel {
        colour: [200, 100, 0],
        tag: 0,
    };
    tree.insert([0.25; 3], voxel);
    let tree = studio.scene.add("octree", Kind::OcTree(Box::new(tree)));
    let tree = tree.unwrap();
    let pose = Pose::translation(-0.25, -0.25, 2.0);
    studio.scene.set_world_pose(tree, pose).unwrap();
    // What lights reach of a surface is half of its colour; that of the object does not count.
    let dye = |object: &mut scene::Object| {
        object.colour.ambient_diffuse = [0.1; 3];
        object.colour.specular = [0.0; 3];
    };
    studio.scene.modify(tree, Field::Appearance, dye).unwrap();
    let picture = studio.picture();
    let seen: Vec<usize> = (0..SIDE * SIDE)
        .filter(|index| picture.ids[*index] == tree.0)
        .collect();
    let expected = 0.0625 / (WIDTH * WIDTH) * (SIDE * SIDE) as f64;
    let count = seen.len() as f64;
    assert!(
        (count - expected).abs() < 0.1 * expected,
        "{count} is not {expected}"
    );
    for index in seen {
        assert_eq!(picture.colour[3 * index..3 * index + 3], [100, 50, 0]);
        let depth = 0.1 + 9.9 * picture.depth[index];
        assert!((depth - 2.0).abs() < 1e-4, "{depth}");
    }
}

#[test]
fn an_octree_may_be_shown_as_points() {
    let mut studio = studio();
    studio
        .scene
        .modify_settings(|settings| settings.environment.ambient_light = [1.0; 3]);
    let mut tree = OcTree::new(0.1, 4.0);
    tree.shows_points = true;
    tree.insert(
        [0.05, 0.05, 1.05],
        Voxel {
            colour: [51, 102, 153],
            tag: 0,
        },
    );
    let tree = studio
        .scene
        .add("octree", Kind::OcTree(Box::new(tree)))
        .unwrap();
    let picture = studio.picture();
    let at = |index: usize| &picture.colour[3 * index..3 * index + 3];
    let seen: Vec<usize> = (0..SIDE * SIDE)
        .filter(|index| picture.ids[*index] == tree.0)
        .collect();
    assert_eq!(seen.len(), 16);
    assert!(seen.iter().all(|index| at(*index) == [51, 102, 153]));
}
