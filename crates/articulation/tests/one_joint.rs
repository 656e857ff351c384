//! One body on one joint: gravity along any direction, contacts with a floor, by the formulas of mechanics.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod rig;

use articulation::*;
use nalgebra::Vector3;
use rig::*;
use test_support::random::Random;

#[test]
fn a_slider_falls_along_any_gravity() {
    let mut random = Random::new(1);
    for _ in 0..20 {
        let (axis, gravity) = (
            Vector3::from(random.vector()).normalize(),
            10.0 * Vector3::from(random.vector()),
        );
        let mut rig = rig(JointKind::Prismatic, axis, 0.0, Vector3::zeros());
        rig.begin(gravity);
        let (linear, angular) = rig.velocity();
        close(linear, axis * axis.dot(&gravity) * STEP);
        close(angular, Vector3::zeros());
    }
}

#[test]
fn a_pendulum_falls_along_any_gravity() {
    let mut random = Random::new(2);
    for _ in 0..20 {
        let axis = Vector3::from(random.vector()).normalize();
        let (gravity, com) = (
            10.0 * Vector3::from(random.vector()),
            Vector3::from(random.vector()),
        );
        let mut rig = rig(JointKind::Revolute, axis, 0.0, com);
        rig.begin(gravity);
        let (linear, angular) = rig.velocity();
        let torque = com.cross(&(MASS * gravity)).dot(&axis);
        let lever = axis.cross(&com).norm_squared();
        let turn = axis * torque / (INERTIA + MASS * lever) * STEP;
        close(angular, turn);
        close(linear, turn.cross(&com));
    }
}

#[test]
fn a_screw_falls_as_slowly_as_its_pitch_makes_it_turn() {
    let (pitch, gravity) = (0.2, Vector3::new(-3.0, 4.0, 0.0));
    let axis = gravity.normalize();
    let mut rig = rig(JointKind::Revolute, axis, pitch, Vector3::zeros());
    rig.begin(gravity);
    let (linear, angular) = rig.velocity();
    let fall = gravity / (1.0 + INERTIA / (MASS * pitch * pitch)) * STEP;
    close(linear, fall);
    close(angular, fall / pitch);
}

/// Velocity along z after the step of a body that touches a floor, with nothing but the contact that acts on it.
fn after_contact(velocity: f64, distance: f64, restitution: f64) -> f64 {
    let mut rig = rig(JointKind::Prismatic, Vector3::z(), 0.0, Vector3::zeros());
    rig.body.motion.velocity[2] = velocity;
    rig.joint.velocity = velocity;
    rig.begin(Vector3::zeros());
    rig.mechanism.set_contacts(&[Contact {
        distance,
        restitution,
        ..contact([Some(1), None], [0.0; 3], [0.0, 0.0, 1.0])
    }]);
    rig.velocity().0.z
}

#[test]
fn a_fast_contact_rebounds_by_its_restitution_and_a_slow_one_does_not() {
    for (before, restitution, after) in [
        (-1.0, 0.5, 0.5),
        (-0.2, 0.25, 0.05),
        (-1.0, 0.0, 0.0),
        (-0.02, 0.5, 0.0),
        (-0.001, 1.0, 0.0),
        (1.0, 0.5, 1.0),
    ] {
        nearly(after_contact(before, 0.0, restitution), after);
    }
}

#[test]
fn a_body_before_a_floor_goes_no_farther_than_there() {
    nearly(after_contact(-1.0, 0.002, 0.0), -0.4);
    // It does not get there in this step, and does not bounce back yet.
    nearly(after_contact(-0.3, 0.002, 0.0), -0.3);
    nearly(after_contact(-0.3, 0.002, 1.0), -0.3);
}

#[test]
fn a_body_in_a_floor_is_moved_out_of_it_part_by_part() {
    // A fifth of the depth in each step, and never faster than 0.2 m/s.
    nearly(after_contact(0.0, -0.001, 0.0), 0.04);
    nearly(after_contact(-1.0, -0.001, 0.0), 0.04);
    nearly(after_contact(0.0, -0.5, 0.0), 0.2);
}

/// The mechanism exerts what the joint has to: here it bears the weight, and nothing acts on the base.
#[test]
fn an_engine_is_told_what_the_joints_exert() {
    let gravity = Vector3::new(0.0, 0.0, -9.81);
    let mut rig = rig(JointKind::Prismatic, Vector3::x(), 0.0, Vector3::zeros());
    rig.begin(gravity);
    assert!(rig.mechanism.solve());
    let loads = rig.mechanism.body_loads();
    assert!(loads.len() == 2 && loads[0].is_none());
    let (force, torque) = halves(&loads[1].unwrap());
    close(force, -MASS * gravity);
    close(torque, Vector3::zeros());
    let rows = rig.mechanism.joint_loads().next().unwrap().rows;
    nearly(rows.fixed_rows::<3>(0).norm(), MASS * 9.81);
}

#[test]
fn expected_impulses_push_at_their_points() {
    let (impulse, point) = ([0.0, 0.0, 0.5], [0.3, 0.0, 0.0]);
    let mut hinge = rig(JointKind::Revolute, Vector3::y(), 0.0, Vector3::zeros());
    hinge.begin(Vector3::zeros());
    hinge.mechanism.add_impulse(1, impulse, point);
    // Torque about y: -0.3 * 0.5.
    close(hinge.velocity().1, Vector3::new(0.0, -0.15 / INERTIA, 0.0));
    let mut slider = rig(JointKind::Prismatic, Vector3::z(), 0.0, Vector3::zeros());
    slider.begin(Vector3::zeros());
    slider.mechanism.add_impulse(1, impulse, point);
    slider.mechanism.add_impulse(7, impulse, point);
    close(slider.velocity().0, Vector3::new(0.0, 0.0, 0.5 / MASS));
}

#[test]
fn the_torque_of_gyroscopes_is_that_of_the_engine() {
    let mut ball = rig(JointKind::Spherical, Vector3::z(), 0.0, Vector3::zeros());
    let (spin, turned) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(1.1, 1.8, 3.2));
    ball.body = moving(Vector3::zeros(), spin);
    ball.body.gyroscopic_velocity = turned;
    ball.begin(Vector3::zeros());
    close(ball.velocity().1, turned);
    let (_, torque) = halves(&ball.mechanism.body_loads()[1].unwrap());
    close(torque, (turned - spin) * INERTIA / STEP);
}

/// A base that is moved takes the body along.
#[test]
fn a_base_on_its_way_carries_the_body() {
    let mut rig = rig(JointKind::Fixed, Vector3::z(), 0.0, Vector3::x());
    let turn = Vector3::new(0.0, 0.0, 0.01);
    let target = geometry::Pose::new(Vector3::new(0.02, 0.0, 0.0), turn);
    let base = BodyState {
        target: Some(target),
        ..resting()
    };
    let (bodies, joints) = ([base, rig.body], [rig.joint]);
    rig.mechanism.begin(&bodies, &joints, [0.0; 3], STEP);
    let (linear, angular) = rig.velocity();
    close(angular, turn / STEP);
    close(linear, Vector3::new(0.02, 0.01, 0.0) / STEP);
}
