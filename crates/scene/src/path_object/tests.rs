//! Lengths, places, orientations and motion along paths.

use std::f64::consts::FRAC_PI_2;

use super::*;
use crate::object::dummy::Dummy;
use crate::{Kind, Scene};

fn at(x: f64, y: f64, count: usize) -> ControlPoint {
    let pose = Pose::translation(x, y, 0.0);
    ControlPoint {
        pose,
        before: 0.5,
        after: 0.5,
        count,
        velocity: 1.0,
        on_spot: 0.0,
        flags: 0,
        channels: [0.0; 4],
    }
}

fn path(attributes: i32, points: Vec<ControlPoint>) -> PathObject {
    let attributes = PathAttributes::from_bits_retain(attributes);
    let mut path = PathObject::new(attributes, PathMeasures::default());
    path.insert(0, points, attributes.contains(PathAttributes::CLOSED))
        .expect("they are few");
    path
}

fn square(attributes: i32) -> PathObject {
    path(
        attributes | 4,
        vec![
            at(0.0, 0.0, 1),
            at(1.0, 0.0, 1),
            at(1.0, 1.0, 1),
            at(0.0, 1.0, 1),
        ],
    )
}

fn place(path: &PathObject, position: f64) -> [f64; 2] {
    let point = path.at(position).expect("it has points").pose.translation;
    [point.x, point.y]
}

#[test]
fn a_closed_path_wraps() {
    let mut path = square(0);
    assert_eq!(path.length(), 4.0);
    path.set_position(4.25);
    assert_eq!((path.position(), place(&path, 0.25)), (0.25, [0.25, 0.0]));
    assert_eq!(place(&path, 0.5 * path.length()), [1.0, 1.0]);
    assert_eq!(place(&path, 3.5), [0.0, 0.5]);
    assert_eq!(
        path.closest_position(&nalgebra::Vector3::new(-1.0, 0.5, 0.0)),
        Some(3.5)
    );
}

#[test]
fn an_open_path_ends() {
    let mut path = path(0, vec![at(0.0, 0.0, 1), at(2.0, 0.0, 1)]);
    path.set_position(9.0);
    assert_eq!(path.position(), 2.0);
    path.cut(0, usize::MAX);
    assert_eq!(
        (path.position(), path.length(), path.at(0.0)),
        (0.0, 0.0, None)
    );
}

#[test]
fn too_few_points_cannot_be_closed() {
    let path = path(4, vec![at(0.0, 0.0, 1), at(2.0, 0.0, 1)]);
    assert!(!path.is_closed() && !path.attributes().contains(PathAttributes::CLOSED));
}

#[test]
fn corners_are_rounded_between_the_middles_of_their_ways() {
    let path = path(0, vec![at(0.0, 0.0, 1), at(2.0, 0.0, 3), at(2.0, 2.0, 1)]);
    let places: Vec<[f64; 2]> = path
        .line
        .iter()
        .map(|p| [p.pose.translation.x, p.pose.translation.y])
        .collect();
    assert_eq!(
        places,
        [
            [0.0, 0.0],
            [1.5, 0.0],
            [1.875, 0.125],
            [2.0, 0.5],
            [2.0, 2.0]
        ]
    );
}

#[test]
fn straight_corners_stay() {
    let path = path(0, vec![at(0.0, 0.0, 9), at(1.0, 0.0, 9), at(3.0, 0.0, 9)]);
    assert_eq!(path.line.len(), 3);
}

#[test]
fn orientation_is_along_the_path() {
    let straight = path(0x8, vec![at(0.0, 0.0, 1), at(2.0, 0.0, 1)]);
    let axes = straight.line[0].pose.rotation.to_rotation_matrix();
    assert!((axes * nalgebra::Vector3::z() - nalgebra::Vector3::x()).norm() < 1e-12);
    assert!((axes * nalgebra::Vector3::y() - nalgebra::Vector3::z()).norm() < 1e-12);
    let bent = square(0x8);
    let axes = bent.line[1].pose.rotation.to_rotation_matrix();
    assert!((axes * nalgebra::Vector3::x() - nalgebra::Vector3::z()).norm() < 1e-12);
    let along = axes * nalgebra::Vector3::z();
    assert!((along.angle(&nalgebra::Vector3::x()) - FRAC_PI_2 / 2.0).abs() < 1e-12);
}

#[test]
fn a_path_moves_at_its_target_velocity() {
    let mut path = path(0x20, vec![at(0.0, 0.0, 1), at(0.11, 0.0, 1)]);
    path.set_target_velocity(0.5);
    let places: Vec<f64> = (0..6)
        .map(|_| {
            path.advance(0.05);
            (path.position() * 1000.0).round()
        })
        .collect();
    assert_eq!(places, [25.0, 50.0, 75.0, 100.0, 110.0, 110.0]);
}

#[test]
fn two_points_at_rest_do_not_move() {
    let mut path = path(0x4ab, vec![at(0.0, 0.0, 1), at(2.0, 0.0, 1)]);
    path.set_target_velocity(0.5);
    path.advance(1.0);
    assert_eq!(path.position(), 0.0);
}

#[test]
fn velocities_turn_at_the_ends() {
    let mut path = path(0x30, vec![at(0.0, 0.0, 1), at(1.0, 0.0, 1)]);
    path.set_target_velocity(1.0);
    path.advance(1.25);
    assert!((path.position() - 0.75).abs() < 1e-12);
    assert_eq!(path.target_velocity, -1.0);
}

#[test]
fn a_closed_path_goes_round_in_both_directions() {
    for (velocity, expected) in [(1.0, 0.5), (-1.0, 3.5)] {
        let mut path = square(0x20);
        path.set_target_velocity(velocity);
        path.advance(4.5);
        assert!((path.position() - expected).abs() < 1e-9, "{velocity}");
    }
}

#[test]
fn the_acceleration_between_two_points_is_constant() {
    let slow = ControlPoint {
        velocity: 0.0,
        ..at(0.0, 0.0, 1)
    };
    let mut path = path(0x20, vec![slow, at(1.0, 0.0, 1), at(2.0, 0.0, 1)]);
    path.set_target_velocity(1.0);
    path.advance(1.0);
    assert!((path.position() - 0.25).abs() < 1e-12);
    path.advance(1.0);
    assert!((path.position() - 1.0).abs() < 1e-9);
}

#[test]
fn an_acceleration_is_limited() {
    let mut path = path(0, vec![at(0.0, 0.0, 1), at(1.0, 0.0, 1)]);
    path.max_acceleration = 1.0;
    path.set_target_velocity(0.1);
    let velocities: Vec<f64> = (0..3)
        .map(|_| {
            path.advance(0.05);
            path.nominal_velocity
        })
        .collect();
    assert_eq!(velocities, [0.05, 0.1, 0.1]);
    assert!((path.position() - 0.0075).abs() < 1e-12);
}

#[test]
fn bends_limit_the_velocity() {
    let corners = [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1]];
    let path = path(0x124, corners.map(|[x, y]| at(x, y, 1)).to_vec());
    let in_bend = 0.1 / FRAC_PI_2 / (2.0 * path.profile.radius);
    assert!(
        path.velocities
            .iter()
            .all(|velocity| (velocity - in_bend).abs() < 1e-9)
    );
}

#[test]
fn a_profile_keeps_to_its_acceleration() {
    let path = path(
        0x500,
        vec![at(0.0, 0.0, 1), at(1.0, 0.0, 1), at(9.0, 0.0, 1)],
    );
    let reached = (2.0 * path.profile.acceleration).sqrt();
    assert_eq!(path.velocities, [0.0, reached, 0.0]);
}

#[test]
fn scaling_keeps_the_place_on_the_path() {
    let mut path = square(0);
    path.set_position(1.5);
    path.scale(2.0);
    assert_eq!(
        (path.length(), path.position(), place(&path, 3.0)),
        (8.0, 3.0, [2.0, 1.0])
    );
}

#[test]
fn dummies_move_along_their_path() {
    let mut scene = Scene::new();
    let path = path(0, vec![at(0.0, 0.0, 1), at(2.0, 0.0, 1)]);
    let path = scene
        .add("path", Kind::Path(Box::new(path)))
        .expect("there is room");
    let starts = [(2, [0.0; 3]), (6, [0.75, 1.0, 0.0]), (0, [0.0, 9.0, 0.0])];
    let dummies = starts.map(|(bits, [x, y, z])| {
        let path_following = PathFollowing {
            bits,
            offsets: [0.25; 2],
        };
        let dummy = Kind::Dummy(Dummy {
            path_following,
            ..Dummy::new(0.01)
        });
        let handle = scene.add("pad", dummy).expect("there is room");
        scene
            .set_parent(handle, Some(path), true)
            .expect("both exist");
        scene
            .set_local_pose(handle, Pose::translation(x, y, z))
            .expect("it exists");
        handle
    });
    scene.set_path_position(path, 1.0).expect("it is a path");
    let places = dummies.map(|dummy| -> [f64; 3] {
        scene
            .object(dummy)
            .expect("it exists")
            .pose()
            .translation
            .vector
            .into()
    });
    assert_eq!(
        places,
        [[1.25, 0.0, 0.0], [0.75, 0.0, 0.0], [0.0, 9.0, 0.0]]
    );
}

#[test]
fn a_run_restores_the_motion() {
    let mut scene = Scene::new();
    let mut line = path(0x20, vec![at(0.0, 0.0, 1), at(2.0, 0.0, 1)]);
    line.set_motion(0.5, 0.1, 0.3, 1.0);
    let handle = scene
        .add("path", Kind::Path(Box::new(line)))
        .expect("there is room");
    let motion = |scene: &Scene| {
        scene
            .object(handle)
            .and_then(|object| object.path())
            .expect("it is a path")
            .motion()
    };
    scene.store_initial_state();
    assert_eq!(motion(&scene), [0.5, 0.0, 1.0]);
    scene.handle_path(handle, 0.5).expect("it is a path");
    assert_eq!(motion(&scene), [1.0, 1.0, 1.0]);
    scene.reset_path(handle).expect("it is a path");
    assert_eq!(motion(&scene), [0.5, 0.3, 1.0]);
    scene.handle_path(handle, 0.5).expect("it is a path");
    scene.restore_initial_state();
    assert_eq!(motion(&scene), [0.5, 0.3, 1.0]);
}
