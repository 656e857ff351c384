//! What pictures share: meshes and images of shapes, memory. And what of it may not be shared.

use std::num::NonZero;

use super::*;
use crate::vision::texture_coordinates;
use scene::ObjectFlags;

/// A cube with an image of two pixels, blue and green, which is all blue or all green as `u` says.
fn painted(studio: &mut Studio, id: i64, cube: Handle, u: f32) {
    let decal = TextureMapping {
        apply_mode: ApplyMode::DECAL,
        interpolate: false,
        coordinates: [u, 0.5].repeat(36).into(),
        ..TextureMapping::new(TextureSource::Texture(id))
    };
    studio.scene.set_shape_texture(cube, Some(decal)).unwrap();
}

fn two_colours(studio: &mut Studio) -> i64 {
    let image = Texture::new("two", [2, 1], false, &[0, 0, 255, 0, 255, 0]).unwrap();
    studio.scene.textures_mut().add(image).unwrap()
}

/// A cube and a copy of it, beside each other.
fn two_cubes(studio: &mut Studio) -> [Handle; 2] {
    let cube = studio.cube(2.0);
    let copies = studio.scene.copy_objects(&[cube], CopyOptions::empty());
    let cubes = [cube, copies.unwrap()[&cube]];
    for (cube, x) in cubes.into_iter().zip([0.4, -0.4]) {
        let pose = Pose::translation(x, 0.0, 2.0);
        studio.scene.set_world_pose(cube, pose).unwrap();
    }
    cubes
}

#[test]
fn copies_with_coordinates_of_their_own_look_different() {
    let mut studio = Studio::new();
    let (id, cubes) = (two_colours(&mut studio), two_cubes(&mut studio));
    painted(&mut studio, id, cubes[0], 0.25);
    painted(&mut studio, id, cubes[1], 0.75);
    let picture = studio.picture();
    for (cube, colour) in cubes.into_iter().zip([[0, 0, 255], [0, 255, 0]]) {
        let at = picture.ids.iter().position(|id| *id == cube.0).unwrap();
        assert_eq!(picture.colour[3 * at..3 * at + 3], colour);
    }
}

#[test]
fn coordinates_of_the_corners_replace_the_projection() {
    let mut studio = Studio::new();
    let (id, cube) = (two_colours(&mut studio), studio.cube(2.0));
    let of = |studio: &Studio| {
        let object = studio.scene.object(cube).unwrap();
        texture_coordinates(&object.shape().unwrap().parts[0])
    };
    assert!(of(&studio).is_empty());
    painted(&mut studio, id, cube, 0.25);
    assert_eq!(of(&studio), [[0.25, 0.5]; 36]);
    let projected = TextureMapping::new(TextureSource::Texture(id));
    studio
        .scene
        .set_shape_texture(cube, Some(projected))
        .unwrap();
    // Each corner of the cube lies a quarter of a metre from the middle of the image, which is a metre wide.
    let is_corner = |place: &[f32; 2]| place.iter().all(|part| (part - 0.5).abs() == 0.25);
    assert!(of(&studio).len() == 36 && of(&studio).iter().all(is_corner));
}

#[test]
fn shapes_share_an_image_until_the_last_one_is_gone() {
    let mut studio = Studio::new();
    let (id, cubes) = (two_colours(&mut studio), two_cubes(&mut studio));
    for cube in cubes {
        painted(&mut studio, id, cube, 0.25);
    }
    let plain = studio.cube(3.0);
    let images = |studio: &mut Studio| {
        studio.picture();
        studio.vision.models.prepared_images()
    };
    assert_eq!(images(&mut studio), 1);
    for (cube, expected) in [(plain, 1), (cubes[0], 1), (cubes[1], 0)] {
        studio.scene.remove(&[cube]).unwrap();
        assert_eq!(images(&mut studio), expected);
    }
}

#[test]
fn depth_is_measured_where_it_is_asked_for() {
    let mut studio = Studio::new();
    let cube = studio.cube(2.0);
    for hidden in [false, true] {
        let change = |object: &mut scene::Object| {
            object
                .object_property
                .set(ObjectFlags::DEPTH_INVISIBLE, hidden);
        };
        studio
            .scene
            .modify(cube, Field::ObjectProperty, change)
            .unwrap();
        for (channels, depths) in [
            (Channels::COLOUR, 0),
            (Channels::IDS, 0),
            (Channels::ALL, 81),
        ] {
            let from = Some(studio.sensor);
            let picture = studio.vision.view(&studio.scene, from, None, channels);
            assert_eq!(picture.unwrap().depth.len(), depths, "{channels:?}");
        }
    }
}

#[test]
fn as_many_threads_draw_as_are_wanted() {
    for count in [1, 3] {
        assert_eq!(crate::vision::threads(NonZero::new(count)), count);
    }
}
