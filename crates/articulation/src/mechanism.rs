//! Bodies linked by joints, solved together.
//!
//! A motor that cannot reach its velocity exerts its largest force, a limit only pushes: which of them are active is found by iteration
//! over active sets.

use nalgebra::{Vector3, Vector6};

use crate::block_cholesky::Segment;
use crate::contact::Contacts;
use crate::joint::{Joint, JointLoad, JointProperties, JointState};
use crate::linked_body::{BodyProperties, BodyState, LinkedBody};
use crate::spatial;
use crate::system::{System, system_of};

/// Largest number of iterations of the active-set method in which motors and limits may enter and leave the active set.
const MAX_ITERATIONS: usize = 8;
/// Largest number of further iterations in which motors stay saturated and limits active: otherwise many weak motors may enter and leave the
/// set for ever, and the impulses of the last iteration would exceed their forces.
const MAX_CAUTIOUS_ITERATIONS: usize = 24;

/// Bodies linked by joints, and the solver's state between steps.
///
/// A step is [`begin`](Self::begin), [`add_impulse`](Self::add_impulse) for every contact, [`solve`](Self::solve);
/// [`body_loads`](Self::body_loads) are then applied to the bodies by an engine, and after its step
/// [`correct_positions`](Self::correct_positions) closes what gaps the integration left.
pub struct Mechanism {
    pub(crate) bodies: Vec<LinkedBody>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) system: Box<dyn System>,
    pub(crate) contacts: Contacts,
    /// The errors of positions, a segment for each joint.
    pub(crate) errors: Vec<Segment>,
    /// Number of bodies that joints link; guests come after them.
    linked: usize,
    /// Length of the step, seconds.
    pub(crate) step: f64,
}

impl Mechanism {
    /// Lays out the system. Where joints form loops they are eliminated in their order: those at the tips should come first.
    ///
    /// # Panics
    /// When a joint refers to a body that is not there.
    pub fn new(bodies: Vec<BodyProperties>, joints: Vec<JointProperties>) -> Self {
        assert!(
            joints
                .iter()
                .flat_map(|joint| joint.bodies)
                .all(|body| body < bodies.len()),
            "joints need their bodies"
        );
        let bodies: Vec<LinkedBody> = bodies.into_iter().map(LinkedBody::new).collect();
        let joints: Vec<Joint> = joints.into_iter().map(Joint::new).collect();
        let system = system_of(&bodies, &joints);
        let linked = bodies.len();
        let (contacts, errors) = (Contacts::default(), Vec::new());
        let mut mechanism = Self {
            bodies,
            joints,
            system,
            contacts,
            errors,
            linked,
            step: 0.0,
        };
        mechanism.find_turning_responses();
        mechanism
    }

    /// Whether joints form loops. A tree has as many joints as bodies that move, at most.
    pub fn has_loops(&self) -> bool {
        self.joints.len()
            > self.bodies[..self.linked]
                .iter()
                .filter(|body| body.is_dynamic())
                .count()
    }

    /// Sets the guests of the next step: free bodies that touch the mechanism, which come after its own bodies.
    pub fn set_guests(&mut self, guests: impl IntoIterator<Item = BodyProperties>) {
        self.bodies.truncate(self.linked);
        self.bodies
            .extend(guests.into_iter().map(LinkedBody::guest));
        self.system.set_guests(self.linked..self.bodies.len());
    }

    /// Begins a step of `step` seconds: where bodies and joints are, and what acts on them. `gravity` in m/s2, world axes. Bodies (guests last) and joints
    /// are in the order of [`Mechanism::new`].
    pub fn begin(
        &mut self,
        bodies: &[BodyState],
        joints: &[JointState],
        gravity: [f64; 3],
        step: f64,
    ) {
        self.step = step;
        self.set_contacts(&[]);
        self.remove_contact_inertia();
        for (body, state) in self.bodies.iter_mut().zip(bodies) {
            body.set_pose(state.motion.pose);
            body.predict(state, gravity.into(), step);
        }
        for (joint, state) in self.joints.iter_mut().zip(joints) {
            joint.state = *state;
            joint.correction = Segment::zeros();
            joint.place(&self.bodies);
            joint.warm_start(bodies, step);
        }
        self.stabilize();
    }

    /// Adds an impulse (N s) at a point, world axes: a contact that is expected to act in this step.
    pub fn add_impulse(&mut self, body: usize, impulse: [f64; 3], point: [f64; 3]) {
        if let Some(body) = self.bodies.get_mut(body) {
            let (impulse, lever) = (Vector3::from(impulse), Vector3::from(point) - body.com);
            body.external_impulse += spatial(impulse, lever.cross(&impulse));
        }
    }

    /// Adds an impulse (N s) and its moment about the centre of mass (N m s), world axes.
    pub fn add_spatial_impulse(&mut self, body: usize, impulse: &Vector6<f64>) {
        if let Some(body) = self.bodies.get_mut(body) {
            body.external_impulse += impulse;
        }
    }

    /// Finds the impulses that satisfy all joints, motors and limits at once; false when there are none in finite numbers.
    pub fn solve(&mut self) -> bool {
        if self.joints.is_empty() {
            return self.solve_without_joints();
        }
        let last = MAX_ITERATIONS + MAX_CAUTIOUS_ITERATIONS - 1;
        for iteration in 0..=last {
            if !self.solve_active_set() {
                return false;
            }
            let mut changed = iteration + 1 < MAX_ITERATIONS && self.stabilize_again();
            if iteration == last {
                break;
            }
            let is_cautious = iteration + 1 >= MAX_ITERATIONS;
            for joint in &mut self.joints {
                changed |= joint.update_active_set(&self.bodies, self.step, is_cautious);
            }
            if !changed {
                break;
            }
        }
        self.joints
            .iter()
            .all(|joint| joint.impulse.iter().all(|impulse| impulse.is_finite()))
    }

    /// Solves for the motors and limits that are active; false when there is no solution.
    fn solve_active_set(&mut self) -> bool {
        if self.has_contacts() && self.solve_by_newton() {
            return true;
        }
        if !self.system.factorize(&self.joints, &self.bodies) {
            return false;
        }
        self.find_impulses();
        if self.has_contacts() {
            self.find_contact_response();
            if self.find_contact_impulses() {
                self.find_impulses();
            }
        }
        true
    }

    /// Force and torque about the centre of mass (N, N m, world axes) that an engine is to apply to each body during the step, beside
    /// gravity, external forces and contacts, but instead of the gyroscopic torque; None for bodies that no force moves.
    pub fn body_loads(&self) -> Vec<Option<Vector6<f64>>> {
        let load = |body: &LinkedBody| body.is_dynamic().then(|| body.engine_impulse() / self.step);
        self.bodies.iter().map(load).collect()
    }

    /// The velocities of the bodies at the end of the step: of the centre of mass (m/s), then angular (rad/s), along the axes of the world.
    pub fn velocities(&self) -> impl Iterator<Item = &Vector6<f64>> {
        self.bodies.iter().map(|body| &body.velocity)
    }

    /// The velocities along the free axes of the joints at the end of the step, rad/s or m/s; 0 of joints that have none.
    pub fn axis_velocities(&self) -> impl Iterator<Item = f64> {
        let along = |joint: &Joint| Some(joint.axis_velocity(joint.axis?.row, &self.bodies));
        self.joints
            .iter()
            .map(move |joint| along(joint).unwrap_or(0.0))
    }

    /// Forces and torques of the joints and their motors: before [`correct_positions`](Self::correct_positions) those that a body needs which goes straight on,
    /// after it those by which it was kept on its path.
    pub fn joint_loads(&self) -> impl Iterator<Item = JointLoad> {
        self.joints.iter().map(|joint| joint.load(self.step))
    }

    /// Solves for the impulses and velocities.
    fn find_impulses(&mut self) {
        self.apply_contact_impulses();
        self.system
            .find_impulses(&mut self.joints, &mut self.bodies);
    }
}

#[cfg(test)]
mod tests {
    use geometry::Pose;
    use nalgebra::Matrix3;
    use test_support::random::Random;

    use super::*;
    use crate::{BodyMotion, JointKind, Motor, Passive};

    const STEP: f64 = 0.005;
    const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

    /// A chain of rods along x, hinged about y one after the other, the first on a base that does not move.
    fn chain(rods: usize) -> (Mechanism, Vec<BodyState>) {
        let inertia = Matrix3::from_diagonal(&Vector3::new(1e-4, 0.02, 0.02));
        let mut bodies = vec![BodyProperties::immovable(Vector3::zeros())];
        bodies.extend((0..rods).map(|_| BodyProperties::dynamic(1.0, inertia, Vector3::zeros())));
        let about_y =
            nalgebra::UnitQuaternion::from_scaled_axis(Vector3::x() * -std::f64::consts::FRAC_PI_2);
        let at = |x: f64| Pose::from_parts(Vector3::new(x, 0.0, 0.0).into(), about_y);
        let joint = |i: usize| JointProperties {
            kind: JointKind::Revolute,
            bodies: [i, i + 1],
            base: at(if i == 0 { 0.0 } else { 0.25 }),
            tip: at(-0.25),
            pitch: 0.0,
        };
        let states = (0..=rods).map(|i| {
            let x = if i == 0 { 0.0 } else { 0.5 * i as f64 - 0.25 };
            at_rest(Pose::translation(x, 0.0, 0.0))
        });
        (
            Mechanism::new(bodies, (0..rods).rev().map(joint).collect()),
            states.collect(),
        )
    }

    fn at_rest(pose: Pose) -> BodyState {
        BodyState {
            motion: BodyMotion {
                pose,
                velocity: Vector6::zeros(),
            },
            force: Vector6::zeros(),
            gyroscopic_velocity: Vector3::zeros(),
            target: None,
        }
    }

    fn solved(rods: usize, motor: Option<Motor>) -> Mechanism {
        let (mut mechanism, bodies) = chain(rods);
        let joint = JointState {
            position: 0.0,
            velocity: 0.0,
            motor,
            limits: None,
            passive: Passive::default(),
        };
        mechanism.begin(&bodies, &vec![joint; rods], GRAVITY, STEP);
        assert!(mechanism.solve());
        mechanism
    }

    #[test]
    fn a_locked_chain_bears_its_weight() {
        for rods in [1, 2, 10] {
            let hold = Motor {
                velocity: 0.0,
                max_force: 1e9,
            };
            let mechanism = solved(rods, Some(hold));
            // The joint at the base comes last.
            let load = mechanism.joint_loads().last().expect("there are joints");
            let weight = 9.81 * rods as f64;
            let moment = weight * 0.25 * rods as f64;
            assert!(
                (load.rows.fixed_rows::<3>(0).norm() - weight).abs() < 1e-4 * weight,
                "{rods}"
            );
            assert!(
                (load.motor.abs() - moment).abs() < 1e-4 * moment,
                "{rods}: {}",
                load.motor
            );
        }
    }

    #[test]
    fn a_weak_motor_is_saturated() {
        let mechanism = solved(
            1,
            Some(Motor {
                velocity: 0.0,
                max_force: 1.0,
            }),
        );
        assert_eq!(
            mechanism
                .joint_loads()
                .map(|load| load.motor.abs())
                .collect::<Vec<_>>(),
            [1.0]
        );
    }

    #[test]
    fn weak_motors_never_exceed_their_forces() {
        for seed in 1..200 {
            let (mut mechanism, bodies) = chain(24);
            let mut random = Random::new(seed);
            let mut next = || random.unit();
            let joints: Vec<JointState> = (0..24)
                .map(|_| {
                    let motor = Motor {
                        velocity: 20.0 * next() - 10.0,
                        max_force: 10.0 * next() * next(),
                    };
                    let limits = (next() < 0.5).then_some([0.0, 1.0]);
                    JointState {
                        position: 0.0,
                        velocity: 0.0,
                        motor: Some(motor),
                        limits,
                        passive: Passive::default(),
                    }
                })
                .collect();
            mechanism.begin(&bodies, &joints, GRAVITY, STEP);
            assert!(mechanism.solve());
            for (joint, load) in joints.iter().zip(mechanism.joint_loads()) {
                let most = joint.motor.map_or(0.0, |motor| motor.max_force);
                assert!(
                    load.motor.abs() <= most * (1.0 + 1e-9),
                    "{seed}: {} of {most}",
                    load.motor
                );
                // All that acts about the axis is the motor.
                assert!(
                    joint.limits.is_some() || load.rows[5] == load.motor,
                    "{seed}: {} of {most}",
                    load.rows[5]
                );
            }
        }
    }

    #[test]
    fn a_free_pendulum_accelerates_as_its_inertia_says() {
        let mechanism = solved(1, None);
        let expected = 9.81 * 0.25 / (0.02 + 0.25 * 0.25) * STEP;
        assert!((mechanism.bodies[1].velocity[4] - expected).abs() < 1e-9);
    }

    #[test]
    fn gaps_are_closed() {
        let (mut mechanism, mut bodies) = chain(3);
        let joint = JointState {
            position: 0.0,
            velocity: 0.0,
            motor: None,
            limits: None,
            passive: Passive::default(),
        };
        mechanism.begin(&bodies, &[joint; 3], GRAVITY, STEP);
        assert!(mechanism.solve());
        bodies[2].motion.pose.translation.vector.z += 1e-3;
        let motions: Vec<BodyMotion> = bodies.iter().map(|body| body.motion).collect();
        let corrected = mechanism.correct_positions(&motions, &[0.0; 3]);
        assert!(corrected[0].is_none() && corrected[1..].iter().all(Option::is_some));
        let errors = mechanism
            .joints
            .iter()
            .map(|joint| joint.position_error(&mechanism.bodies, 0.0).amax());
        assert!(errors.fold(0.0, f64::max) < 1e-6);
    }

    /// A chain of rods with its tip on an obstacle that supports it from below.
    fn supported(friction: f64, velocity: [f64; 3]) -> Mechanism {
        let (mut mechanism, bodies) = chain(3);
        let joint = JointState {
            position: 0.0,
            velocity: 0.0,
            motor: None,
            limits: None,
            passive: Passive::default(),
        };
        mechanism.begin(&bodies, &[joint; 3], GRAVITY, STEP);
        let contact = crate::Contact {
            bodies: [Some(3), None],
            base: None,
            point: [1.5, 0.0, 0.0],
            normal: [0.0, 0.0, 1.0],
            distance: 0.0,
            friction,
            restitution: 0.0,
            velocity,
            impulse: [0.0; 3],
        };
        mechanism.set_contacts(&[contact]);
        assert!(mechanism.solve());
        mechanism
    }

    #[test]
    fn a_contact_stops_what_stands_on_it() {
        let mechanism = supported(0.0, [0.0; 3]);
        let impulse = mechanism.contact_impulses().next().expect("one contact");
        let tip = mechanism.bodies[3].velocity;
        // The tip is half a rod before the centre of its rod, which turns about y.
        assert!((tip[2] - 0.25 * tip[4]).abs() < 1e-6, "{tip}");
        assert!(impulse[2] > 0.0 && impulse[0].abs() < 1e-12);
    }

    #[test]
    fn friction_is_limited_and_opposes_the_slip() {
        let mechanism = supported(0.5, [0.0, 10.0, 0.0]);
        let impulse = mechanism.contact_impulses().next().expect("one contact");
        assert!(
            ((impulse[0] * impulse[0] + impulse[1] * impulse[1]).sqrt() - 0.5 * impulse[2]).abs()
                < 1e-9 * impulse[2]
        );
        assert!(impulse[1] > 0.0 && impulse[0].abs() < 0.1 * impulse[1]);
    }
}
