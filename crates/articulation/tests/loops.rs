//! A body on two hinges with one axis is as one on one hinge, though some of its rows are redundant; and loops that cannot close.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod rig;

use articulation::*;
use geometry::Pose;
use nalgebra::{UnitQuaternion, Vector3};
use rig::*;

/// From the hinges to the centre of mass, downwards; metres.
const LEVER: f64 = 0.3;
const WHOLE_INERTIA: f64 = INERTIA + MASS * LEVER * LEVER;

/// A body below hinges about y, at these places on the axis.
struct Door {
    mechanism: Mechanism,
    joints: Vec<JointState>,
}

impl Door {
    fn new(hinges: &[f64]) -> Self {
        let hinge = |&y: &f64| {
            let mut joint = joint(JointKind::Revolute, [0, 1], Vector3::y(), 0.0);
            joint.base.translation.y = y;
            joint.tip.translation.y = y;
            joint
        };
        let joints: Vec<JointProperties> = hinges.iter().map(hinge).collect();
        let com = Vector3::z() * -LEVER;
        Self {
            mechanism: Mechanism::new(vec![base(), body(com)], joints),
            joints: vec![free_joint(); hinges.len()],
        }
    }

    fn begin(&mut self, state: BodyState, gravity: Vector3<f64>) {
        let states = [resting(), state];
        self.mechanism
            .begin(&states, &self.joints, gravity.into(), STEP);
    }

    fn solved(&mut self) -> (Vector3<f64>, Vector3<f64>) {
        assert!(self.mechanism.solve());
        halves(self.mechanism.velocities().nth(1).unwrap())
    }

    /// What all hinges exert together, in their frame; newtons.
    fn force(&self) -> Vector3<f64> {
        let forces = self
            .mechanism
            .joint_loads()
            .map(|load| load.rows.fixed_rows::<3>(0).into_owned());
        forces.sum()
    }
}

const ONE: &[f64] = &[0.0];
const TWO: &[f64] = &[-0.5, 0.5];

#[test]
fn a_door_falls_as_a_pendulum() {
    for hinges in [ONE, TWO] {
        let mut door = Door::new(hinges);
        assert_eq!(door.mechanism.has_loops(), hinges.len() > 1);
        door.begin(resting(), Vector3::x() * 5.0);
        let (linear, angular) = door.solved();
        let turn = -LEVER * MASS * 5.0 / WHOLE_INERTIA * STEP;
        close(angular, Vector3::y() * turn);
        close(linear, Vector3::x() * (-turn * LEVER));
    }
}

/// Whether obstacles press against x with this impulse together, N s.
#[track_caller]
fn is_pressed(door: &Door, expected: f64) {
    let impulses = door.mechanism.contact_impulses().map(Vector3::from);
    let gap = impulses.sum::<Vector3<f64>>() + Vector3::x() * expected;
    assert!(gap.norm() < 1e-4 * expected, "{gap} of {expected}");
}

#[test]
fn an_obstacle_bears_a_door_at_its_lever() {
    for hinges in [ONE, TWO] {
        let mut door = Door::new(hinges);
        door.begin(resting(), Vector3::x() * 5.0);
        // Twice as far from the axis as the centre of mass.
        let stop = contact([Some(1), None], [0.0, 0.0, -2.0 * LEVER], [-1.0, 0.0, 0.0]);
        door.mechanism.set_contacts(&[stop]);
        let (linear, angular) = door.solved();
        assert!(linear.norm() < 1e-6 && angular.norm() < 1e-6);
        is_pressed(&door, 0.5 * MASS * 5.0 * STEP);
    }
}

#[test]
fn two_obstacles_share_a_door_that_turns_against_both() {
    for hinges in [ONE, TWO] {
        let mut door = Door::new(hinges);
        door.begin(resting(), Vector3::x() * 5.0);
        let stop = |y: f64| contact([Some(1), None], [0.0, y, -LEVER], [-1.0, 0.0, 0.0]);
        door.mechanism.set_contacts(&[stop(-0.2), stop(0.2)]);
        assert!(door.solved().1.norm() < 1e-6);
        is_pressed(&door, MASS * 5.0 * STEP);
    }
}

#[test]
fn gaps_of_hinges_close() {
    for hinges in [ONE, TWO] {
        for shift in [1e-3, 0.1] {
            let mut door = Door::new(hinges);
            door.begin(resting(), Vector3::zeros());
            door.solved();
            let mut moved = resting().motion;
            moved.pose = Pose::translation(shift, -shift, 0.0);
            let motions = [resting().motion, moved];
            let turned = vec![0.0; hinges.len()];
            let corrected = door.mechanism.correct_positions(&motions, &turned);
            assert_eq!(corrected[0], None);
            let pose = corrected[1].unwrap().pose;
            assert!(pose.translation.vector.norm() < 2e-6, "{pose}");
            // Still about y alone.
            let turn = pose.rotation.scaled_axis();
            assert!(turn.x.hypot(turn.z) < 1e-6, "{turn}");
        }
    }
}

/// A door that turns freely: where it is on its circle, what velocity took it there, and what kept it on its path.
#[test]
fn a_door_stays_on_its_circle() {
    let spin = 3.0;
    for hinges in [ONE, TWO] {
        let mut door = Door::new(hinges);
        let velocity = Vector3::x() * (-spin * LEVER);
        let mut state = moving(velocity, Vector3::y() * spin);
        let mut before = Vector3::z() * -LEVER;
        for step in 0..4 {
            door.begin(state, Vector3::zeros());
            door.solved();
            let motions: Vec<BodyMotion> = door.mechanism.integrate().collect();
            let turned = vec![spin * STEP; hinges.len()];
            let corrected = door.mechanism.correct_positions(&motions, &turned);
            state.motion = corrected[1].unwrap();
            let (linear, angular) = halves(&state.motion.velocity);
            state.gyroscopic_velocity = angular;
            let com = state.motion.pose * nalgebra::Point3::new(0.0, 0.0, -LEVER);
            assert!((com.coords.norm() - LEVER).abs() < 1e-6, "{com}");
            assert!((linear * STEP - (com.coords - before)).norm() < 1e-9);
            assert!((angular.y - spin).abs() < 1e-3, "{angular}");
            before = com.coords;
            // Mass times the square of the angular velocity times the radius; half of it where the velocity is that of the beginning.
            let share = if step == 0 { 0.5 } else { 1.0 };
            let expected = share * MASS * spin * spin * LEVER;
            let force = door.force().norm();
            assert!((force - expected).abs() < 1e-3 * expected, "{force}");
        }
        let turn = state.motion.pose.rotation.angle();
        assert!((turn - 4.0 * spin * STEP).abs() < 1e-4, "{turn}");
    }
}

/// What presses on a body changes how it answers impulses during the step, and nothing of how gaps are closed.
#[test]
fn contacts_do_not_steer_how_gaps_close() {
    for hinges in [ONE, TWO] {
        let closed = |is_pressed: bool| {
            let mut door = Door::new(hinges);
            door.begin(resting(), Vector3::x() * 5.0);
            if is_pressed {
                let stop = contact([Some(1), None], [0.0, 0.0, -0.6], [-1.0, 0.0, 0.0]);
                door.mechanism.set_contacts(&[stop]);
            }
            door.solved();
            let mut moved = resting().motion;
            moved.pose = Pose::translation(0.01, 0.0, 0.02);
            let turned = vec![0.0; hinges.len()];
            let motions = [resting().motion, moved];
            door.mechanism.correct_positions(&motions, &turned)[1].unwrap()
        };
        let [free, pressed] = [false, true].map(closed);
        let gap = free.pose.translation.vector - pressed.pose.translation.vector;
        assert!(gap.norm() < 1e-6, "{gap}");
        assert!(free.pose.rotation.angle_to(&pressed.pose.rotation) < 1e-6);
        assert!((free.velocity - pressed.velocity).norm() < 1e-4);
    }
}

/// A bar that is a tenth of a metre too short for the two places at which it hangs.
fn too_short() -> Mechanism {
    let end = |side: f64| JointProperties {
        base: Pose::translation(0.15 * side, 0.0, 0.0),
        tip: Pose::translation(0.1 * side, 0.0, 0.0),
        ..joint(JointKind::Spherical, [0, 1], Vector3::z(), 0.0)
    };
    let bodies = vec![base(), body(Vector3::zeros())];
    Mechanism::new(bodies, vec![end(-1.0), end(1.0)])
}

/// A step of that bar, which turns about itself; where it is moved to after the step, and what becomes of it.
fn after_a_step(spin: f64, shift: f64) -> Option<BodyMotion> {
    let mut bar = too_short();
    let state = moving(Vector3::zeros(), Vector3::x() * spin);
    bar.begin(&[resting(), state], &[free_joint(); 2], [0.0; 3], STEP);
    assert!(bar.solve());
    let mut motions: Vec<BodyMotion> = bar.integrate().collect();
    motions[1].pose.translation.y = shift;
    bar.correct_positions(&motions, &[0.0; 2])[1]
}

/// A correction would bring it back by what it was moved, and leave the largest error as it is.
#[test]
fn a_loop_that_cannot_close_is_left_alone_where_nothing_helps() {
    for shift in [0.0, 0.05, 0.15] {
        assert_eq!(after_a_step(60.0, shift), None, "{shift}");
    }
}

#[test]
fn a_loop_that_cannot_close_comes_as_near_as_it_can_and_turns_slowly() {
    for (spin, expected) in [(60.0, 20.0), (-60.0, -20.0), (15.0, 15.0)] {
        let after = after_a_step(spin, 1.0).unwrap();
        assert!(
            after.pose.translation.vector.norm() < 0.06,
            "{}",
            after.pose
        );
        let (linear, angular) = halves(&after.velocity);
        // A tenth of a radian in a step at most; and no velocity comes of what was moved.
        close(angular, Vector3::x() * expected);
        assert!(linear.norm() < 1e-9, "{linear}");
    }
}

/// Hinges that are nearly in line with their body, which has turned far: corrections along the joints as they were would lead nowhere.
#[test]
fn corrections_follow_the_joints_where_they_are() {
    let mut door = Door::new(TWO);
    door.begin(resting(), Vector3::zeros());
    door.solved();
    let mut moved = resting().motion;
    let turn = UnitQuaternion::from_scaled_axis(Vector3::y() * 1.4 + Vector3::x() * 0.5);
    moved.pose = Pose::from_parts(Vector3::new(0.1, 0.1, 0.2).into(), turn);
    let motions = [resting().motion, moved];
    let corrected = door.mechanism.correct_positions(&motions, &[1.4; 2]);
    let pose = corrected[1].unwrap().pose;
    let axis = pose.rotation * Vector3::y();
    assert!(pose.translation.vector.norm() < 1e-3, "{pose}");
    assert!((axis - Vector3::y()).norm() < 1e-3, "{axis}");
}
