//! What vision sensors see: their channels, what is renderable, sides of surfaces.

use super::*;
use scene::sensor::Entity;
use scene::{ModelFlags, ObjectFlags, SpecialFlags};

#[test]
fn sensors_have_the_channels_they_do_not_ignore() {
    for (image, depth, by_handle) in [
        (true, true, false),
        (false, true, false),
        (true, false, false),
        (false, false, true),
        (true, true, true),
    ] {
        let mut studio = Studio::new();
        let cube = studio.cube(2.0);
        let change = |object: &mut scene::Object| {
            let sensor = object.vision_sensor_mut().unwrap();
            (sensor.ignore_image, sensor.ignore_depth) = (!image, !depth);
            if by_handle {
                sensor.render_mode = RenderMode::HANDLES;
            }
        };
        studio
            .scene
            .modify(studio.sensor, Field::Sensor, change)
            .unwrap();
        let picture = studio
            .vision
            .sensor_picture(&studio.scene, studio.sensor, None)
            .unwrap();
        assert_eq!(
            picture.image.as_ref().map(Vec::len),
            image.then_some(3 * 81)
        );
        assert_eq!(picture.depth.as_ref().map(Vec::len), depth.then_some(81));
        assert_eq!(picture.seen, by_handle.then(|| vec![cube]));
        if let Some(image) = picture.image.filter(|_| by_handle) {
            assert_eq!(image[..3], [255; 3], "nothing is in the corner");
        }
    }
}

#[test]
fn sensors_see_what_is_renderable_unless_one_object_is_named() {
    let mut studio = Studio::new();
    let cube = studio.cube(2.0);
    let hide = |object: &mut scene::Object| object.special_property = SpecialFlags::COLLIDABLE;
    studio
        .scene
        .modify(cube, Field::SpecialProperty, hide)
        .unwrap();
    assert_eq!(studio.middle().2, None);
    let watch = |studio: &mut Studio, entity: Entity| {
        let change =
            |object: &mut scene::Object| object.vision_sensor_mut().unwrap().entity = entity;
        studio
            .scene
            .modify(studio.sensor, Field::Sensor, change)
            .unwrap();
        studio.middle().2
    };
    assert_eq!(watch(&mut studio, cube.into()), Some(cube));
    for overrides in [true, false] {
        let collection = studio.scene.collections_mut().add(overrides, None);
        let item = CollectionItem::new(Members::Single(cube), ItemOptions::empty());
        studio
            .scene
            .collections_mut()
            .get_mut(collection)
            .unwrap()
            .items
            .push(item);
        let seen = watch(&mut studio, Entity::from_raw(collection));
        assert_eq!(seen.is_some(), overrides);
    }
    let show = |object: &mut scene::Object| {
        object.special_property = SpecialFlags::RENDERABLE;
        object.set_model_property(ModelFlags::NOT_RENDERABLE);
    };
    studio
        .scene
        .modify(cube, Field::SpecialProperty, show)
        .unwrap();
    assert_eq!(watch(&mut studio, Entity::ALL), None);
}

#[test]
fn surfaces_may_be_seen_from_one_side_only_and_let_light_through() {
    let mut studio = Studio::new();
    // The sensor is within the cube: it sees the far side from within.
    let cube = studio.cube(0.0);
    let near = |studio: &mut Studio, culling: bool, opacity: f32| {
        let change = |object: &mut scene::Object| {
            let appearance = &mut object.shape_mut().unwrap().parts[0].appearance;
            (appearance.culling, appearance.colour.opacity) = (culling, opacity);
        };
        studio
            .scene
            .modify(cube, Field::Appearance, change)
            .unwrap();
        studio.middle()
    };
    assert_eq!(near(&mut studio, false, 1.0).2, Some(cube));
    assert_eq!(near(&mut studio, true, 1.0).2, None);
    let half = near(&mut studio, false, 0.5).0;
    assert!(half[0].abs_diff(128) < 3, "{half:?}");
    let auxiliary = |object: &mut scene::Object| {
        object.vision_sensor_mut().unwrap().render_mode = RenderMode::AUXILIARY;
    };
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, auxiliary)
        .unwrap();
    for culling in [false, true] {
        near(&mut studio, culling, 1.0);
        let picture = studio
            .vision
            .sensor_picture(&studio.scene, studio.sensor, None)
            .unwrap();
        let is_far_side_seen = picture.depth.unwrap()[40] < 0.1;
        assert_eq!(is_far_side_seen, !culling);
    }
}

#[test]
fn what_is_not_in_the_depth_hides_nothing_there() {
    let mut studio = Studio::new();
    let cubes = [studio.cube(2.0), studio.cube(4.0)];
    for (is_hidden, depth) in [(false, 1.75), (true, 3.75)] {
        let change = |object: &mut scene::Object| {
            let property = &mut object.object_property;
            property.set(ObjectFlags::DEPTH_INVISIBLE, is_hidden);
        };
        studio
            .scene
            .modify(cubes[0], Field::ObjectProperty, change)
            .unwrap();
        let (_, found, seen) = studio.middle();
        assert_eq!(seen, Some(cubes[0]));
        assert!((found - depth).abs() < 1e-4, "{found} is not {depth}");
    }
}

#[test]
fn sensors_may_see_through_fog() {
    let mut studio = Studio::new();
    studio.cube(2.0);
    studio.scene.modify_settings(|settings| {
        let fog = &mut settings.environment.fog;
        (fog.enabled, fog.fog_type) = (true, scene::appearance::environment::FogType::LINEAR);
        // The face of the cube is 1.75 m away: half of what is seen there is fog.
        (fog.start, fog.end, fog.colour) = (0.75, Some(2.75), Some([0.0, 0.0, 1.0]));
    });
    for (ignores, expected) in [(false, [128, 0, 128]), (true, [255, 0, 0])] {
        let change = |object: &mut scene::Object| {
            object.vision_sensor_mut().unwrap().ignore_fog = ignores;
        };
        studio
            .scene
            .modify(studio.sensor, Field::Sensor, change)
            .unwrap();
        let picture = studio
            .vision
            .sensor_picture(&studio.scene, studio.sensor, None)
            .unwrap();
        let image = picture.image.unwrap();
        let is_near = (0..3).all(|i| image[120 + i].abs_diff(expected[i]) < 4);
        assert!(is_near, "{:?} is not {expected:?}", &image[120..123]);
    }
}

#[test]
fn parts_of_a_shape_are_where_the_shape_has_them() {
    let mut studio = Studio::new();
    let cube = studio.cube(2.0);
    let change = |object: &mut scene::Object| {
        object.shape_mut().unwrap().parts[0].pose = Pose::translation(0.0, 0.0, 1.0);
    };
    studio.scene.modify(cube, Field::Geometry, change).unwrap();
    let depth = studio.middle().1;
    assert!((depth - 2.75).abs() < 1e-4, "{depth}");
}

#[test]
fn the_memory_of_a_picture_serves_the_next_one() {
    let mut studio = Studio::new();
    studio.cube(2.0);
    let first = studio.picture();
    let places = (first.colour.as_ptr(), first.depth.as_ptr());
    let expected = (first.colour.clone(), first.depth.clone());
    studio.vision.reuse(first.colour, first.depth);
    let second = studio.picture();
    assert_eq!((second.colour.as_ptr(), second.depth.as_ptr()), places);
    assert_eq!((second.colour, second.depth), expected);
}

#[test]
fn an_image_of_two_colours_has_them_side_by_side() {
    let mut studio = Studio::new();
    let cube = studio.cube(2.0);
    let image = Texture::new("two", [2, 1], false, &[0, 0, 255, 0, 255, 0]).unwrap();
    let id = studio.scene.textures_mut().add(image).unwrap();
    let decal = TextureMapping {
        apply_mode: ApplyMode::DECAL,
        interpolate: false,
        ..TextureMapping::new(TextureSource::Texture(id))
    };
    studio.scene.set_shape_texture(cube, Some(decal)).unwrap();
    let picture = studio.picture();
    let at = |column: usize| &picture.colour[3 * (36 + column)..][..3];
    let mut sides = [at(3), at(5)];
    sides.sort_unstable();
    assert_eq!(sides, [[0, 0, 255], [0, 255, 0]]);
}
