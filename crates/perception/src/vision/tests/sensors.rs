//! What vision sensors see: their channels, what is renderable, sides of surfaces.

use super::*;
use scene::sensor::Entity;
use scene::{ModelFlags, SpecialFlags};

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
            let looks = &mut object.shape_mut().unwrap().parts[0].appearance;
            (looks.culling, looks.colour.opacity) = (culling, opacity);
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
}
