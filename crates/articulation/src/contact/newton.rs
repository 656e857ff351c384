//! The impulses of all contacts at once, and those of the joints with them.
//!
//! Sweeps over the contacts of a wheel that stands on a line, or of a box on four corners, need hundreds of passes, since the points share the load in many ways.
//! With the compliance of the contacts, and the limits of friction given, the velocities are the minimum of a convex function, which is found by Newton's method with
//! exact line search (A. Castro, F. Permenter and X. Han, *An unconstrained convex formulation of compliant contact*, 2022). The limits of friction follow the normal
//! impulses until they agree (J. Haslinger, *Approximation of the Signorini problem with friction, obeying the Coulomb law*, 1983). All begins with what the contacts
//! did in the step before.

use nalgebra::Vector3;

use crate::contact::Row;
use crate::contact::axis_velocities::AxisVelocities;
use crate::contact::friction_limits::FrictionLimits;
use crate::contact::linear_system::BodyVelocities;
use crate::contact::unknowns::Unknowns;
use crate::mechanism::Mechanism;

/// Largest number of iterations.
const MAX_ITERATIONS: usize = 60;
/// The solver has converged when no impulse differs from the linear one by more than this fraction of the largest one.
const TOLERANCE: f64 = 1e-7;
/// After this number of iterations the limits of friction may differ from what belongs to the normal impulses by `LATE_TOLERANCE` of the largest one: they
/// converge slowly where friction decides whether something jams.
const MAX_EXACT_ITERATIONS: usize = 20;
const LATE_TOLERANCE: f64 = 1e-4;
/// The limits of friction follow as soon as no impulse differs by more than this part of what the limits differed by the last time, at first of `FIRST_LIMIT_CHANGE`:
/// what is more exact than the limits is found in vain.
const INNER_PART: f64 = 0.1;
const FIRST_LIMIT_CHANGE: f64 = 0.1;

impl Mechanism {
    /// Finds the impulses of joints and contacts; false where they must be found by sweeps, which go on from what was found.
    pub(crate) fn solve_by_newton(&mut self) -> bool {
        if self.contacts.are_swept {
            return false;
        }
        if self.find_minimum() {
            self.apply_contact_impulses();
            self.find_joint_impulses();
            return true;
        }
        self.contacts.are_swept = true;
        for row in &mut self.contacts.rows {
            row.impulse = row.permitted();
        }
        self.remove_contact_inertia();
        self.apply_contact_impulses();
        false
    }

    /// Along the free axes if there are few of them.
    fn find_minimum(&mut self) -> bool {
        if !AxisVelocities::suit(self) {
            return self.find_minimum_of(&mut BodyVelocities::default());
        }
        let mut unknowns = std::mem::take(&mut self.contacts.along_axes);
        let is_found = self.find_minimum_of(&mut unknowns);
        self.contacts.along_axes = unknowns;
        is_found
    }

    pub(super) fn find_minimum_of(&mut self, unknowns: &mut impl Unknowns) -> bool {
        let (mut before, mut now) = (Vec::new(), Vec::new());
        let mut limits = FrictionLimits::default();
        let mut limit_change = FIRST_LIMIT_CHANGE;
        for iteration in 0..MAX_ITERATIONS {
            let is_first = iteration == 0;
            if !unknowns.solve(self, is_first) {
                return false;
            }
            unknowns.at_contacts(self, &mut now);
            let is_whole = is_first || self.shorten_step(unknowns, &before, &mut now);
            let error = self.linearize(&now);
            if is_whole && error <= TOLERANCE.max(INNER_PART * limit_change) {
                limits.update(&mut self.contacts.rows);
                let change = self.linearize(&now);
                let is_late = iteration > MAX_EXACT_ITERATIONS;
                if error.max(change) <= if is_late { LATE_TOLERANCE } else { TOLERANCE } {
                    unknowns.finish(self);
                    return true;
                }
                limit_change = change.min(FIRST_LIMIT_CHANGE);
                limits.extrapolate(&mut self.contacts.rows);
                self.linearize(&now);
            }
            unknowns.keep(self);
            std::mem::swap(&mut before, &mut now);
        }
        false
    }

    /// Takes the impulses that belong to the velocities at the contacts, and what contacts do near them; returns by how much the linear ones differed, as a part of the
    /// largest one.
    fn linearize(&mut self, velocities: &[Vector3<f64>]) -> f64 {
        let (mut error, mut largest): (f64, f64) = (0.0, 0.0);
        let rows = self.contacts.rows.iter_mut().zip(velocities);
        for (row, velocity) in rows.filter(|(row, _)| row.acts()) {
            let assumed = row.linear.impulse_at(&(row.target - velocity));
            (row.impulse, row.linear) = row.linearized(velocity);
            error = error.max((row.impulse - assumed).amax());
            largest = largest.max(row.impulse[0]);
        }
        if error == 0.0 { 0.0 } else { error / largest }
    }
}

impl Row {
    /// The impulse that was found last, within what the contact can exert.
    fn permitted(&self) -> Vector3<f64> {
        if !self.impulse.iter().all(|x| x.is_finite()) {
            return self.warm;
        }
        let normal = self.impulse[0].max(0.0);
        let (first, second) = self.within_cone(normal, self.impulse[1], self.impulse[2]);
        Vector3::new(normal, first, second)
    }

    /// Whether one of the bodies can be moved.
    pub(super) fn acts(&self) -> bool {
        self.least_compliance > 0.0
    }
}

#[cfg(test)]
mod tests {
    use geometry::Pose;
    use nalgebra::{Matrix3, UnitQuaternion, Vector6};
    use test_support::random::Random;

    use super::*;
    use crate::linked_body::LinkedBody;
    use crate::{
        BodyMotion, BodyProperties, BodyState, Contact, JointKind, JointProperties, JointState,
        Motor, Passive,
    };

    const STEP: f64 = 0.005;
    const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

    fn body_state(pose: Pose) -> BodyState {
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

    /// A contact at rest without overlap.
    fn touching(
        bodies: [Option<usize>; 2],
        point: [f64; 3],
        normal: [f64; 3],
        friction: f64,
    ) -> Contact {
        Contact {
            bodies,
            base: None,
            point,
            normal,
            distance: 0.0,
            friction,
            restitution: 0.0,
            velocity: [0.0; 3],
            impulse: [0.0; 3],
        }
    }

    /// A chassis on four wheels with axes along y, each of which touches the floor at two points; it moves at `velocity` along x and y.
    fn wheels(velocity: [f64; 2], friction: f64) -> Mechanism {
        let inertia = |of: f64| Matrix3::from_diagonal_element(of);
        let mut bodies = vec![BodyProperties::dynamic(
            10.0,
            inertia(0.2),
            Vector3::zeros(),
        )];
        bodies
            .extend((0..4).map(|_| BodyProperties::dynamic(0.5, inertia(1e-3), Vector3::zeros())));
        let places: Vec<Vector3<f64>> = [(-0.2, -0.2), (-0.2, 0.2), (0.2, -0.2), (0.2, 0.2)]
            .map(|(x, y)| Vector3::new(x, y, -0.04))
            .to_vec();
        let along_y = UnitQuaternion::from_scaled_axis(Vector3::x() * -std::f64::consts::FRAC_PI_2);
        let joint = |(wheel, place): (usize, &Vector3<f64>)| JointProperties {
            kind: JointKind::Revolute,
            bodies: [0, wheel + 1],
            base: Pose::from_parts((*place).into(), along_y),
            tip: Pose::from_parts(Vector3::zeros().into(), along_y),
            pitch: 0.0,
        };
        let mut mechanism = Mechanism::new(bodies, places.iter().enumerate().map(joint).collect());
        let mut states = vec![body_state(Pose::translation(0.0, 0.0, 0.12))];
        states.extend(
            places
                .iter()
                .map(|place| body_state(Pose::translation(place.x, place.y, place.z + 0.12))),
        );
        for state in &mut states {
            (state.motion.velocity[0], state.motion.velocity[1]) = (velocity[0], velocity[1]);
        }
        let free = JointState {
            position: 0.0,
            velocity: 0.0,
            motor: None,
            limits: None,
            passive: Passive::default(),
        };
        mechanism.begin(&states, &[free; 4], GRAVITY, STEP);
        let of_wheel = |(wheel, place): (usize, &Vector3<f64>)| {
            let place = *place;
            [-0.025, 0.025].map(move |y| {
                touching(
                    [Some(wheel + 1), None],
                    [place.x, place.y + y, 0.0],
                    [0.0, 0.0, 1.0],
                    friction,
                )
            })
        };
        let contacts: Vec<Contact> = places.iter().enumerate().flat_map(of_wheel).collect();
        mechanism.set_contacts(&contacts);
        mechanism
    }

    /// A guest of 1 kg between two fingers that press it along x with 20 N each.
    fn clamp(friction: f64) -> Mechanism {
        let inertia = Matrix3::from_diagonal_element(1e-3);
        let body = || BodyProperties::dynamic(0.2, inertia, Vector3::zeros());
        let bodies = vec![BodyProperties::immovable(Vector3::zeros()), body(), body()];
        let along_x = UnitQuaternion::from_scaled_axis(Vector3::y() * std::f64::consts::FRAC_PI_2);
        let turned = Pose::from_parts(Vector3::zeros().into(), along_x);
        let slider = |finger: usize| JointProperties {
            kind: JointKind::Prismatic,
            bodies: [0, finger],
            base: turned,
            tip: turned,
            pitch: 0.0,
        };
        let mut mechanism = Mechanism::new(bodies, vec![slider(1), slider(2)]);
        mechanism.set_guests([BodyProperties::dynamic(1.0, inertia, Vector3::zeros())]);
        let pressing = |velocity: f64| JointState {
            position: 0.0,
            velocity: 0.0,
            motor: Some(Motor {
                velocity,
                max_force: 20.0,
            }),
            limits: None,
            passive: Passive::default(),
        };
        let states = [body_state(Pose::identity()); 4];
        mechanism.begin(&states, &[pressing(1.0), pressing(-1.0)], GRAVITY, STEP);
        let corners = |finger: usize, x: f64| {
            [[-0.01, -0.01], [-0.01, 0.01], [0.01, -0.01], [0.01, 0.01]].map(|[y, z]| {
                touching(
                    [Some(3), Some(finger)],
                    [x, y, z],
                    [-x.signum(), 0.0, 0.0],
                    friction,
                )
            })
        };
        mechanism.set_contacts(&[corners(1, -0.02), corners(2, 0.02)].concat());
        mechanism
    }

    #[test]
    fn fingers_hold_what_friction_can_and_slow_the_rest() {
        for (friction, held) in [(0.6, 1.0), (0.2, 8.0 / 9.81)] {
            let mut mechanism = clamp(friction);
            assert!(mechanism.solve() && !mechanism.contacts.are_swept);
            let expected = 9.81 * STEP * (held - 1.0);
            let velocity = mechanism.bodies[3].velocity;
            assert!(
                (velocity[2] - expected).abs() < 1e-5,
                "{friction}: {velocity}"
            );
            assert!(velocity[0].abs() < 1e-6, "{velocity}");
        }
    }

    #[test]
    fn friction_that_unloads_its_contact_by_more_than_what_loads_it_is_found() {
        // A rod of 1 kg and 1 m whose tip, at 60 degrees, slides so that friction lifts it. With the response of the tip to impulses, `n` along the normal and `t` by
        // friction, the normal impulse is what stops the tip over `n + friction t`; following it without secants swings to and fro for ever.
        let (x, z, friction) = (0.25, 0.75_f64.sqrt() / 2.0, 1.6);
        let inertia = 1.0 / 12.0;
        let mut rod = Mechanism::new(Vec::new(), Vec::new());
        let properties = BodyProperties::dynamic(
            1.0,
            Matrix3::from_diagonal_element(inertia),
            Vector3::zeros(),
        );
        rod.set_guests([properties]);
        let mut state = body_state(Pose::translation(0.0, 0.0, z));
        (state.motion.velocity[0], state.motion.velocity[2]) = (-10.0, -0.5);
        rod.begin(&[state], &[], GRAVITY, STEP);
        rod.set_contacts(&[touching(
            [Some(0), None],
            [x, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            friction,
        )]);
        assert!(rod.solve() && !rod.contacts.are_swept);
        let (along_normal, by_friction) = (1.0 + x * x / inertia, x * z / inertia);
        let expected = (0.5 + 9.81 * STEP) / (along_normal + friction * by_friction);
        let found = total(&rod);
        assert!(
            (found[2] - expected).abs() < 1e-4 * expected,
            "{found} {expected}"
        );
        assert!(
            (found[0] - friction * expected).abs() < 1e-4 * expected,
            "{found}"
        );
    }

    fn total(mechanism: &Mechanism) -> Vector3<f64> {
        mechanism.contact_impulses().map(Vector3::from).sum()
    }

    #[test]
    fn wheels_bear_the_weight_and_roll() {
        let mut mechanism = wheels([0.0; 2], 0.8);
        assert!(mechanism.solve() && !mechanism.contacts.are_swept);
        let weight = 12.0 * 9.81 * STEP;
        assert!((total(&mechanism) - Vector3::z() * weight).amax() < 1e-4 * weight);
        // Every point bears the same.
        for impulse in mechanism.contact_impulses() {
            assert!((impulse[2] - weight / 8.0).abs() < 1e-3 * weight);
        }
    }

    #[test]
    fn wheels_slide_across_and_are_slowed_by_friction() {
        let mut mechanism = wheels([0.0, 2.0], 0.5);
        assert!(mechanism.solve() && !mechanism.contacts.are_swept);
        let total = total(&mechanism);
        assert!(
            (total[1] + 0.5 * total[2]).abs() < 1e-6 * total[2],
            "{total}"
        );
        assert!(total[0].abs() < 1e-6 * total[2]);
    }

    /// Whether a contact of the solution is open, holds or slides as Coulomb says, to some digits.
    fn check(row: &Row, bodies: &[LinkedBody], case: usize) {
        let velocity = row.velocity(|body| bodies[body].velocity) - row.target;
        let [normal, friction] = [row.impulse[0], row.impulse.fixed_rows::<2>(1).norm()];
        let slip = velocity.fixed_rows::<2>(1).into_owned();
        let limit = row.friction * normal;
        assert!(normal >= 0.0 && friction <= limit * (1.0 + 1e-6), "{case}");
        assert!(
            velocity[0] > -1e-5 && velocity[0].min(normal) < 1e-6,
            "{case}: {velocity}"
        );
        if friction < limit * 0.999 {
            assert!(slip.norm() < 1e-5, "{case}: {slip}");
        } else if slip.norm() > 1e-5 {
            let along = row.impulse.fixed_rows::<2>(1).dot(&slip);
            assert!(along < -0.9999 * friction * slip.norm(), "{case}: {along}");
        }
    }

    #[test]
    fn sweeps_begin_with_what_contacts_can_exert() {
        let mut mechanism = wheels([0.0, 0.0], 0.5);
        let row = &mut mechanism.contacts.rows[0];
        for (found, permitted) in [
            ([2.0, 3.0, 4.0], [2.0, 0.6, 0.8]),
            ([2.0, 0.3, -0.4], [2.0, 0.3, -0.4]),
            ([-1.0, 3.0, 4.0], [0.0; 3]),
            ([f64::NAN, 3.0, 4.0], [0.5, 0.1, 0.2]),
        ] {
            row.warm = Vector3::new(0.5, 0.1, 0.2);
            row.impulse = found.into();
            assert!((row.permitted() - Vector3::from(permitted)).norm() < 1e-12);
        }
    }

    #[test]
    fn contacts_are_open_hold_or_slide() {
        let mut random = Random::new(5);
        for case in 0..300 {
            let speed = 10f64.powf(-3.0 * random.unit());
            let mut mechanism = wheels(
                [random.signed() * speed, random.signed() * speed],
                random.unit(),
            );
            assert!(mechanism.solve());
            assert!(!mechanism.contacts.are_swept, "{case}");
            for row in &mechanism.contacts.rows {
                check(row, &mechanism.bodies, case);
            }
        }
    }
}
