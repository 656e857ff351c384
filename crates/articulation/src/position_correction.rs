//! After a step of the engine: the bodies back where the joints want them, in positions and velocities alike (SHAKE).

use nalgebra::{Vector3, Vector6};

use crate::linked_body::{BodyMotion, LinkedBody, Placement};
use crate::mechanism::Mechanism;
use crate::system::System;

/// Position errors below this are never corrected, metres and radians.
const MIN_TOLERANCE: f64 = 1e-9;
/// Fraction of the error after a step that may stay, up to [`MAX_TOLERANCE`]. Not in mechanisms with loops, which may fold two ways and
/// need all digits.
const RELATIVE_TOLERANCE: f64 = 1e-3;
/// Upper limit of the error that may stay, metres and radians.
const MAX_TOLERANCE: f64 = 1e-6;
/// Errors above this after the corrections show that they have failed, metres and radians.
const LARGE_ERROR: f64 = 1e-4;
/// Largest number of corrections in a step.
const MAX_ITERATIONS: usize = 8;
/// A correction that removes less than this fraction of the error was made along outdated directions: these are computed anew.
const MIN_PROGRESS: f64 = 0.75;
/// Where no correction removes wide errors, the motion is too fast for the step: bodies turn by no more than this in a step then (rad), lest
/// the integration gains energy.
const MAX_TURN_PER_STEP: f64 = 0.1;

impl Mechanism {
    /// Corrects the positions that the integration left off the joints by the curvature of their paths, and the velocities with them, which
    /// makes this a SHAKE step, which conserves energy.
    ///
    /// `motions`: of all bodies after the step. `turned`: how far each joint turned in it (rad), known to half a turn. Returns where bodies
    /// belong and how they move; None for those that are right.
    pub fn correct_positions(
        &mut self,
        motions: &[BodyMotion],
        turned: &[f64],
    ) -> Vec<Option<BodyMotion>> {
        let spins = self
            .fast_spins(motions, self.step)
            .into_iter()
            .chain(std::iter::repeat(None));
        for ((body, motion), spin) in self.bodies.iter_mut().zip(motions).zip(spins) {
            let before = body.pose.rotation;
            body.place(motion.pose);
            body.correction = Vector6::zeros();
            body.turn_with_axis(spin, before, self.step);
        }
        let is_closed = self.close_gaps(turned);
        let fastest = if is_closed {
            f64::MAX
        } else {
            MAX_TURN_PER_STEP / self.step
        };
        let corrects_velocity = is_closed || !self.has_loops();
        if corrects_velocity {
            self.find_corrections();
        }
        let step = self.step;
        let of_body = |(body, motion): (&LinkedBody, _)| {
            body.corrected_motion(motion, step, corrects_velocity, fastest)
        };
        self.bodies.iter().zip(motions).map(of_body).collect()
    }

    /// Corrections act along the joints as they were. Where that leads nowhere, as near a position in which a loop can fold two ways, the bodies
    /// are taken back and corrected along the joints as they are. False when wide errors remain.
    fn close_gaps(&mut self, turned: &[f64]) -> bool {
        let (mut largest, has_loops) = (self.find_errors(turned), self.has_loops());
        let closed = if has_loops {
            MIN_TOLERANCE
        } else {
            (largest * RELATIVE_TOLERANCE).clamp(MIN_TOLERANCE, MAX_TOLERANCE)
        };
        let (mut rate, mut is_current) = (f64::INFINITY, false);
        if largest >= closed {
            self.leave_contacts_out();
        }
        let begin = (largest > LARGE_ERROR && has_loops).then(|| (largest, self.placements()));
        for _ in 0..MAX_ITERATIONS {
            if largest < closed || !largest.is_finite() || !self.system.is_factor() {
                break;
            }
            let placements = self.placements();
            self.system
                .displace(&self.joints, &mut self.bodies, &mut self.errors);
            // Without loops every correction leaves about the same part of the error.
            if !has_loops && largest * rate < closed {
                largest *= rate;
                break;
            }
            let now = self.find_errors(turned);
            if now <= largest * (1.0 - MIN_PROGRESS) || is_current {
                (rate, largest, is_current) = (now / largest, now, false);
                continue;
            }
            self.restore(&placements);
            (largest, is_current) = (self.find_errors(turned), true);
            if !self.update_system() {
                break;
            }
        }
        // Errors that cannot be closed, as in a loop that is too short, remain.
        if let Some((_, placements)) =
            begin.filter(|(before, _)| largest > before * (1.0 - MIN_PROGRESS))
        {
            self.restore(&placements);
        }
        largest <= LARGE_ERROR
    }

    /// Positions are corrected along the joints alone, of which contacts may have needed no factor.
    fn leave_contacts_out(&mut self) {
        let was_there = self.remove_contact_inertia();
        if let Some(tree) = self.system.as_tree()
            && (was_there || !tree.is_factor())
        {
            tree.refactorize(&self.bodies);
        }
    }

    /// Finds the impulses of the joints by which the velocities are corrected.
    fn find_corrections(&mut self) {
        let Self {
            system,
            joints,
            bodies,
            step,
            ..
        } = self;
        system.find_corrections(joints, bodies);
        for joint in joints {
            joint.correction /= *step;
        }
    }

    fn placements(&self) -> Vec<Placement> {
        self.bodies.iter().map(LinkedBody::placement).collect()
    }

    fn restore(&mut self, placements: &[Placement]) {
        self.bodies
            .iter_mut()
            .zip(placements)
            .for_each(|(body, placement)| body.restore(placement));
    }

    /// Finds the errors of all joints; returns the largest one.
    fn find_errors(&mut self, turned: &[f64]) -> f64 {
        let Self {
            joints,
            bodies,
            errors,
            ..
        } = self;
        errors.clear();
        errors.extend(
            joints
                .iter()
                .zip(turned)
                .map(|(joint, turned)| joint.position_error(bodies, *turned)),
        );
        errors.iter().map(|error| error.amax()).fold(0.0, f64::max)
    }

    /// The system for where the bodies are now; false when it cannot be solved.
    fn update_system(&mut self) -> bool {
        self.bodies.iter_mut().for_each(LinkedBody::update_inertia);
        for joint in &mut self.joints {
            joint.place(&self.bodies);
        }
        self.system.factorize(&self.joints, &self.bodies)
    }
}

impl LinkedBody {
    /// The motion with the correction, which changes the velocity where it shall; `fastest` bounds the angular velocity, rad/s.
    fn corrected_motion(
        &self,
        motion: &BodyMotion,
        step: f64,
        corrects_velocity: bool,
        fastest: f64,
    ) -> Option<BodyMotion> {
        if self.correction == Vector6::zeros() && self.rotor.is_none() {
            return None;
        }
        let change = if corrects_velocity {
            self.correction
        } else {
            Vector6::zeros()
        };
        let mut velocity = motion.velocity + change / step;
        let mut angular = velocity.fixed_rows::<3>(3).into_owned();
        angular += self
            .rotor
            .as_ref()
            .map_or_else(Vector3::zeros, |rotor| rotor.velocity_change);
        let speed = angular.norm_squared();
        if speed > fastest * fastest {
            angular = fastest * (angular / speed.sqrt());
        }
        velocity.fixed_rows_mut::<3>(3).copy_from(&angular);
        Some(BodyMotion {
            pose: self.pose,
            velocity,
        })
    }
}
