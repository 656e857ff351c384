//! Drawing objects, clouds and sensors: pictures whose pixels follow from the geometry.

use super::*;
use crate::vision::views::first_camera;
use nalgebra::Point3;
use scene::appearance::colour::Colour;
use scene::drawing::DrawingStyle;
use scene::drawing::options::{DrawingFlags, DrawingKind};
use scene::voxels::cloud_points::CloudPoints;
use scene::voxels::point_cloud::{CloudPoint, PointCloud};

/// Pixels along a side of the pictures, and the width of what is seen at a distance of one metre.
pub(super) const SIDE: usize = 64;

pub(super) const WIDTH: f64 = 2.0 * 0.546_302_489_843_790_5;

pub(super) fn studio() -> Studio {
    let mut studio = Studio::new();
    let size = |object: &mut scene::Object| {
        let side = SIDE as i64;
        object
            .vision_sensor_mut()
            .unwrap()
            .view
            .set_resolution([side, side]);
    };
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, size)
        .unwrap();
    studio
}

pub(super) fn style(kind: DrawingKind, flags: DrawingFlags) -> DrawingStyle {
    let colour = Colour {
        emission: GLOW,
        ..Colour::new([0.0; 3])
    };
    DrawingStyle {
        kind,
        flags: flags | DrawingFlags::PAINT_TAG,
        size: 0.5,
        duplicate_tolerance: 0.0,
        parent: None,
        max_items: 10,
        colour,
    }
}

pub(super) fn draw(studio: &mut Studio, style: DrawingStyle, numbers: &[f64]) {
    let handle = studio.scene.add_drawing(style, None).unwrap();
    studio.scene.add_drawing_items(handle, numbers).unwrap();
}

fn is_red(pixel: &[u8]) -> bool {
    pixel[0] > 100 && pixel[1] < 50 && pixel[2] < 50
}

/// The share of the picture that is red, and how far away its middle is (m).
pub(super) fn shown(studio: &mut Studio) -> (f64, f64) {
    let picture = studio.picture();
    let red = picture
        .colour
        .chunks(3)
        .filter(|pixel| is_red(pixel))
        .count();
    let middle = SIDE / 2 * SIDE + SIDE / 2;
    let depth = 0.1 + 9.9 * f64::from(picture.depth[middle]);
    (red as f64 / picture.depth.len() as f64, depth)
}

#[test]
fn small_bodies_have_their_form_and_size() {
    use DrawingKind::{CubePoints, DiscPoints, QuadPoints, SpherePoints, TrianglePoints};
    let towards = [0.0, 0.0, 1.0, 0.0, 0.0, -1.0];
    let corners = [-0.25, -0.25, 1.0, 0.25, -0.25, 1.0, 0.0, 0.25, 1.0];
    let unit = WIDTH * WIDTH;
    // Areas at one metre; the face of the cube and the ball are nearer.
    for (kind, numbers, area, depth) in [
        (QuadPoints, &towards[..], 0.25, 1.0),
        (DiscPoints, &towards[..], 0.191, 1.0),
        (TrianglePoints, &towards[..], 0.0812, 1.0),
        (DrawingKind::Triangles, &corners[..], 0.125, 1.0),
        (CubePoints, &towards[..3], 0.25 / 0.5625, 0.75),
        (SpherePoints, &towards[..3], 0.2094, 0.75),
    ] {
        let mut studio = studio();
        draw(&mut studio, style(kind, DrawingFlags::empty()), numbers);
        let (share, found) = shown(&mut studio);
        let expected = area / unit;
        assert!(
            (share - expected).abs() < 0.15 * expected,
            "{kind:?}: {share} is not {expected}"
        );
        assert!(
            (found - depth).abs() < 0.02,
            "{kind:?}: {found} is not {depth}"
        );
    }
}

#[test]
fn items_of_one_object_are_apart_and_may_have_a_back() {
    let [left, right] = [-0.3, 0.3].map(|x| [x, 0.0, 1.0, 0.0, 0.0, -1.0]);
    let away = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
    let one = 0.25 / (WIDTH * WIDTH);
    for (numbers, flags, quads) in [
        ([left, right].concat(), DrawingFlags::empty(), 2.0),
        (away.to_vec(), DrawingFlags::empty(), 1.0),
        (away.to_vec(), DrawingFlags::BACK_FACE_CULLING, 0.0),
        (left.to_vec(), DrawingFlags::BACK_FACE_CULLING, 1.0),
    ] {
        let mut studio = studio();
        draw(&mut studio, style(DrawingKind::QuadPoints, flags), &numbers);
        let share = shown(&mut studio).0;
        assert!(
            (share - quads * one).abs() < 0.15 * one,
            "{share} is not {quads} quads"
        );
    }
}

#[test]
fn solid_bodies_show_their_outside() {
    for kind in [DrawingKind::CubePoints, DrawingKind::SpherePoints] {
        let mut studio = studio();
        let style = style(kind, DrawingFlags::BACK_FACE_CULLING);
        draw(&mut studio, style, &[0.0, 0.0, 1.0]);
        let depth = shown(&mut studio).1;
        assert!((depth - 0.75).abs() < 0.02, "{kind:?}: {depth}");
    }
}

#[test]
fn between_small_bodies_there_is_nothing() {
    use DrawingKind::{DiscPoints, QuadPoints, TrianglePoints};
    let numbers = [-0.35, 0.35].map(|x| [x, x, 1.0, 0.0, 0.0, -1.0]).concat();
    // Of bodies 0.2 m wide.
    for (kind, area) in [
        (QuadPoints, 0.04),
        (DiscPoints, 0.0306),
        (TrianglePoints, 0.013),
    ] {
        let mut studio = studio();
        let small = DrawingStyle {
            size: 0.2,
            ..style(kind, DrawingFlags::empty())
        };
        draw(&mut studio, small, &numbers);
        let (share, expected) = (shown(&mut studio).0, 2.0 * area / (WIDTH * WIDTH));
        let is_near = (share - expected).abs() < 0.25 * expected;
        assert!(is_near, "{kind:?}: {share} is not {expected}");
    }
}

#[test]
fn edges_alone_are_thin() {
    let mut studio = studio();
    let style = style(DrawingKind::QuadPoints, DrawingFlags::WIREFRAME);
    draw(&mut studio, style, &[0.0, 0.0, 1.0, 0.0, 0.0, -1.0]);
    let share = shown(&mut studio).0 * WIDTH * WIDTH / 0.25;
    assert!((0.02..0.6).contains(&share), "{share} of the quad");
}

#[test]
fn bodies_face_any_direction() {
    let turns = [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.4, 0.4, 0.0]];
    for turn in turns.map(|turn| nalgebra::Vector3::from(turn) * std::f64::consts::FRAC_PI_2) {
        let mut studio = studio();
        let pose = Pose::new([0.0; 3].into(), turn);
        studio.scene.set_world_pose(studio.sensor, pose).unwrap();
        let ahead = pose * nalgebra::Vector3::z();
        let numbers = [ahead, -ahead].map(<[f64; 3]>::from).concat();
        draw(
            &mut studio,
            style(DrawingKind::QuadPoints, DrawingFlags::empty()),
            &numbers,
        );
        let share = shown(&mut studio).0 * WIDTH * WIDTH;
        assert!((share - 0.25).abs() < 0.04, "{turn:?}: {share}");
    }
}

#[test]
fn bodies_that_face_the_camera_are_seen_from_everywhere() {
    let mut studio = studio();
    let tilted = Pose::new([0.0; 3].into(), [0.0, 1.0, 0.0].into());
    studio.scene.set_world_pose(studio.sensor, tilted).unwrap();
    let place = tilted * Point3::new(0.0, 0.0, 1.0);
    let flags = DrawingFlags::FACING_CAMERA | DrawingFlags::BACK_FACE_CULLING;
    draw(
        &mut studio,
        style(DrawingKind::QuadPoints, flags),
        place.coords.as_slice(),
    );
    let (share, depth) = shown(&mut studio);
    let expected = 0.25 / (WIDTH * WIDTH);
    assert!(
        (share - expected).abs() < 0.15 * expected && (depth - 1.0).abs() < 0.01,
        "{share} {depth}"
    );
}

#[test]
fn points_and_lines_have_a_width_in_pixels() {
    let line = [-0.25, 0.0, 1.0, 0.25, 0.0, 1.0];
    let length = 0.5 / WIDTH * SIDE as f64;
    for (kind, numbers, pixels) in [
        (DrawingKind::Points, &line[..], 2.0 * 16.0),
        (DrawingKind::Lines, &line[..], 4.0 * length),
        (DrawingKind::LineStrip, &line[..], 4.0 * length),
    ] {
        let mut studio = studio();
        let style = DrawingStyle {
            size: 4.0,
            ..style(kind, DrawingFlags::empty())
        };
        draw(&mut studio, style, numbers);
        let found = shown(&mut studio).0 * (SIDE * SIDE) as f64;
        assert!(
            (found - pixels).abs() < 0.3 * pixels,
            "{kind:?}: {found} is not {pixels}"
        );
    }
}

#[test]
fn drawings_go_with_their_parent() {
    let mut studio = studio();
    let parent = studio
        .scene
        .add("parent", Kind::Dummy(scene::object::dummy::Dummy::new(0.1)))
        .unwrap();
    studio
        .scene
        .set_world_pose(parent, Pose::translation(0.0, 0.0, 1.0))
        .unwrap();
    let flags = DrawingFlags::WITH_PARENT_VISIBILITY;
    let with_parent = DrawingStyle {
        parent: Some(parent),
        ..style(DrawingKind::SpherePoints, flags)
    };
    // Scripts say it in the world, where the parent is now.
    draw(&mut studio, with_parent, &[0.0, 0.0, 1.0]);
    assert!((shown(&mut studio).1 - 0.75).abs() < 0.02);
    studio
        .scene
        .set_world_pose(parent, Pose::translation(0.0, 0.0, 2.0))
        .unwrap();
    assert!((shown(&mut studio).1 - 1.75).abs() < 0.02);
    let hide = |object: &mut scene::Object| object.layer = object.layer.hidden();
    studio.scene.modify(parent, Field::Layer, hide).unwrap();
    assert_eq!(shown(&mut studio).0, 0.0);
}

#[test]
fn sensors_see_drawings_that_are_paint_and_views_all() {
    let mut studio = studio();
    let mut plain = style(DrawingKind::SpherePoints, DrawingFlags::empty());
    plain.flags = DrawingFlags::empty();
    draw(&mut studio, plain, &[0.0, 0.0, 1.0]);
    assert_eq!(shown(&mut studio).0, 0.0);
    let camera = studio
        .scene
        .add("camera", Kind::Camera(Box::default()))
        .unwrap();
    assert_eq!(first_camera(&studio.scene), Some(camera));
    let picture = studio
        .vision
        .view(&studio.scene, Some(camera), Some([9, 9]), Channels::ALL)
        .unwrap();
    assert!(is_red(&picture.colour[120..123]) && picture.ids[40] == Picture::NOTHING);
}

#[test]
fn items_have_colours_of_their_own() {
    let mut studio = studio();
    let corners = [-0.5, -0.5, 1.0, 0.5, -0.5, 1.0, 0.0, 0.5, 1.0];
    let colours = [0.0, 0.5, 0.25, 0.0, 0.5, 0.5, 0.0, 0.5, 0.75];
    let numbers = [&corners[..], &colours].concat();
    let flags = DrawingFlags::VERTEX_COLOURS;
    draw(&mut studio, style(DrawingKind::Triangles, flags), &numbers);
    let picture = studio.picture();
    let at = 3 * (SIDE / 2 * SIDE + SIDE / 2);
    // The mean of those of the corners.
    assert_eq!(picture.colour[at..at + 3], [0, 128, 128]);
}

#[test]
fn translucent_items_let_light_through() {
    let mut studio = studio();
    studio.cube(2.0);
    let flags = DrawingFlags::TRANSPARENT_50;
    let colour = Colour {
        emission: [0.0, 0.0, 1.0],
        ..Colour::new([0.0; 3])
    };
    let style = DrawingStyle {
        colour,
        ..style(DrawingKind::QuadPoints, flags)
    };
    draw(&mut studio, style, &[0.0, 0.0, 1.0, 0.0, 0.0, -1.0]);
    let picture = studio.picture();
    let at = 3 * (SIDE / 2 * SIDE + SIDE / 2);
    let [red, green, blue] = [0, 1, 2].map(|i| picture.colour[at + i]);
    assert!(
        red.abs_diff(128) < 3 && green == 0 && blue.abs_diff(128) < 3,
        "{red} {green} {blue}"
    );
}

/// An empty cloud of which that part is shown.
pub(super) fn cloud(display_fraction: f64) -> PointCloud {
    PointCloud {
        max_cell_size: 0.5,
        max_points_in_cell: 4,
        point_size: 1,
        uses_octree: true,
        display_fraction,
        random_colours: false,
        points: CloudPoints::default(),
    }
}

#[test]
fn a_cloud_shows_a_part_of_its_points() {
    let point = |at: usize| CloudPoint {
        position: [0.04 * at as f64 - 0.3, 0.0, 1.0],
        colour: [255, 0, 0],
    };
    for (fraction, shown_points) in [(1.0, 16), (0.5, 8), (0.25, 4), (0.0, 0), (7.0, 16)] {
        let mut studio = studio();
        studio
            .scene
            .modify_settings(|settings| settings.environment.ambient_light = [1.0; 3]);
        let mut cloud = cloud(fraction);
        cloud.insert((0..16).map(point), 0.0);
        let cloud = Kind::PointCloud(Box::new(cloud));
        let cloud = studio.scene.add("cloud", cloud).unwrap();
        let picture = studio.picture();
        let seen = picture.ids.iter().filter(|id| **id == cloud.0).count();
        assert_eq!(seen, shown_points, "{fraction}");
    }
}
