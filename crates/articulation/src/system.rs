//! The system of equations of a mechanism: that of a tree, or rows for any loops.

use std::ops::Range;

use nalgebra::Matrix6;

use crate::block_cholesky::Segment;
use crate::joint::Joint;
use crate::linked_body::LinkedBody;
use crate::rows::Rows;
use crate::tree::Tree;

/// Impulses and velocities of bodies linked by joints, of which some motors and limits are active.
pub(crate) trait System: Send {
    /// Takes free bodies in that touch the mechanism: their indices.
    fn set_guests(&mut self, guests: Range<usize>);

    /// Prepares for solutions with the bodies where they are and the active motors and limits; false when there are none.
    fn factorize(&mut self, joints: &[Joint], bodies: &[LinkedBody]) -> bool;

    /// Whether systems can be solved.
    fn is_factor(&self) -> bool;

    /// Finds the impulses of the joints and the velocities that they lead to.
    fn find_impulses(&mut self, joints: &mut [Joint], bodies: &mut [LinkedBody]);

    /// The system if it is that of a tree, which takes contacts in as inertia of the bodies.
    fn as_tree(&mut self) -> Option<&mut Tree>;

    /// Moves the bodies as impulses of the joints against the errors would, which are used up. Masses and axes are those of the factor.
    fn displace(&mut self, joints: &[Joint], bodies: &mut [LinkedBody], errors: &mut [Segment]);

    /// Finds what the joints exerted for the displacements of the bodies, times the step.
    fn find_corrections(&mut self, joints: &mut [Joint], bodies: &[LinkedBody]);

    /// The velocity of each touching body by unit impulses on each of them, all joints holding; row by row.
    fn responses(&mut self, joints: &[Joint], touching: &[usize]) -> Vec<Matrix6<f64>>;
}

/// The system for bodies and joints.
pub(crate) fn system_of(bodies: &[LinkedBody], joints: &[Joint]) -> Box<dyn System> {
    match Tree::new(bodies, joints) {
        Some(tree) => Box::new(tree),
        None => Box::new(Rows::new(bodies, joints)),
    }
}

#[cfg(test)]
mod tests {
    use geometry::Pose;
    use nalgebra::{Matrix3, UnitQuaternion, Vector3, Vector6};
    use test_support::random;

    use super::*;
    use crate::{
        BodyMotion, BodyProperties, BodyState, JointKind, JointProperties, JointState, Mechanism,
        Motor, Passive,
    };

    const BODIES: usize = 9;
    const KINDS: [JointKind; 4] = [
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Spherical,
        JointKind::Fixed,
    ];

    /// What is drawn at random.
    struct Random(random::Random);

    impl Random {
        fn new(seed: u64) -> Self {
            Self(random::Random::new(seed))
        }

        /// A number between -1 and 1.
        fn next(&mut self) -> f64 {
            self.0.signed()
        }

        fn vector(&mut self) -> Vector3<f64> {
            self.0.vector().into()
        }

        fn pose(&mut self) -> Pose {
            Pose::from_parts(
                self.vector().into(),
                UnitQuaternion::from_scaled_axis(self.vector()),
            )
        }

        fn body(&mut self) -> BodyProperties {
            let turn = UnitQuaternion::from_scaled_axis(self.vector()).to_rotation_matrix();
            let inertia = Matrix3::from_diagonal(&Vector3::from_fn(|_, _| 0.3 + 0.1 * self.next()));
            BodyProperties::dynamic(
                1.5 + self.next(),
                turn.matrix() * inertia * turn.matrix().transpose(),
                self.vector(),
            )
        }

        fn state(&mut self) -> BodyState {
            let mut six = || Vector6::from_fn(|_, _| self.next());
            let (velocity, force) = (six(), six());
            let motion = BodyMotion {
                pose: self.pose(),
                velocity,
            };
            BodyState {
                motion,
                force,
                gyroscopic_velocity: self.vector(),
                target: None,
            }
        }

        /// A joint from one of the bodies before to a body, in either direction.
        fn joint(&mut self, body: usize) -> JointProperties {
            let mut bodies = [self.0.below(body), body];
            if self.next() > 0.0 {
                bodies.reverse();
            }
            let kind = KINDS[self.0.below(4)];
            let pitch = if kind == JointKind::Revolute && self.next() > 0.0 {
                0.3
            } else {
                0.0
            };
            JointProperties {
                kind,
                bodies,
                base: self.pose(),
                tip: self.pose(),
                pitch,
            }
        }

        fn joint_state(&mut self) -> JointState {
            let force = if self.next() > 0.0 { 300.0 } else { 1.0 };
            let motor = (self.next() > -0.3).then(|| Motor {
                velocity: self.next(),
                max_force: force,
            });
            let limits = (self.next() > 0.5).then_some([-0.001, 0.001]);
            JointState {
                position: 0.0,
                velocity: 0.0,
                motor,
                limits,
                passive: self.passive(),
            }
        }
    }

    impl Random {
        /// Of half of the joints: a spring, a damper, a rotor, friction.
        fn passive(&mut self) -> Passive {
            if self.next() > 0.0 {
                return Passive::default();
            }
            let mut positive = || self.next().abs();
            Passive {
                armature: positive(),
                stiffness: 100.0 * positive(),
                rest: positive(),
                damping: 10.0 * positive(),
                friction: if positive() > 0.5 { 3.0 } else { 0.0 },
                effort: positive(),
            }
        }
    }

    /// A solved tree, by its own system or by that for loops.
    fn solved(seed: u64, as_rows: bool) -> Mechanism {
        let mut random = Random::new(seed);
        let mut bodies: Vec<BodyProperties> = (0..BODIES).map(|_| random.body()).collect();
        if seed.is_multiple_of(2) {
            bodies[0] = BodyProperties::immovable(Vector3::zeros());
        }
        let mut joints: Vec<JointProperties> = (1..BODIES).map(|body| random.joint(body)).collect();
        joints.reverse();
        let mut mechanism = Mechanism::new(bodies, joints);
        if as_rows {
            mechanism.system = Box::new(Rows::new(&mechanism.bodies, &mechanism.joints));
        }
        let states: Vec<BodyState> = (0..BODIES).map(|_| random.state()).collect();
        let joints: Vec<JointState> = (1..BODIES).map(|_| random.joint_state()).collect();
        mechanism.begin(&states, &joints, [0.0, 0.0, -9.81], 0.005);
        assert!(mechanism.solve(), "{seed}");
        mechanism
    }

    #[test]
    fn a_tree_moves_as_its_rows_say() {
        for seed in 0..200 {
            let [tree, rows] = [false, true].map(|as_rows| solved(seed, as_rows));
            for (a, b) in tree.bodies.iter().zip(&rows.bodies) {
                assert!(
                    (a.velocity - b.velocity).amax() < 1e-6,
                    "{seed}: {} {}",
                    a.velocity,
                    b.velocity
                );
                if a.is_dynamic() {
                    let most = 1e-5 * (1.0 + b.joint_impulse.amax());
                    assert!((a.joint_impulse - b.joint_impulse).amax() < most, "{seed}");
                }
            }
            for (a, b) in tree.joint_loads().zip(rows.joint_loads()) {
                let most = 1e-5 * (1.0 + b.rows.amax());
                assert!(
                    (a.rows - b.rows).amax() < most && (a.motor - b.motor).abs() < most,
                    "{seed}: {a:?} {b:?}"
                );
            }
        }
    }

    #[test]
    fn a_tree_answers_as_its_rows_say() {
        for seed in 0..50 {
            let [mut tree, mut rows] = [false, true].map(|as_rows| solved(seed, as_rows));
            let moving: Vec<usize> = (1..BODIES).collect();
            let [first, second] =
                [&mut tree, &mut rows].map(|it| it.system.responses(&it.joints, &moving));
            for (a, b) in first.iter().zip(&second) {
                assert!((a - b).amax() < 1e-6, "{seed}: {a} {b}");
            }
        }
    }

    #[test]
    fn a_tree_is_corrected_as_its_rows_say() {
        for seed in 0..50 {
            let corrections = [false, true].map(|as_rows| {
                let Mechanism {
                    joints,
                    mut bodies,
                    mut system,
                    ..
                } = solved(seed, as_rows);
                let mut random = Random::new(seed);
                let errors = joints
                    .iter()
                    .map(|_| Segment::from_fn(|_, _| random.next() * 1e-3));
                let mut errors: Vec<Segment> = joints
                    .iter()
                    .zip(errors)
                    .map(|(joint, e)| joint.locked_part(e))
                    .collect();
                system.displace(&joints, &mut bodies, &mut errors);
                bodies
                    .iter()
                    .map(|body| body.correction)
                    .collect::<Vec<_>>()
            });
            for (a, b) in corrections[0].iter().zip(&corrections[1]) {
                assert!((a - b).amax() < 1e-7, "{seed}: {a} {b}");
            }
        }
    }

    #[test]
    fn loops_are_no_trees() {
        let mut random = Random::new(7);
        let bodies: Vec<BodyProperties> = (0..3).map(|_| random.body()).collect();
        let ends = |bodies| JointProperties {
            kind: JointKind::Revolute,
            bodies,
            ..Random::new(1).joint(1)
        };
        let linked = |joints: &[[usize; 2]]| {
            let mechanism = Mechanism::new(
                bodies.clone(),
                joints.iter().map(|&bodies| ends(bodies)).collect(),
            );
            Tree::new(&mechanism.bodies, &mechanism.joints).is_some()
        };
        assert!(linked(&[[0, 1], [1, 2]]) && linked(&[[0, 1]]));
        assert!(
            !linked(&[[0, 1], [1, 2], [2, 0]]) && !linked(&[[0, 1], [1, 0]]) && !linked(&[[0, 0]])
        );
    }
}
