//! Poses that are read and set in frames, and velocities that are measured (spec: poses 2 and 4).

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::placement::{Frame, Placement, is_valid_pose, normalized};
use crate::joint::{Joint, JointMode, JointType};
use crate::object::dummy::Dummy;
use crate::{Data, DynamicFlags, Handle, Kind, Pose, Scene, SceneError};

/// A slider at x = 1 that is turned about y by a right angle and out by 0.25, so that its moving side is at x = 1.25, and a dummy on it.
fn scene() -> (Scene, Handle, Handle) {
    let mut scene = Scene::new();
    let joint = Joint {
        position: 0.25,
        ..Joint::new(JointType::Prismatic, JointMode::Kinematic)
    };
    let slider = scene.add("j", Kind::Joint(Box::new(joint))).unwrap();
    let about_y = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), FRAC_PI_2);
    scene
        .set_local_pose(
            slider,
            Pose::from_parts(Translation3::new(1.0, 0.0, 0.0), about_y),
        )
        .unwrap();
    let tip = dummy(&mut scene);
    scene.set_parent(tip, Some(slider), false).unwrap();
    scene
        .set_local_pose(tip, Pose::translation(0.0, 0.5, 0.125))
        .unwrap();
    (scene, slider, tip)
}

fn dummy(scene: &mut Scene) -> Handle {
    scene.add("d", Kind::Dummy(Dummy::new(0.01))).unwrap()
}

#[track_caller]
fn is_at(pose: Pose, [x, y, z]: [f64; 3]) {
    let gap = pose.translation.vector - Vector3::new(x, y, z);
    assert!(
        gap.norm() < 1e-12,
        "{} is not {x} {y} {z}",
        pose.translation
    );
}

#[test]
fn frames_have_numbers() {
    let (scene, slider, _) = scene();
    let names = [
        (-1, Frame::World),
        (-11, Frame::Parent),
        (-14, Frame::Inverse),
        (slider.raw(), Frame::Object(slider)),
    ];
    for (number, frame) in names {
        assert_eq!(Frame::from_raw(number), Ok(frame));
        assert_eq!(Data::from(frame), Data::from(number));
    }
    assert_eq!(Frame::from_raw(-99), Err(SceneError::NoSuchObject));
    drop(scene);
}

#[test]
fn poses_are_read_in_any_frame() {
    let (scene, slider, tip) = scene();
    let read = |frame, base| scene.pose_in(tip, frame, base).unwrap();
    is_at(read(Frame::World, false), [1.375, 0.5, 0.0]);
    is_at(read(Frame::Parent, false), [0.0, 0.5, 0.125]);
    is_at(read(Frame::Object(slider), false), [0.0, 0.5, 0.125]);
    // From the side of the joint that does not move.
    is_at(read(Frame::Object(slider), true), [0.0, 0.5, 0.375]);
    is_at(
        read(Frame::Inverse, false) * read(Frame::World, false),
        [0.0; 3],
    );
    is_at(read(Frame::Object(tip), false), [0.0; 3]);
}

/// Also for an object that hangs on something else.
#[test]
fn a_joint_stands_for_its_moving_side() {
    let (mut scene, slider, _) = scene();
    let other = dummy(&mut scene);
    let place = scene.world_pose(slider).unwrap();
    scene.set_world_pose(other, place).unwrap();
    let seen = |base| scene.pose_in(other, Frame::Object(slider), base).unwrap();
    is_at(seen(false), [0.0, 0.0, -0.25]);
    is_at(seen(true), [0.0; 3]);
}

#[test]
fn poses_are_set_in_any_frame() {
    let (mut scene, slider, tip) = scene();
    let there = Pose::translation(0.1, 0.2, 0.3);
    for (frame, base) in [
        (Frame::World, false),
        (Frame::Parent, false),
        (Frame::Inverse, false),
        (Frame::Object(slider), false),
        (Frame::Object(slider), true),
    ] {
        scene
            .place(tip, Placement::Pose(there), frame, base)
            .unwrap();
        let found = scene.pose_in(tip, frame, base).unwrap();
        is_at(found, [0.1, 0.2, 0.3]);
        assert!(found.rotation.angle() < 1e-12, "{frame:?}");
    }
    scene
        .set_pose_in(tip, there, Frame::Inverse, false)
        .unwrap();
    is_at(scene.world_pose(tip).unwrap(), [-0.1, -0.2, -0.3]);
    scene
        .set_pose_in(tip, there, Frame::Object(slider), true)
        .unwrap();
    is_at(
        scene.pose_in(tip, Frame::Parent, false).unwrap(),
        [0.1, 0.2, 0.05],
    );
}

#[test]
fn a_position_keeps_the_orientation_and_the_reverse() {
    let (mut scene, _, tip) = scene();
    let before = scene.world_pose(tip).unwrap();
    scene
        .place(
            tip,
            Placement::Position(Vector3::new(3.0, 4.0, 5.0)),
            Frame::World,
            false,
        )
        .unwrap();
    let moved = scene.world_pose(tip).unwrap();
    is_at(moved, [3.0, 4.0, 5.0]);
    assert!(moved.rotation.angle_to(&before.rotation) < 1e-12);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.4);
    scene
        .place(tip, Placement::Rotation(turn), Frame::World, false)
        .unwrap();
    let turned = scene.world_pose(tip).unwrap();
    is_at(turned, [3.0, 4.0, 5.0]);
    assert!(turned.rotation.angle_to(&turn) < 1e-12);
    scene
        .place(tip, Placement::Rotation(turn), Frame::Inverse, false)
        .unwrap();
    assert!(
        scene
            .world_pose(tip)
            .unwrap()
            .rotation
            .angle_to(&turn.inverse())
            < 1e-12
    );
}

#[test]
fn what_the_physics_moves_is_reset_with_all_below_but_joints_take_it_along() {
    let (mut scene, slider, tip) = scene();
    let there = Placement::Position(Vector3::x());
    let is_reset = |scene: &mut Scene, moved, flag| {
        for handle in [slider, tip] {
            scene
                .modify(handle, crate::Field::Dynamics, |object| {
                    object.dynamics_reset = false;
                })
                .unwrap();
        }
        scene
            .modify(moved, crate::Field::Dynamics, |object| {
                object.dynamic_flag = flag;
            })
            .unwrap();
        scene.place(moved, there, Frame::World, false).unwrap();
        scene.object(tip).unwrap().dynamics_reset
    };
    assert!(is_reset(&mut scene, tip, DynamicFlags::DYNAMIC));
    assert!(is_reset(
        &mut scene,
        tip,
        DynamicFlags::DYNAMIC | DynamicFlags::RESPONDABLE
    ));
    assert!(!is_reset(&mut scene, tip, DynamicFlags::RESPONDABLE));
    assert!(!is_reset(&mut scene, tip, DynamicFlags::empty()));
    assert!(!is_reset(&mut scene, slider, DynamicFlags::JOINT));
    let base = dummy(&mut scene);
    scene.set_parent(slider, Some(base), true).unwrap();
    assert!(is_reset(&mut scene, base, DynamicFlags::DUMMY));
}

#[test]
fn only_spherical_joints_turn_their_moving_side() {
    let (mut scene, slider, tip) = scene();
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.4);
    assert_eq!(scene.set_spherical_rotation(slider, turn), Ok(false));
    assert_eq!(scene.set_spherical_rotation(tip, turn), Ok(false));
    let ball = Joint::new(JointType::Spherical, JointMode::Kinematic);
    let ball = scene.add("b", Kind::Joint(Box::new(ball))).unwrap();
    assert_eq!(scene.set_spherical_rotation(ball, turn), Ok(true));
    assert_eq!(scene.object(ball).unwrap().joint().unwrap().spherical, turn);
}

#[test]
fn poses_that_are_nowhere_are_refused() {
    let at = |x: f64, y: f64, z: f64| Pose::translation(x, y, z);
    assert!(is_valid_pose(&at(1e100, -1e100, 0.0)));
    for wrong in [
        at(2e100, 0.0, 0.0),
        at(0.0, -2e100, 0.0),
        at(0.0, 0.0, f64::NAN),
        at(f64::INFINITY, 0.0, 0.0),
    ] {
        assert!(!is_valid_pose(&wrong), "{wrong}");
    }
    let no_rotation =
        UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(f64::NAN, 0.0, 0.0, 0.0));
    assert!(!is_valid_pose(&Pose::from_parts(
        Translation3::identity(),
        no_rotation
    )));
    let (mut scene, slider, _) = scene();
    assert_eq!(
        scene.set_local_pose(slider, at(f64::NAN, 0.0, 0.0)),
        Err(SceneError::InvalidData)
    );
}

#[test]
fn quaternions_are_made_of_length_one_and_left_alone_where_they_are() {
    let of =
        |w: f64, x: f64| UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(w, x, 0.0, 0.0));
    let normal =
        |rotation| normalized(Pose::from_parts(Translation3::new(1.0, 2.0, 3.0), rotation));
    let long = normal(of(3.0, 4.0));
    assert!((long.rotation.w - 0.6).abs() < 1e-15 && (long.rotation.i - 0.8).abs() < 1e-15);
    is_at(long, [1.0, 2.0, 3.0]);
    let nearly = of(1.0 + 1e-14, 0.0);
    assert_eq!(normal(nearly).rotation.w.to_bits(), nearly.w.to_bits());
    assert!((normal(of(1.0 + 1e-12, 0.0)).rotation.norm() - 1.0).abs() < 1e-15);
    assert_eq!(normal(of(0.0, 0.0)).rotation.norm(), 0.0);
}

/// Linear: way over time. Angular: angle about the axis of the world over time.
#[test]
fn velocities_are_measured_from_one_step_to_the_next() {
    let (mut scene, slider, tip) = scene();
    scene.measure_velocities(None);
    // From here on only what moves is looked at.
    scene.measure_velocities(Some(0.1));
    scene.measure_velocities(Some(0.1));
    let measured = |scene: &Scene, handle| scene.object(handle).unwrap().measured.clone();
    assert_eq!(measured(&scene, tip).linear(), [0.0; 3]);
    scene.set_joint_position(slider, 0.3).unwrap();
    scene.measure_velocities(Some(0.1));
    let close = |found: [f64; 3], expected: [f64; 3]| {
        assert!(
            (Vector3::from(found) - Vector3::from(expected)).norm() < 1e-9,
            "{found:?} is not {expected:?}"
        );
    };
    close(measured(&scene, tip).linear(), [0.5, 0.0, 0.0]);
    close(measured(&scene, slider).linear(), [0.0; 3]);
    assert_eq!(measured(&scene, tip).angular(), [0.0; 3]);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.02);
    let before = scene.world_pose(tip).unwrap();
    scene
        .set_world_pose(
            tip,
            Pose::from_parts(before.translation, turn * before.rotation),
        )
        .unwrap();
    scene.measure_velocities(Some(0.1));
    close(measured(&scene, tip).angular(), [0.0, 0.0, 0.2]);
    close(measured(&scene, tip).linear(), [0.0; 3]);
    // It rests.
    scene.measure_velocities(Some(0.1));
    assert_eq!(
        (
            measured(&scene, tip).angular(),
            measured(&scene, tip).euler_rate()
        ),
        ([0.0; 3], [0.0; 3])
    );
}
