//! Contacts of several bodies with each other and with a floor.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod rig;

use articulation::*;
use nalgebra::Vector3;
use rig::*;

const UP: [f64; 3] = [0.0, 0.0, 1.0];
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

/// Impulses of contacts along their normals.
fn pushes(mechanism: &Mechanism, contacts: &[Contact]) -> Vec<f64> {
    let along = |(impulse, contact): ([f64; 3], &Contact)| {
        Vector3::from(impulse).dot(&Vector3::from(contact.normal))
    };
    mechanism
        .contact_impulses()
        .zip(contacts)
        .map(along)
        .collect()
}

/// What stands on what bears all that is above it.
#[test]
fn a_tower_bears_its_weight() {
    let slider = joint(JointKind::Prismatic, [0, 1], Vector3::z(), 0.0);
    let mut mechanism = Mechanism::new(vec![base(), body(Vector3::zeros())], vec![slider]);
    mechanism.set_guests([body(Vector3::zeros()), body(Vector3::zeros())]);
    mechanism.begin(&[resting(); 4], &[free_joint()], GRAVITY, STEP);
    let contacts = [
        contact([Some(3), Some(2)], [0.0; 3], UP),
        contact([Some(2), Some(1)], [0.0; 3], UP),
        contact([Some(1), None], [0.0; 3], UP),
    ];
    mechanism.set_contacts(&contacts);
    assert!(mechanism.solve());
    let weight = MASS * 9.81 * STEP;
    for (push, bodies) in pushes(&mechanism, &contacts).into_iter().zip(1..) {
        let expected = weight * f64::from(bodies);
        assert!(
            (push - expected).abs() < 1e-4 * expected,
            "{push} is not {expected}"
        );
    }
    // The engine is told the sum of the contacts on each guest: it bears its own weight.
    let loads = mechanism.body_loads();
    for guest in [2, 3] {
        let force = halves(&loads[guest].unwrap()).0;
        assert!(
            (force - Vector3::new(0.0, 0.0, MASS * 9.81)).norm() < 1e-2,
            "{force}"
        );
    }
}

#[test]
fn a_guest_that_touches_nothing_is_left_to_the_engine() {
    let slider = joint(JointKind::Prismatic, [0, 1], Vector3::z(), 0.0);
    let mut mechanism = Mechanism::new(vec![base(), body(Vector3::zeros())], vec![slider]);
    mechanism.set_guests([body(Vector3::zeros())]);
    let mut guest = moving(Vector3::x(), Vector3::y());
    guest.gyroscopic_velocity = Vector3::new(0.1, 0.9, 0.2);
    mechanism.begin(
        &[resting(), resting(), guest],
        &[free_joint()],
        GRAVITY,
        STEP,
    );
    assert!(mechanism.solve());
    assert_eq!(mechanism.body_loads()[2], Some(nalgebra::Vector6::zeros()));
    assert!(!mechanism.has_loops());
}

/// The impulses of contacts between a joint's own bodies, one a body of the mechanism that rests.
fn neighbours(kind: JointKind, points: &[([f64; 3], [f64; 3])]) -> Vec<f64> {
    let mut rig = rig(kind, Vector3::y(), 0.0, Vector3::zeros());
    rig.begin(Vector3::zeros());
    let contacts: Vec<Contact> = points
        .iter()
        .map(|&(point, normal)| Contact {
            base: Some(0),
            distance: -0.001,
            ..contact([Some(1), None], point, normal)
        })
        .collect();
    rig.mechanism.set_contacts(&contacts);
    assert!(rig.mechanism.solve());
    pushes(&rig.mechanism, &contacts)
}

#[test]
fn neighbours_push_each_other_only_where_their_joint_lets_them_escape() {
    use JointKind::{Fixed, Prismatic, Revolute, Spherical};
    let beside = [0.1, 0.0, 0.0];
    for (kind, point, normal, escapes) in [
        (Revolute, beside, UP, true),
        (Revolute, beside, [1.0, 0.0, 0.0], false),
        (Revolute, [0.0, 0.1, 0.0], UP, false),
        (Prismatic, beside, [0.0, 1.0, 0.0], true),
        (Prismatic, beside, [0.0, -1.0, 0.0], true),
        (Prismatic, beside, UP, false),
        (Spherical, beside, UP, true),
        (Spherical, [0.0, 0.1, 0.0], UP, true),
        (Spherical, beside, [1.0, 0.0, 0.0], false),
        (Spherical, [0.0; 3], UP, false),
        (Fixed, beside, UP, false),
    ] {
        let push = neighbours(kind, &[(point, normal)])[0];
        assert_eq!(
            push > 1e-6,
            escapes,
            "{kind:?} {point:?} {normal:?}: {push}"
        );
    }
}

/// A turn that opens one point closes the other.
#[test]
fn neighbours_that_touch_on_both_sides_cannot_escape() {
    let (left, right) = ([-0.1, 0.0, 0.0], [0.1, 0.0, 0.0]);
    for kind in [JointKind::Revolute, JointKind::Spherical] {
        let both = neighbours(kind, &[(left, UP), (right, UP)]);
        assert!(both.iter().all(|push| *push == 0.0), "{kind:?}: {both:?}");
        let against = neighbours(kind, &[(left, UP), (right, [0.0, 0.0, -1.0])]);
        assert!(against.iter().sum::<f64>() > 1e-6, "{kind:?}: {against:?}");
    }
}

/// Points of other bodies do not hinder.
#[test]
fn contacts_of_others_do_not_hold_neighbours() {
    let hinge = joint(JointKind::Revolute, [0, 1], Vector3::y(), 0.0);
    let mut mechanism = Mechanism::new(vec![base(), body(Vector3::zeros())], vec![hinge]);
    mechanism.set_guests([body(Vector3::zeros())]);
    mechanism.begin(&[resting(); 3], &[free_joint()], [0.0; 3], STEP);
    let own = Contact {
        base: Some(0),
        distance: -0.001,
        ..contact([Some(1), None], [0.1, 0.0, 0.0], UP)
    };
    let other = contact([Some(1), Some(2)], [-0.1, 0.0, 0.0], UP);
    mechanism.set_contacts(&[own, other]);
    assert!(mechanism.solve());
    assert!(pushes(&mechanism, &[own, other])[0] > 1e-6);
}

/// Friction acts up to its coefficient times the push, against the motion of the obstacle.
#[test]
fn a_moving_obstacle_drags_by_friction() {
    for (speed, expected) in [(0.01, 0.01), (100.0, 0.5 * 9.81 * STEP)] {
        let slider = joint(JointKind::Prismatic, [0, 1], Vector3::x(), 0.0);
        let mut mechanism = Mechanism::new(vec![base(), body(Vector3::zeros())], vec![slider]);
        mechanism.set_guests([body(Vector3::zeros())]);
        mechanism.begin(&[resting(); 3], &[free_joint()], GRAVITY, STEP);
        let belt = Contact {
            friction: 0.5,
            velocity: [0.0, speed, 0.0],
            ..contact([Some(2), None], [0.0; 3], UP)
        };
        mechanism.set_contacts(&[belt]);
        assert!(mechanism.solve());
        let (linear, _) = halves(mechanism.velocities().nth(2).unwrap());
        nearly(linear.y, expected);
        nearly(linear.x, 0.0);
    }
}

/// A press of a motor's force onto an obstacle that is overlapped by `depth`: the velocity at which it goes on, m/s.
fn pressed(force: f64, depth: f64) -> f64 {
    let slider = joint(JointKind::Prismatic, [0, 1], Vector3::z(), 0.0);
    let mut mechanism = Mechanism::new(vec![base(), body(Vector3::zeros())], vec![slider]);
    let motor = Some(Motor {
        velocity: -0.1,
        max_force: force,
    });
    let state = JointState {
        motor,
        ..free_joint()
    };
    mechanism.begin(&[resting(); 2], &[state], [0.0; 3], STEP);
    let touching = Contact {
        distance: -depth,
        ..contact([Some(1), None], [0.0; 3], UP)
    };
    mechanism.set_contacts(&[touching]);
    assert!(mechanism.solve());
    mechanism.velocities().nth(1).unwrap()[2]
}

/// Two kilonewtons are borne without a trace; what is beyond pushes in, by a micrometre for each newton at most.
#[test]
fn a_contact_gives_way_to_a_force_that_nothing_could_bear() {
    assert!(pressed(1900.0, 0.0).abs() < 1e-4);
    assert!(pressed(1900.0, 1e-4) > 1e-3);
    assert!(pressed(7000.0, 0.0) < -0.01);
    assert!(pressed(3000.0, 2e-3) > 1e-3);
}
