//! Joints as scripts make and set them (spec: joints 1 to 7).

mod dependent;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{UnitQuaternion, Vector3};

use super::*;
use crate::parameters::engine::Engine;
use crate::{Kind, Scene, SceneError};

const TYPES: [JointType; 3] = [
    JointType::Revolute,
    JointType::Prismatic,
    JointType::Spherical,
];

fn joint(joint_type: JointType, mode: JointMode) -> Joint {
    Joint::new(joint_type, mode)
}

fn kinematic(joint_type: JointType) -> Joint {
    joint(joint_type, JointMode::Kinematic)
}

fn added(scene: &mut Scene, joint: Joint) -> Handle {
    scene.add("j", Kind::Joint(Box::new(joint))).unwrap()
}

fn read(scene: &Scene, handle: Handle) -> &Joint {
    scene.object(handle).unwrap().joint().unwrap()
}

#[test]
fn numbers_of_scripts_name_types_modes_and_ways_of_control() {
    assert_eq!([10, 11, 12].map(JointType::from_code), TYPES.map(Some));
    assert_eq!([9, 13, -1].map(JointType::from_code), [None; 3]);
    let modes = [0, 2, 3, 4, 5].map(JointMode::from_code);
    use JointMode::{Dependent, Dynamic, InverseKinematics, Kinematic};
    assert_eq!(
        modes,
        [Kinematic, InverseKinematics, Kinematic, Dependent, Dynamic].map(Some)
    );
    assert_eq!([-1, 1, 6].map(JointMode::from_code), [None; 3]);
    let ways = [0, 1, 4, 8, 12, 16].map(Control::from_code);
    use Control::{Callback, Force, Free, Position, Spring, Velocity};
    assert_eq!(
        ways,
        [Free, Force, Velocity, Position, Spring, Callback].map(Some)
    );
    assert_eq!([2, 9, 13].map(Control::from_code), [None; 3]);
    assert!(Callback.calls_script() && !Position.calls_script() && !Free.calls_script());
    let aliases = TYPES.map(JointType::alias);
    assert_eq!(
        aliases,
        ["Revolute_joint", "Prismatic_joint", "Spherical_joint"]
    );
    for solver in [JointSolver::Exact, JointSolver::Impulse] {
        assert_eq!(JointSolver::from_word(solver.word()), Some(solver));
    }
    assert_eq!(JointSolver::Exact.word(), "exact");
    assert_eq!(JointSolver::from_word("fast"), None);
}

#[test]
fn new_joints_are_as_the_specification_says() {
    let facts = TYPES.map(kinematic).map(|joint| {
        let limits = [joint.max_vel, joint.max_accel, joint.max_jerk];
        (
            joint.cyclic,
            [joint.min, joint.range],
            joint.target_force,
            limits,
        )
    });
    assert_eq!(facts[0], (true, [-PI, TAU], 2.5, [TAU; 3]));
    assert_eq!(facts[1], (false, [-0.5, 1.0], 50.0, [1.0; 3]));
    assert_eq!((facts[2].0, facts[2].1, facts[2].2), (true, [0.0, PI], 0.0));
    let joint = kinematic(JointType::Prismatic);
    assert_eq!((joint.control, joint.spring), (Control::Free, [0.1, 0.0]));
    for engine in Engine::ALL {
        assert_eq!(joint.gains_with(engine), [0.1, 0.0, 0.0]);
    }
    assert_eq!(joint.max(), 0.5);
    assert_eq!(
        TYPES.map(kinematic).map(|joint| joint.is_revolute()),
        [true, false, false]
    );
}

#[test]
fn the_moving_side_turns_about_z_and_moves_along_it() {
    let screw = Joint {
        position: FRAC_PI_2,
        screw_lead: 0.4,
        ..kinematic(JointType::Revolute)
    };
    let pose = screw.ideal_pose();
    assert!((pose.translation.vector - Vector3::new(0.0, 0.0, 0.1)).norm() < 1e-15);
    assert!(
        (pose * nalgebra::Point3::new(1.0, 0.0, 0.0) - nalgebra::Point3::new(0.0, 1.0, 0.1)).norm()
            < 1e-15
    );
    let slider = Joint {
        position: -0.2,
        ..kinematic(JointType::Prismatic)
    };
    assert_eq!(slider.ideal_pose(), Pose::translation(0.0, 0.0, -0.2));
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.1, 0.2, 0.3));
    let ball = Joint {
        spherical: rotation,
        error: Some(Pose::translation(0.01, 0.0, 0.0)),
        ..kinematic(JointType::Spherical)
    };
    assert_eq!(ball.ideal_pose().rotation, rotation);
    assert_eq!(
        ball.intrinsic_pose(),
        ball.ideal_pose() * Pose::translation(0.01, 0.0, 0.0)
    );
    assert_eq!(slider.intrinsic_pose(), slider.ideal_pose());
}

#[test]
fn positions_are_wrapped_or_limited() {
    let mut scene = Scene::new();
    let (hinge, slider) = (
        added(&mut scene, kinematic(JointType::Revolute)),
        added(&mut scene, kinematic(JointType::Prismatic)),
    );
    for (handle, asked, set) in [
        (hinge, PI + 0.5, 0.5 - PI),
        (hinge, -PI, -PI),
        (hinge, 1.0, 1.0),
        (slider, 7.0, 0.5),
        (slider, -7.0, -0.5),
        (slider, 0.25, 0.25),
    ] {
        assert_eq!(scene.set_joint_position(handle, asked), Ok(true));
        let found = read(&scene, handle).position;
        assert!((found - set).abs() < 1e-12, "{found} is not {set}");
    }
    assert_eq!(
        scene.set_joint_position(hinge, f64::NAN),
        Err(SceneError::InvalidData)
    );
    let ball = added(&mut scene, kinematic(JointType::Spherical));
    assert_eq!(
        scene.set_joint_position(ball, 0.1),
        Err(SceneError::SphericalJoint)
    );
    assert_eq!(
        scene.set_joint_target_position(ball, 0.1, &[]),
        Err(SceneError::SphericalJoint)
    );
    assert_eq!(
        scene.set_joint_target_velocity(ball, 0.1, &[], None),
        Err(SceneError::SphericalJoint)
    );
}

#[test]
fn a_new_interval_limits_the_position_and_ends_what_has_no_meaning_without_limits() {
    let mut scene = Scene::new();
    let handle = added(&mut scene, kinematic(JointType::Revolute));
    scene.set_joint_position(handle, 2.0).unwrap();
    scene.set_joint_interval(handle, false, [0.5, 1.0]).unwrap();
    assert_eq!(read(&scene, handle).position, 1.5);
    scene
        .modify_joint(handle, |joint| joint.set_screw_lead(0.3))
        .unwrap();
    assert_eq!(read(&scene, handle).screw_lead, 0.3);
    scene.set_joint_interval(handle, false, [0.0, 2.0]).unwrap();
    assert_eq!(read(&scene, handle).screw_lead, 0.3);
    scene.set_joint_interval(handle, true, [0.5, 1.0]).unwrap();
    assert_eq!(read(&scene, handle).screw_lead, 0.0);
    assert!(
        scene
            .set_joint_interval(handle, false, [f64::NAN, 1.0])
            .is_err()
    );
}

#[test]
fn intervals_and_leads_are_kept_within_what_is_possible() {
    let interval = |joint_type, min, range| {
        let mut joint = kinematic(joint_type);
        joint.set_interval(false, min, range);
        [joint.min, joint.range]
    };
    let widest = 1e7_f64.to_radians();
    assert_eq!(interval(JointType::Revolute, -1e9, 1e9), [-1e5, widest]);
    assert_eq!(
        interval(JointType::Revolute, 1e9, 0.0),
        [1e5, 0.001_f64.to_radians()]
    );
    assert_eq!(interval(JointType::Prismatic, -1e9, 1e9), [-1e3, 1e3]);
    assert_eq!(interval(JointType::Prismatic, 1e9, -1.0), [1e3, 0.0]);
    let lead = |mode, cyclic, joint_type| {
        let mut joint = joint(joint_type, mode);
        joint.cyclic = cyclic;
        joint.set_screw_lead(-1e9);
        joint.screw_lead
    };
    use JointMode::{Dynamic, Kinematic};
    assert_eq!(lead(Kinematic, false, JointType::Revolute), -20.0 * PI);
    assert_eq!(lead(Kinematic, true, JointType::Revolute), 0.0);
    assert_eq!(lead(Dynamic, false, JointType::Revolute), 0.0);
    assert_eq!(lead(Kinematic, false, JointType::Prismatic), 0.0);
}

#[test]
fn a_mode_has_its_consequences() {
    let mut scene = Scene::new();
    let [master, handle] = [(); 2].map(|()| {
        added(
            &mut scene,
            joint(JointType::Prismatic, JointMode::Dependent),
        )
    });
    scene
        .set_joint_dependency(handle, Some(master), 2.0, 1.0)
        .unwrap();
    assert_eq!(read(&scene, handle).position, 2.0);
    scene
        .modify_joint(handle, |joint| joint.control = Control::Spring)
        .unwrap();
    scene.set_joint_mode(handle, JointMode::Dynamic).unwrap();
    let found = read(&scene, handle);
    // It is limited as soon as nothing leads it.
    assert_eq!((found.dependency, found.position), (None, 0.5));
    assert_eq!(
        (found.target_position, found.target_velocity),
        (2.0, 1000.0)
    );
    scene.set_joint_mode(handle, JointMode::Dependent).unwrap();
    assert_eq!(read(&scene, handle).control, Control::Free);
    let mut ball = kinematic(JointType::Spherical);
    ball.set_mode(JointMode::Dependent);
    assert_eq!(ball.mode, JointMode::Kinematic);
    let mut moving = Joint {
        hybrid: true,
        motion: Some(JointMotion::ToPosition),
        error: Some(Pose::identity()),
        ..kinematic(JointType::Prismatic)
    };
    moving.set_mode(JointMode::Kinematic);
    assert!(!moving.hybrid && moving.motion.is_none() && moving.error.is_none());
}

#[test]
fn a_way_of_control_has_its_target_velocity() {
    let velocity = |joint_type, control| {
        let mut joint = joint(joint_type, JointMode::Dynamic);
        joint.target_velocity = 0.7;
        joint.set_control(control);
        assert_eq!(joint.control, control);
        joint.target_velocity
    };
    assert_eq!(velocity(JointType::Revolute, Control::Velocity), FRAC_PI_2);
    assert_eq!(velocity(JointType::Prismatic, Control::Velocity), 0.1);
    assert_eq!(velocity(JointType::Prismatic, Control::Force), 1000.0);
    assert_eq!(velocity(JointType::Prismatic, Control::Spring), 1000.0);
    assert_eq!(velocity(JointType::Prismatic, Control::Position), 0.7);
    assert_eq!(velocity(JointType::Prismatic, Control::Free), 0.7);
}

/// Columns: target velocity before, force asked for, whether with a sign; then velocity and force.
#[test]
fn forces_and_velocities_agree_in_their_signs() {
    for (before, force, signed, velocity, stored) in [
        (1.0, -5.0, true, -1.0, -5.0),
        (-1.0, -5.0, true, -1.0, -5.0),
        (0.0, -5.0, true, 0.0, -5.0),
        (1.0, 5.0, true, 1.0, 5.0),
        (-1.0, 5.0, false, -1.0, -5.0),
        (1.0, -5.0, false, 1.0, 0.0),
        (0.0, 5.0, false, 0.0, 5.0),
    ] {
        let mut joint = Joint {
            target_velocity: before,
            ..kinematic(JointType::Prismatic)
        };
        joint.set_target_force(force, signed);
        assert_eq!(
            (joint.target_velocity, joint.target_force),
            (velocity, stored),
            "{before} {force}"
        );
    }
    let mut joint = Joint {
        target_force: 5.0,
        ..kinematic(JointType::Prismatic)
    };
    for (velocity, force) in [(-1.0, -5.0), (0.0, -5.0), (-2.0, -5.0), (1.0, 5.0)] {
        joint.set_target_velocity(velocity);
        assert_eq!(
            (joint.target_velocity, joint.target_force),
            (velocity, force)
        );
    }
    let mut ball = kinematic(JointType::Spherical);
    ball.set_target_force(5.0, true);
    assert_eq!(ball.target_force, 0.0);
}

#[test]
fn targets_are_wrapped_and_bring_their_limits() {
    let mut scene = Scene::new();
    let handle = added(&mut scene, kinematic(JointType::Revolute));
    scene
        .set_joint_target_position(handle, PI + 0.5, &[0.1, 0.2])
        .unwrap();
    let found = read(&scene, handle);
    assert!((found.target_position - (0.5 - PI)).abs() < 1e-12);
    assert_eq!(
        [found.max_vel, found.max_accel, found.max_jerk],
        [0.1, 0.2, TAU]
    );
    assert_eq!(found.motion, Some(JointMotion::ToPosition));
    assert!(
        scene
            .set_joint_target_position(handle, f64::NAN, &[])
            .is_err()
    );
    assert!(
        scene
            .set_joint_target_position(handle, 0.0, &[f64::INFINITY])
            .is_err()
    );
    assert!(
        scene
            .set_joint_target_velocity(handle, 0.0, &[f64::NAN], None)
            .is_err()
    );
    assert!(
        scene
            .set_joint_target_velocity(handle, f64::NAN, &[], None)
            .is_err()
    );
    let slider = added(&mut scene, joint(JointType::Prismatic, JointMode::Dynamic));
    scene.set_joint_target_position(slider, 3.0, &[]).unwrap();
    assert_eq!(
        (
            read(&scene, slider).target_position,
            read(&scene, slider).motion
        ),
        (3.0, None)
    );
    // A motor keeps its limits.
    scene
        .set_joint_target_velocity(slider, 0.3, &[0.1, 0.2], Some(0.1))
        .unwrap();
    let found = read(&scene, slider);
    assert_eq!(
        (
            found.target_velocity,
            found.max_accel,
            found.max_jerk,
            found.motion
        ),
        (0.3, 1.0, 1.0, None)
    );
}

#[test]
fn a_new_motion_begins_at_rest_unless_one_is_in_progress() {
    let mut scene = Scene::new();
    let handle = added(&mut scene, kinematic(JointType::Prismatic));
    scene
        .modify_joint(handle, |joint| (joint.velocity, joint.accel) = (0.3, 0.2))
        .unwrap();
    scene.set_joint_target_position(handle, 0.2, &[]).unwrap();
    assert_eq!(
        (read(&scene, handle).velocity, read(&scene, handle).accel),
        (0.0, 0.0)
    );
    scene
        .modify_joint(handle, |joint| (joint.velocity, joint.accel) = (0.3, 0.2))
        .unwrap();
    scene.set_joint_target_position(handle, 0.1, &[]).unwrap();
    assert_eq!(
        (read(&scene, handle).velocity, read(&scene, handle).accel),
        (0.3, 0.2)
    );
}
