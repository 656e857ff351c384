//! Motion over steps: integration, fast rotors, light links under tension.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod rig;

use articulation::*;
use geometry::Pose;
use nalgebra::{Matrix3, Translation3, UnitQuaternion, Vector3};
use rig::*;

#[test]
fn bodies_turn_by_their_velocity_times_the_step() {
    for speed in [0.0, 0.1, 1.0, 3.9, 4.1, 50.0] {
        let axis = Vector3::new(1.0, 2.0, -2.0) / 3.0;
        let mut rig = rig(JointKind::Revolute, axis, 0.0, Vector3::zeros());
        rig.body = moving(Vector3::zeros(), axis * speed);
        rig.begin(Vector3::zeros());
        assert!(rig.mechanism.solve());
        nearly(rig.mechanism.turns().next().unwrap(), speed * STEP);
        let after: Vec<BodyMotion> = rig.mechanism.integrate().collect();
        assert_eq!(after[0].pose, Pose::identity());
        let expected = UnitQuaternion::from_scaled_axis(axis * speed * STEP);
        let gap = after[1].pose.rotation.coords - expected.coords;
        assert!(gap.norm() < 2e-15, "{speed}: {gap}");
        close(halves(&after[1].velocity).1, axis * speed);
    }
}

#[test]
fn bodies_turn_about_their_centres() {
    let com = Vector3::new(0.3, 0.0, 0.0);
    let mut rig = rig(JointKind::Prismatic, Vector3::z(), 0.0, com);
    rig.body = moving(Vector3::new(0.0, 0.0, 2.0), Vector3::zeros());
    rig.begin(Vector3::zeros());
    assert!(rig.mechanism.solve());
    assert_eq!(rig.mechanism.turns().next(), Some(0.0));
    let after = rig.mechanism.integrate().nth(1).unwrap();
    close(
        after.pose.translation.vector,
        Vector3::new(0.0, 0.0, 2.0 * STEP),
    );
}

/// Of a hull that a rotor hardly moves, equal for all axes, kg m2.
const HULL_INERTIA: f64 = 10.0;

/// A hull and a rotor with a common centre, about an axis of the hull, without gravity.
fn with_rotor(tilt: Vector3<f64>, spin: Vector3<f64>) -> (Mechanism, Vec<BodyState>) {
    let inertia = Matrix3::from_diagonal_element(HULL_INERTIA);
    let hull = BodyProperties::dynamic(100.0, inertia, Vector3::zeros());
    let bodies = vec![hull, body(Vector3::zeros())];
    let joint = joint(JointKind::Revolute, [0, 1], Vector3::z(), 0.0);
    let states = vec![
        moving(Vector3::zeros(), tilt),
        moving(Vector3::zeros(), tilt + spin),
    ];
    (Mechanism::new(bodies, vec![joint]), states)
}

fn solved(mechanism: &mut Mechanism, states: &[BodyState]) -> Vec<BodyMotion> {
    mechanism.begin(states, &[free_joint()], [0.0; 3], STEP);
    assert!(mechanism.solve());
    mechanism.integrate().collect()
}

#[test]
fn the_axis_of_a_rotor_moves_with_its_hull() {
    let (tilt, spin) = (Vector3::new(8.0, 0.0, 0.0), Vector3::new(0.0, 0.0, 400.0));
    let (mut mechanism, states) = with_rotor(tilt, spin);
    let motions = solved(&mut mechanism, &states);
    let corrected = mechanism.correct_positions(&motions, &[400.0 * STEP]);
    let rotor = corrected[1].unwrap();
    let turn = UnitQuaternion::from_scaled_axis;
    let (of_axis, of_rotor) = (turn(tilt * STEP), turn(spin * STEP));
    assert!(rotor.pose.rotation.angle_to(&(of_axis * of_rotor)) < 1e-6);
    close(halves(&rotor.velocity).1, tilt + of_axis * spin);
}

/// Nothing acts from outside: the angular momentum that the axis adds is taken back in the next step.
#[test]
fn rotors_keep_the_angular_momentum() {
    let (tilt, spin) = (Vector3::new(8.0, 0.0, 0.0), Vector3::new(0.0, 0.0, 400.0));
    let (mut mechanism, mut states) = with_rotor(tilt, spin);
    let of = |hull: Vector3<f64>, rotor: Vector3<f64>| HULL_INERTIA * hull + INERTIA * rotor;
    let momentum = of(tilt, tilt + spin);
    for _ in 0..5 {
        let motions = solved(&mut mechanism, &states);
        let [hull, rotor] = [0, 1].map(|body: usize| halves(&motions[body].velocity).1);
        let found = of(hull, rotor);
        assert!(
            (found - momentum).norm() < 0.01 * momentum.norm(),
            "{found}"
        );
        let corrected = mechanism.correct_positions(&motions, &[400.0 * STEP]);
        for ((state, motion), corrected) in states.iter_mut().zip(motions).zip(corrected) {
            state.motion = corrected.unwrap_or(motion);
            state.gyroscopic_velocity = halves(&state.motion.velocity).1;
        }
    }
}

/// A disc that spins about its axis and across it, whose gyroscopic torque tilts the hull.
#[test]
fn discs_keep_the_angular_momentum() {
    let (tilt, spin) = (Vector3::new(8.0, 0.0, 0.0), Vector3::new(0.0, 0.0, 400.0));
    let disc = Matrix3::from_diagonal(&Vector3::new(0.5, 0.5, 1.0)) * INERTIA;
    let (_, mut states) = with_rotor(tilt, spin);
    let hull = Matrix3::from_diagonal_element(HULL_INERTIA);
    let hull = BodyProperties::dynamic(100.0, hull, Vector3::zeros());
    let disc_body = BodyProperties::dynamic(MASS, disc, Vector3::zeros());
    let joint = joint(JointKind::Revolute, [0, 1], Vector3::z(), 0.0);
    let mut mechanism = Mechanism::new(vec![hull, disc_body], vec![joint]);
    let momentum = |states: &[BodyState]| {
        let [hull, rotor] = [0, 1].map(|body: usize| halves(&states[body].motion.velocity).1);
        let turn = states[1].motion.pose.rotation;
        HULL_INERTIA * hull + turn * (disc * turn.inverse_transform_vector(&rotor))
    };
    let before = momentum(&states);
    for _ in 0..20 {
        let motions = solved(&mut mechanism, &states);
        let corrected = mechanism.correct_positions(&motions, &[400.0 * STEP]);
        for ((state, motion), corrected) in states.iter_mut().zip(motions).zip(corrected) {
            state.motion = corrected.unwrap_or(motion);
            state.gyroscopic_velocity = halves(&state.motion.velocity).1;
        }
    }
    let lost = momentum(&states) - before;
    assert!(lost.norm() < 0.05 * before.norm(), "{lost} of {before}");
}

/// Both turn fast about the axis, the hull too; the body that turned before turns on from there.
#[test]
fn a_fast_pair_turns_about_its_axis() {
    let (tilt, spin) = (Vector3::x() * 8.0, Vector3::z() * 400.0);
    let start = UnitQuaternion::from_scaled_axis(Vector3::z() * 1.0);
    let (mut mechanism, mut states) = with_rotor(tilt, spin);
    for state in &mut states {
        state.motion.velocity[5] += 150.0;
        state.gyroscopic_velocity.z += 150.0;
    }
    states[1].motion.pose.rotation = start;
    let motions = solved(&mut mechanism, &states);
    let corrected = mechanism.correct_positions(&motions, &[400.0 * STEP]);
    let turn = |by: Vector3<f64>| UnitQuaternion::from_scaled_axis(by * STEP);
    let expected = turn(tilt) * turn(Vector3::z() * 550.0) * start;
    let rotation = corrected[1].unwrap().pose.rotation;
    assert!(rotation.angle_to(&expected) < 1e-3, "{rotation}");
}

#[test]
fn what_no_force_moves_is_no_rotor() {
    let axis = Vector3::z();
    let mut rig = rig(JointKind::Revolute, axis, 0.0, Vector3::zeros());
    rig.body = moving(Vector3::zeros(), axis * 400.0);
    rig.begin(Vector3::zeros());
    assert!(rig.mechanism.solve());
    let motions: Vec<BodyMotion> = rig.mechanism.integrate().collect();
    let corrected = rig.mechanism.correct_positions(&motions, &[400.0 * STEP]);
    assert_eq!(corrected[0], None);
    let turn = UnitQuaternion::from_scaled_axis(axis * 400.0 * STEP);
    assert!(corrected[1].unwrap().pose.rotation.angle_to(&turn) < 1e-9);
}

/// Below half a radian in a step, a rotor is a body like any other.
#[test]
fn slow_rotors_are_left_to_the_engine() {
    let (mut mechanism, states) = with_rotor(Vector3::zeros(), Vector3::new(0.0, 0.0, 90.0));
    let motions = solved(&mut mechanism, &states);
    assert_eq!(
        mechanism.correct_positions(&motions, &[90.0 * STEP]),
        [None, None]
    );
}

const GRAVITY: f64 = 9.81;
/// Of the light rod, metres.
const LENGTH: f64 = 0.1;

/// A heavy load on a light rod, both hinged about y, a little out of the vertical line below a base.
fn pendulum(kind: JointKind, load: f64) -> (Mechanism, Vec<BodyState>) {
    let at = |y: f64| {
        Pose::from_parts(
            Translation3::new(0.0, 0.0, y),
            UnitQuaternion::from_scaled_axis(Vector3::x() * -std::f64::consts::FRAC_PI_2),
        )
    };
    let link = |bodies, base, tip| JointProperties {
        kind,
        bodies,
        base: at(base),
        tip: at(tip),
        pitch: 0.0,
    };
    let sphere = |mass: f64, radius: f64| {
        let inertia = Matrix3::from_diagonal_element(0.4 * mass * radius * radius);
        BodyProperties::dynamic(mass, inertia, Vector3::zeros())
    };
    let bodies = vec![base(), sphere(0.002, 0.03), sphere(load, 0.1)];
    let joints = vec![
        link([1, 2], -0.5 * LENGTH, 0.1),
        link([0, 1], 0.0, 0.5 * LENGTH),
    ];
    let lean = UnitQuaternion::from_scaled_axis(Vector3::y() * 0.02);
    let place = |down: f64, lean: UnitQuaternion<f64>, from: Vector3<f64>| {
        Pose::from_parts((from - lean * Vector3::z() * down).into(), lean)
    };
    let rod = place(0.5 * LENGTH, lean, Vector3::zeros());
    let end = -(lean * Vector3::z() * LENGTH);
    let mut states = vec![resting(); 3];
    states[1].motion.pose = rod;
    states[2].motion.pose = place(0.1, UnitQuaternion::identity(), end);
    (Mechanism::new(bodies, joints), states)
}

/// The largest energy of the load during a second as a part of what it has at first, above its lowest place.
fn largest_energy(kind: JointKind, load: f64) -> f64 {
    let (mut mechanism, mut states) = pendulum(kind, load);
    let energy = |state: &BodyState| {
        let height = state.motion.pose.translation.z + LENGTH + 0.1;
        let (linear, angular) = halves(&state.motion.velocity);
        GRAVITY * height + 0.5 * linear.norm_squared() + 0.5 * 0.4 * 0.01 * angular.norm_squared()
    };
    let before = energy(&states[2]);
    let mut largest = 0.0_f64;
    for _ in 0..200 {
        mechanism.begin(&states, &[free_joint(); 2], [0.0, 0.0, -GRAVITY], STEP);
        assert!(mechanism.solve());
        let motions: Vec<BodyMotion> = mechanism.integrate().collect();
        let corrected = mechanism.correct_positions(&motions, &[0.0; 2]);
        for ((state, motion), corrected) in states.iter_mut().zip(motions).zip(corrected) {
            state.motion = corrected.unwrap_or(motion);
            state.gyroscopic_velocity = halves(&state.motion.velocity).1;
        }
        largest = largest.max(energy(&states[2]));
    }
    largest / before
}

#[test]
fn a_light_link_under_a_heavy_load_gains_no_energy() {
    for kind in [JointKind::Revolute, JointKind::Spherical] {
        for load in [1.0, 100.0] {
            let ratio = largest_energy(kind, load);
            assert!((0.9..1.1).contains(&ratio), "{kind:?} {load}: {ratio}");
        }
    }
}
