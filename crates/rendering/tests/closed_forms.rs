//! Comparison with closed forms: silhouettes, depths, directions, normals.

mod common;

use common::*;
use geometry::Pose;
use rendering::{Material, Picture, Projection};

#[test]
fn depth_is_linear_in_z() {
    let (wall, grey) = (rectangle(100.0, 100.0, 0.0), Material::new([0.5; 3]));
    for (z, expected) in [
        (5.0, 0.499_499_5),
        (1.0, 0.099_099_1),
        (0.01, 0.0),
        (10.0, 1.0),
    ] {
        let picture = render(
            &[at(instance(&wall, &grey, 3), 0.0, 0.0, z)],
            &camera(32, 32),
        );
        assert!(
            picture
                .depth
                .iter()
                .all(|depth| (depth - expected).abs() < 1e-7),
            "{z}: {}",
            picture.depth[0]
        );
    }
}

#[test]
fn depth_of_a_slanted_plane_is_exact_to_32_bits() {
    let (wall, grey) = (rectangle(400.0, 400.0, 0.0), Material::new([0.5; 3]));
    let mut wall = at(instance(&wall, &grey, 3), 0.1, -0.2, 3.0);
    wall.pose.rotation = nalgebra::UnitQuaternion::from_euler_angles(0.9, 0.6, 0.2);
    let (normal, camera) = (wall.pose.rotation * nalgebra::Vector3::z(), camera(64, 48));
    let picture = render(&[wall], &camera);
    let scale = 2.0 * 30f64.to_radians().tan() / 64.0;
    for (x, y) in (0..64).flat_map(|x| (0..48).map(move |y| (x, y))) {
        let ray = nalgebra::Vector3::new(
            -(f64::from(x) - 31.5) * scale,
            (f64::from(y) - 23.5) * scale,
            1.0,
        );
        let z = normal.dot(&wall.pose.translation.vector) / normal.dot(&ray);
        let expected = if (0.01..10.0).contains(&z) {
            (z - 0.01) / 9.99
        } else {
            1.0
        };
        let found = f64::from(depth_at(&picture, x, y));
        assert!(
            (found - expected).abs() <= 1e-7 * expected,
            "{x} {y}: {found} {expected}"
        );
    }
}

#[test]
fn x_is_in_the_left_half_and_y_in_the_last_rows() {
    let (cube, grey) = (cuboid([0.2; 3]), Material::new([0.5; 3]));
    let (left, above) = (
        at(instance(&cube, &grey, 1), 0.5, 0.0, 2.0),
        at(instance(&cube, &grey, 2), 0.0, 0.5, 2.0),
    );
    let picture = render(&[left, above], &camera(64, 64));
    for (x, y) in (0..64).flat_map(|x| (0..64).map(move |y| (x, y))) {
        match id_at(&picture, x, y) {
            1 => assert!(x < 32),
            2 => assert!(y >= 32),
            other => assert_eq!(other, Picture::NOTHING),
        }
    }
    assert!(count(&picture, 1) > 20 && count(&picture, 2) > 20);
}

#[test]
fn the_opening_is_that_of_the_larger_side() {
    // At depth 1 the half width is tan(30 degrees); the vertical opening is 32.204 degrees.
    let vertical = 2.0 * (32.204f64 / 2.0).to_radians().tan();
    let (wall, grey) = (
        rectangle(4.0, vertical - 1e-3, 1.0),
        Material::new([0.5; 3]),
    );
    let picture = render(&[instance(&wall, &grey, 1)], &camera(2560, 1280));
    assert_eq!(id_at(&picture, 0, 0), Picture::NOTHING);
    assert_eq!((id_at(&picture, 0, 2), id_at(&picture, 2559, 1277)), (1, 1));
}

#[test]
fn an_orthographic_ball_is_a_disc() {
    let (ball, grey) = (ball(0.4, 200), Material::new([0.5; 3]));
    let mut camera = camera(300, 200);
    camera.projection = Projection::Orthographic { size: 1.0 };
    let picture = render(&[at(instance(&ball, &grey, 7), 0.0, 0.0, 2.0)], &camera);
    let expected = std::f64::consts::PI * (0.4 * 300.0f64).powi(2);
    // The lower and upper part lie outside of the picture: segments of height 20 pixels.
    let (radius, height) = (120.0f64, 20.0);
    let segment = radius.powi(2) * ((radius - height) / radius).acos()
        - (radius - height) * (2.0 * radius * height - height * height).sqrt();
    let found = count(&picture, 7) as f64;
    assert!(
        (found - (expected - 2.0 * segment)).abs() < 60.0,
        "{found} {}",
        expected - 2.0 * segment
    );
    // The closest point, and its light.
    assert!((depth_at(&picture, 150, 100) - (1.6 - 0.01) / 9.99).abs() < 1e-4);
    assert!(colour_at(&picture, 150, 100)[0] >= 127);
}

#[test]
fn a_ball_in_perspective_is_seen_under_its_angle() {
    let (ball, grey) = (ball(0.5, 200), Material::new([0.5; 3]));
    let picture = render(
        &[at(instance(&ball, &grey, 7), 0.0, 0.0, 2.0)],
        &camera(400, 400),
    );
    // Rays that touch the ball: sin a = radius / distance.
    let radius = (0.5f64 / 2.0).asin().tan() / 30f64.to_radians().tan() * 200.0;
    let area = std::f64::consts::PI * radius * radius;
    assert!(
        (count(&picture, 7) as f64 - area).abs() < 0.005 * area,
        "{} {area}",
        count(&picture, 7)
    );
}

#[test]
fn light_goes_with_the_cosine_of_the_normal() {
    let (wall, white) = (
        rectangle(10.0, 10.0, 0.0),
        Material {
            specular: [0.0; 3],
            ..Material::new([1.0; 3])
        },
    );
    for degrees in [0.0f64, 30.0, -60.0] {
        let mut wall = at(instance(&wall, &white, 1), 0.0, 0.0, 3.0);
        wall.pose.rotation = Pose::rotation(nalgebra::Vector3::y() * degrees.to_radians()).rotation;
        let picture = render(&[wall], &camera(9, 9));
        let expected = (degrees.to_radians().cos() * 255.0).round() as u8;
        assert_eq!(colour_at(&picture, 4, 4), [expected; 3]);
    }
}
