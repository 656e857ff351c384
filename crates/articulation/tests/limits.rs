//! Motors and limits of one joint, in closed forms.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod rig;

use std::f64::consts::{PI, TAU};

use articulation::*;
use geometry::Pose;
use nalgebra::Vector3;
use rig::*;

/// A joint about or along z with its body in motion.
fn moved(kind: JointKind, position: f64, velocity: f64) -> Rig {
    let mut rig = rig(kind, Vector3::z(), 0.0, Vector3::zeros());
    rig.joint.limits = Some([-0.5, 1.0]);
    set(&mut rig, kind, position, velocity);
    rig
}

fn set(rig: &mut Rig, kind: JointKind, position: f64, velocity: f64) {
    let along = Vector3::z() * velocity;
    (rig.joint.position, rig.joint.velocity) = (position, velocity);
    rig.body = match kind {
        JointKind::Prismatic => moving(along, Vector3::zeros()),
        _ => moving(Vector3::zeros(), along),
    };
}

/// The velocity along the joint after a step without gravity.
fn after(rig: &mut Rig, kind: JointKind) -> f64 {
    rig.begin(Vector3::zeros());
    let (linear, angular) = rig.velocity();
    if kind == JointKind::Prismatic {
        linear.z
    } else {
        angular.z
    }
}

const KINDS: [JointKind; 2] = [JointKind::Revolute, JointKind::Prismatic];

#[test]
fn a_joint_stops_at_its_limit_and_not_before() {
    for kind in KINDS {
        for (position, velocity, expected) in [
            (0.9, 40.0, 20.0),
            (0.9, 19.0, 19.0),
            (-0.4, -40.0, -20.0),
            (-0.4, -19.0, -19.0),
            (1.0, 3.0, 0.0),
            (-0.5, -3.0, 0.0),
            (1.0, -3.0, -3.0),
            (-0.5, 3.0, 3.0),
        ] {
            nearly(after(&mut moved(kind, position, velocity), kind), expected);
        }
    }
}

#[test]
fn a_joint_beyond_its_limit_returns_part_by_part_and_is_never_pulled() {
    for kind in KINDS {
        for (position, velocity, expected) in [
            (1.1, 5.0, -4.0),
            (1.1, 0.0, -4.0),
            (1.1, -10.0, -10.0),
            (-0.6, -5.0, 4.0),
            (-0.6, 0.0, 4.0),
            (-0.6, 10.0, 10.0),
        ] {
            nearly(after(&mut moved(kind, position, velocity), kind), expected);
        }
    }
}

#[test]
fn a_limit_of_the_step_before_lets_go() {
    for kind in KINDS {
        let mut rig = moved(kind, 0.9, 40.0);
        nearly(after(&mut rig, kind), 20.0);
        set(&mut rig, kind, 1.0, 2.0);
        nearly(after(&mut rig, kind), 0.0);
        set(&mut rig, kind, 1.0, -2.0);
        nearly(after(&mut rig, kind), -2.0);
        set(&mut rig, kind, 1.0, 2.0);
        rig.joint.limits = None;
        nearly(after(&mut rig, kind), 2.0);
    }
}

#[test]
fn a_motor_reaches_its_velocity_if_it_is_strong_enough() {
    for (kind, mass) in KINDS.into_iter().zip([INERTIA, MASS]) {
        let mut rig = moved(kind, 0.0, 0.5);
        let strong = Motor {
            velocity: -1.0,
            max_force: 1e6,
        };
        rig.joint.motor = Some(strong);
        nearly(after(&mut rig, kind), -1.0);
        let load = rig.mechanism.joint_loads().next().unwrap();
        nearly(load.motor * STEP, -1.5 * mass);
        // From one side of its velocity, then from the other.
        let weak = Motor {
            velocity: 1.0,
            max_force: 2.0,
        };
        rig.joint.motor = Some(weak);
        for (before, sign) in [(0.0, 1.0), (0.1, 1.0), (2.0, -1.0), (3.0, -1.0), (0.0, 1.0)] {
            set(&mut rig, kind, 0.0, before);
            nearly(after(&mut rig, kind), before + sign * 2.0 * STEP / mass);
            let load = rig.mechanism.joint_loads().next().unwrap();
            assert_eq!(load.motor, sign * 2.0);
        }
        // Once it is near its velocity, it reaches it.
        set(&mut rig, kind, 0.0, 1.0 - STEP / mass);
        nearly(after(&mut rig, kind), 1.0);
        rig.joint.motor = None;
        set(&mut rig, kind, 0.0, 0.3);
        nearly(after(&mut rig, kind), 0.3);
    }
}

/// The motor pushes with all its force, and the limit as much against it.
#[test]
fn a_motor_does_not_push_through_a_limit() {
    for kind in KINDS {
        for (position, sign) in [(1.0, 1.0), (-0.5, -1.0)] {
            let mut rig = moved(kind, position, 0.0);
            rig.joint.motor = Some(Motor {
                velocity: 10.0 * sign,
                max_force: 50.0,
            });
            for _ in 0..3 {
                nearly(after(&mut rig, kind), 0.0);
                let load = rig.mechanism.joint_loads().next().unwrap();
                nearly(load.motor, 50.0 * sign);
                nearly(
                    load.rows[if kind == JointKind::Prismatic { 2 } else { 5 }],
                    0.0,
                );
            }
        }
    }
}

/// A limit takes a joint back whatever a motor does that pushes on: with all its force, by the side on which its velocity is.
#[test]
fn a_motor_pushes_against_a_limit_that_takes_the_joint_back() {
    for kind in KINDS {
        for target in [2.0, 10.0] {
            let mut rig = moved(kind, 1.1, 0.0);
            rig.joint.motor = Some(Motor {
                velocity: target,
                max_force: 5.0,
            });
            // A fifth of 0.1 in a step.
            nearly(after(&mut rig, kind), -4.0);
            let load = rig.mechanism.joint_loads().next().unwrap();
            nearly(load.motor, 5.0);
        }
    }
}

#[test]
fn a_joint_at_rest_below_its_range_returns_to_it() {
    for kind in KINDS {
        for (low, position) in [(0.5, 0.2), (0.5, -0.1), (-0.5, -0.8)] {
            let mut rig = moved(kind, position, 0.0);
            rig.joint.limits = Some([low, 1.0]);
            nearly(after(&mut rig, kind), 0.2 * (low - position) / STEP);
        }
    }
}

#[test]
fn coordinates_of_joints_are_angles_and_ways() {
    let turned = |angle: f64| Pose::new(Vector3::new(0.1, 0.2, 0.3), Vector3::z() * angle);
    for angle in [-3.0, -0.5, 0.0, 1.5, 3.1] {
        nearly(JointKind::Revolute.coordinate(&turned(angle)), angle);
    }
    nearly(JointKind::Prismatic.coordinate(&turned(1.0)), 0.3);
    for kind in [JointKind::Spherical, JointKind::Fixed] {
        assert_eq!(kind.coordinate(&turned(1.0)), 0.0);
    }
}

#[test]
fn whole_turns_are_counted_on() {
    let of = |kind: JointKind, angle: f64, before: f64, turned: f64| {
        let pose = Pose::new(Vector3::new(0.0, 0.0, 0.3), Vector3::z() * angle);
        kind.continued_coordinate(&pose, before, turned)
    };
    for (before, turned) in [
        (0.0, 0.1),
        (PI - 0.05, 0.1),
        (-PI + 0.05, -0.1),
        (20.0, 10.5),
        (-7.0, 4.0 * TAU),
        (100.0, -9.0),
    ] {
        let now = of(JointKind::Revolute, before + turned, before, turned);
        nearly(now, before + turned);
        // What is known of the turn may be wrong by less than half of one.
        nearly(
            of(JointKind::Revolute, before + turned, before, turned + 2.5),
            before + turned,
        );
    }
    nearly(of(JointKind::Prismatic, 1.0, 20.0, 10.0), 0.3);
    assert_eq!(of(JointKind::Fixed, 1.0, 20.0, 10.0), 0.0);
}
