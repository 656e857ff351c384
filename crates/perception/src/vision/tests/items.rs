//! Items of drawing objects: where they face, and what gives them their colours.

use super::pictures::{SIDE, WIDTH, draw, shown, studio, style};
use super::*;
use scene::appearance::colour::Colour;
use scene::drawing::DrawingStyle;
use scene::drawing::options::{DrawingFlags, DrawingKind};

#[test]
fn bodies_face_along_the_axes_exactly() {
    for axis in 0..3 {
        let mut along = [0.0; 3];
        along[axis] = 1.0;
        let mut studio = studio();
        let ahead = nalgebra::Vector3::from(along);
        let up = nalgebra::Vector3::new(along[1], along[2], along[0]);
        let rotation = nalgebra::UnitQuaternion::face_towards(&ahead, &up);
        let pose = Pose::from_parts([0.0; 3].into(), rotation);
        studio.scene.set_world_pose(studio.sensor, pose).unwrap();
        let numbers = [along, along.map(|c| -c)].concat();
        let style = style(DrawingKind::QuadPoints, DrawingFlags::BACK_FACE_CULLING);
        draw(&mut studio, style, &numbers);
        let share = shown(&mut studio).0 * WIDTH * WIDTH;
        assert!((share - 0.25).abs() < 0.04, "{axis}: {share}");
    }
}

#[test]
fn items_that_emit_nothing_are_lit() {
    for (emission, expected) in [([0.0; 3], [64, 32, 0]), ([0.0, 0.0, 0.2], [0, 0, 51])] {
        let mut studio = studio();
        studio
            .scene
            .modify_settings(|settings| settings.environment.ambient_light = [0.5; 3]);
        let colour = Colour {
            ambient_diffuse: [0.5, 0.25, 0.0],
            specular: [0.0; 3],
            emission,
            ..Colour::new([0.0; 3])
        };
        let style = DrawingStyle {
            colour,
            ..style(DrawingKind::QuadPoints, DrawingFlags::empty())
        };
        draw(&mut studio, style, &[0.0, 0.0, 1.0, 0.0, 0.0, -1.0]);
        let picture = studio.picture();
        let at = 3 * (SIDE / 2 * SIDE + SIDE / 2);
        assert_eq!(picture.colour[at..at + 3], expected, "{emission:?}");
    }
}

#[test]
fn drawings_hide_no_object_where_only_those_count() {
    let mut studio = studio();
    let cube = studio.cube(2.0);
    let style = style(DrawingKind::CubePoints, DrawingFlags::empty());
    draw(&mut studio, style, &[0.0, 0.0, 1.0]);
    for (channels, expected) in [(Channels::IDS, cube.0), (Channels::ALL, Picture::NOTHING)] {
        let from = Some(studio.sensor);
        let picture = studio.vision.view(&studio.scene, from, None, channels);
        assert_eq!(picture.unwrap().ids[SIDE / 2 * SIDE + SIDE / 2], expected);
    }
}

#[test]
fn lines_and_points_have_an_auxiliary_colour() {
    let line = [-0.25, 0.0, 1.0, 0.25, 0.0, 1.0];
    for (kind, numbers) in [
        (DrawingKind::Points, &[0.0, 0.0, 1.0][..]),
        (DrawingKind::Lines, &line),
    ] {
        let mut studio = studio();
        let mode = |object: &mut scene::Object| {
            object.vision_sensor_mut().unwrap().render_mode = RenderMode::AUXILIARY;
        };
        studio
            .scene
            .modify(studio.sensor, Field::Sensor, mode)
            .unwrap();
        let colour = Colour {
            auxiliary: [0.2, 0.4, 0.6],
            emission: GLOW,
            ..Colour::new([0.0; 3])
        };
        let style = DrawingStyle {
            colour,
            size: 6.0,
            ..style(kind, DrawingFlags::empty())
        };
        draw(&mut studio, style, numbers);
        let picture = studio.picture();
        let at = 3 * (SIDE / 2 * SIDE + SIDE / 2);
        assert_eq!(picture.colour[at..at + 3], [51, 102, 153], "{kind:?}");
    }
}
