//! Bodies under tension, whose swing a step resolves or does not: `k t^2` against the inertia, `k` being force times lever.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod rig;

use articulation::*;
use geometry::Pose;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use rig::*;

/// From the hinge to the centre of mass, metres.
const LEVER: f64 = 0.3;
/// Across the tension, newtons.
const PUSH: f64 = 1.0;
/// About the hinge.
const WHOLE_INERTIA: f64 = INERTIA + MASS * LEVER * LEVER;

/// A body that hangs on a base, or stands on it, and is pushed across.
struct Hanging {
    mechanism: Mechanism,
    states: [BodyState; 2],
}

impl Hanging {
    /// `base`: what it hangs on; `bodies`: which of the two is the first one of the joint.
    fn new(kind: JointKind, base: BodyProperties, bodies: [usize; 2], along: f64) -> Self {
        let com = Vector3::z() * (LEVER * along);
        let joint = joint(kind, bodies, Vector3::y(), 0.0);
        let mut states = [resting(); 2];
        states[1].force[0] = PUSH;
        Self {
            mechanism: Mechanism::new(vec![base, body(com)], vec![joint]),
            states,
        }
    }

    /// The angular velocity after a step under a force along z, downwards, that makes `k t^2` so many times the inertia.
    fn turn(&mut self, ratio: f64, inertia: f64) -> f64 {
        self.states[1].force[2] = -ratio * inertia / (LEVER * STEP * STEP);
        self.mechanism
            .begin(&self.states, &[free_joint()], [0.0; 3], STEP);
        assert!(self.mechanism.solve());
        let (_, angular) = halves(self.mechanism.velocities().nth(1).unwrap());
        assert!(angular.x.abs() < 1e-9 && angular.z.abs() < 1e-9);
        angular.y
    }
}

#[track_caller]
fn is_turn(found: f64, torque_over_inertia: f64) {
    let expected = torque_over_inertia * STEP;
    assert!(
        (found - expected).abs() < 1e-4 * expected.abs(),
        "{found} is not {expected}"
    );
}

const HINGES: [JointKind; 2] = [JointKind::Revolute, JointKind::Spherical];

#[test]
fn what_the_step_resolves_swings_with_its_own_inertia() {
    for kind in HINGES {
        for bodies in [[0, 1], [1, 0]] {
            let mut hanging = Hanging::new(kind, base(), bodies, -1.0);
            // The last of these is too stiff at the beginning of the next step only.
            for ratio in [0.1, 1.9, 2.9] {
                let turn = hanging.turn(ratio, WHOLE_INERTIA);
                is_turn(turn, -LEVER * PUSH / WHOLE_INERTIA);
            }
        }
    }
}

#[test]
fn what_is_too_stiff_for_the_step_gets_half_its_stiffness_as_inertia() {
    for kind in HINGES {
        for bodies in [[0, 1], [1, 0]] {
            for ratio in [3.1, 10.0, 1000.0] {
                let mut hanging = Hanging::new(kind, base(), bodies, -1.0);
                let expected = -LEVER * PUSH / (0.5 * ratio * WHOLE_INERTIA);
                for _ in 0..3 {
                    is_turn(hanging.turn(ratio, WHOLE_INERTIA), expected);
                }
            }
        }
    }
}

/// From the step before on, half the stiffness is more than the inertia.
#[test]
fn the_forces_of_a_step_stiffen_the_next_one() {
    for kind in HINGES {
        let mut hanging = Hanging::new(kind, base(), [0, 1], -1.0);
        let own = -LEVER * PUSH / WHOLE_INERTIA;
        is_turn(hanging.turn(2.5, WHOLE_INERTIA), own);
        for _ in 0..3 {
            is_turn(hanging.turn(2.5, WHOLE_INERTIA), own / 1.25);
        }
        // The inertia goes with the tension, a step later.
        is_turn(hanging.turn(0.0, WHOLE_INERTIA), own / 1.25);
        is_turn(hanging.turn(0.0, WHOLE_INERTIA), own);
    }
}

/// The mass of a body on one that moves is no part of what resists: that one gives way as it swings.
#[test]
fn on_a_body_that_moves_only_the_own_inertia_counts() {
    let heavy = Matrix3::from_diagonal_element(1e12);
    let heavy = BodyProperties::dynamic(1e12, heavy, Vector3::zeros());
    for kind in HINGES {
        for bodies in [[0, 1], [1, 0]] {
            let mut slow = Hanging::new(kind, heavy, bodies, -1.0);
            is_turn(slow.turn(2.9, INERTIA), -LEVER * PUSH / WHOLE_INERTIA);
            let mut fast = Hanging::new(kind, heavy, bodies, -1.0);
            let added = 0.5 * 8.0 * INERTIA;
            let whole = added + MASS * LEVER * LEVER;
            is_turn(fast.turn(8.0, INERTIA), -LEVER * PUSH / whole);
        }
    }
}

#[test]
fn what_is_pressed_against_its_hinge_is_not_stiffer() {
    for kind in HINGES {
        let mut standing = Hanging::new(kind, base(), [0, 1], 1.0);
        for _ in 0..2 {
            let turn = standing.turn(100.0, WHOLE_INERTIA);
            is_turn(turn, LEVER * PUSH / WHOLE_INERTIA);
        }
    }
}

#[test]
fn slides_and_welds_have_no_axis_that_could_swing() {
    for kind in [JointKind::Prismatic, JointKind::Fixed] {
        let mut hanging = Hanging::new(kind, base(), [0, 1], -1.0);
        for _ in 0..2 {
            assert!(hanging.turn(100.0, WHOLE_INERTIA).abs() < 1e-9);
        }
    }
}

/// About an axis that leans by an angle out of the plane across the tension, the stiffness is as much smaller as the square of its cosine, and so is
/// what the mass contributes.
#[test]
fn about_an_axis_that_leans_less_is_stiff() {
    for (lever, lean) in [(0.3, 0.5_f64), (3.0, 0.5), (3.0, -1.0)] {
        let axis = Vector3::new(0.0, lean.cos(), lean.sin());
        let whole = INERTIA + MASS * (lever * lean.cos()).powi(2);
        for (ratio, inertia) in [(2.9, whole), (3.1, 1.55 * whole), (50.0, 25.0 * whole)] {
            let mut rig = rig(JointKind::Revolute, axis, 0.0, Vector3::z() * -lever);
            rig.body.force[0] = PUSH;
            rig.body.force[2] = -ratio * whole / (lever * lean.cos().powi(2) * STEP * STEP);
            rig.begin(Vector3::zeros());
            let (_, angular) = rig.velocity();
            is_turn(angular.dot(&axis), -lever * lean.cos() * PUSH / inertia);
        }
    }
}

/// Two light rods and a load in a line below a base, all hinged about y; the joint in the middle is pulled aside like a string.
fn string(load: f64) -> (Mechanism, Vec<BodyState>) {
    const LENGTH: f64 = 0.1;
    let about_y = UnitQuaternion::from_scaled_axis(Vector3::x() * -std::f64::consts::FRAC_PI_2);
    let at = |z: f64| Pose::from_parts(Vector3::new(0.0, 0.0, z).into(), about_y);
    let link = |first: usize, base: f64| JointProperties {
        kind: JointKind::Revolute,
        bodies: [first, first + 1],
        base: at(base),
        tip: at(0.5 * LENGTH),
        pitch: 0.0,
    };
    let sphere = |mass: f64, radius: f64| {
        let inertia = Matrix3::from_diagonal_element(0.4 * mass * radius * radius);
        BodyProperties::dynamic(mass, inertia, Vector3::zeros())
    };
    let rod = sphere(0.002, 0.03);
    let bodies = vec![base(), rod, rod, sphere(load, 0.1)];
    let end = -0.5 * LENGTH;
    let joints = vec![link(2, end), link(1, end), link(0, 0.0)];
    let lean = UnitQuaternion::from_scaled_axis(Vector3::y() * 0.02);
    let (mut states, mut top) = (vec![resting(); 4], Vector3::zeros());
    for (state, lean) in
        states[1..]
            .iter_mut()
            .zip([lean, lean.inverse(), UnitQuaternion::identity()])
    {
        let down = lean * Vector3::z() * LENGTH;
        state.motion.pose = Pose::from_parts((top - 0.5 * down).into(), lean);
        top -= down;
    }
    (Mechanism::new(bodies, joints), states)
}

#[test]
fn a_light_string_under_a_heavy_load_stays_calm() {
    const GRAVITY: f64 = 9.81;
    for load in [1.0, 100.0] {
        let (mut mechanism, mut states) = string(load);
        for _ in 0..400 {
            mechanism.begin(&states, &[free_joint(); 3], [0.0, 0.0, -GRAVITY], STEP);
            assert!(mechanism.solve());
            let motions: Vec<BodyMotion> = mechanism.integrate().collect();
            let corrected = mechanism.correct_positions(&motions, &[0.0; 3]);
            for ((state, motion), corrected) in states.iter_mut().zip(motions).zip(corrected) {
                state.motion = corrected.unwrap_or(motion);
                state.gyroscopic_velocity = halves(&state.motion.velocity).1;
            }
            // The string is 0.02 rad out of line at first.
            let leans = states[1..3]
                .iter()
                .map(|state| state.motion.pose.rotation.angle());
            let widest = leans.fold(0.0, f64::max);
            assert!(widest < 0.05, "{load}: {widest}");
        }
    }
}
