//! Bodies that turn far about the axis of a joint in a step: propellers, fast wheels.
//!
//! Rigid-body engines turn a body about where its angular velocity points, the same way for the whole step. A propeller on a hull that
//! tilts makes whole turns in that time, and its axis moves with the hull: so its rotation is composed of two, first about the axis, then
//! the rest of the motion, which carries the spin along. The angular momentum this adds is compensated in the next step, and the
//! gyroscopic torque is extrapolated from the two steps before (the two-step method of Adams and Bashforth), since its value at the
//! beginning of the step makes hulls nod more and more.

use nalgebra::{UnitQuaternion, Vector3};

use crate::joint::JointKind;
use crate::linked_body::{BodyMotion, LinkedBody};
use crate::mechanism::Mechanism;

/// Where a body turns farther than this about the axis of a joint in a step (rad), the axis moves with the rest of the motion.
const FAR_TURN: f64 = 0.5;

/// The angular velocity of a body, along an axis and across it.
#[derive(Clone)]
pub(crate) struct Spin {
    axial: Vector3<f64>,
    transverse: Vector3<f64>,
}

/// The state of a fast body between steps.
pub(crate) struct FastRotor {
    /// By how much the angular velocity changed since the axis carried it along.
    pub velocity_change: Vector3<f64>,
    /// The angular momentum that came with it, not yet compensated.
    excess_momentum: Vector3<f64>,
    /// Gyroscopic impulse of the step before.
    previous_impulse: Option<Vector3<f64>>,
}

impl Spin {
    fn about(axis: &Vector3<f64>, velocity: &Vector3<f64>) -> Self {
        let axial = axis * velocity.dot(axis);
        Self {
            axial,
            transverse: velocity - axial,
        }
    }
}

impl Mechanism {
    /// The spins of the bodies on joints that turn far in a step, by body; none at all where nothing turns far.
    pub(crate) fn fast_spins(&self, motions: &[BodyMotion], step: f64) -> Vec<Option<Spin>> {
        let turns_far =
            |motion: &BodyMotion| motion.velocity.fixed_rows::<3>(3).norm() * step > FAR_TURN;
        if !motions.iter().any(turns_far) {
            return Vec::new();
        }
        let mut spins: Vec<Option<Spin>> = vec![None; self.bodies.len()];
        for joint in self
            .joints
            .iter()
            .filter(|joint| joint.properties.kind == JointKind::Revolute)
        {
            let base = &joint.properties.base;
            let axis = self.bodies[joint.body(0)].pose.rotation * (base.rotation * Vector3::z());
            let of_bodies = joint
                .properties
                .bodies
                .map(|body| self.spin_about(&axis, body, &motions[body]));
            if !of_bodies
                .iter()
                .flatten()
                .any(|spin| spin.axial.norm() * step > FAR_TURN)
            {
                continue;
            }
            for (body, spin) in joint.properties.bodies.into_iter().zip(of_bodies) {
                let known = spins[body].as_ref().map_or(0.0, |known| known.axial.norm());
                spins[body] = spin
                    .filter(|spin| spin.axial.norm() >= known)
                    .or(spins[body].take());
            }
        }
        spins
    }

    fn spin_about(&self, axis: &Vector3<f64>, body: usize, motion: &BodyMotion) -> Option<Spin> {
        let velocity = motion.velocity.fixed_rows::<3>(3).into_owned();
        let is_usable = self.bodies[body].is_dynamic() && velocity.iter().all(|x| x.is_finite());
        is_usable.then(|| Spin::about(axis, &velocity))
    }
}

impl LinkedBody {
    /// Turns the body from where it was `before` the step, the axis of its spin with the rest of the motion.
    pub(crate) fn turn_with_axis(
        &mut self,
        spin: Option<Spin>,
        before: UnitQuaternion<f64>,
        step: f64,
    ) {
        let previous_impulse = self.rotor.take().and_then(|rotor| rotor.previous_impulse);
        let Some(Spin { axial, transverse }) = spin else {
            return;
        };
        let turn = UnitQuaternion::from_scaled_axis;
        let of_axis = turn(transverse * step);
        self.turn_to(of_axis * turn(axial * step) * before);
        let velocity_change = of_axis * axial - axial;
        let excess_momentum = self.world_inertia() * velocity_change;
        self.rotor = Some(FastRotor {
            velocity_change,
            excess_momentum,
            previous_impulse,
        });
    }

    /// Angular impulse of the gyroscopic torque on a fast body, and of what it has to compensate; None for others.
    pub(crate) fn rotor_impulse(&mut self, spin: &Vector3<f64>, step: f64) -> Option<Vector3<f64>> {
        self.rotor.as_ref()?;
        let inertia = self.world_inertia();
        let rotor = self.rotor.as_mut()?;
        let now = -spin.cross(&(inertia * spin)) * step - rotor.excess_momentum;
        let before = rotor.previous_impulse.replace(now).unwrap_or(now);
        Some(now * 1.5 - before * 0.5)
    }
}
