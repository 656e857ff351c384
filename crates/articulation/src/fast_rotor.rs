//! Bodies that turn far about the axis of a joint in a sub-step: propellers, fast wheels.
//!
//! rapier turns a body about where its angular velocity points, the same way for the whole sub-step. A propeller on a hull that tilts
//! makes turns in that time, and its axis goes along with the hull: so its turn is made in two, first about the axis, then with the rest
//! of the motion, which carries the spin along. What that adds to the angular momentum is paid for in the next sub-step, and the
//! gyroscopic torque is carried on from the two sub-steps before (Adams and Bashforth), since the one at the beginning makes hulls nod
//! more and more.

use nalgebra::{UnitQuaternion, Vector3};

use super::chain::Chain;
use super::mover::Mover;
use crate::dynamics::links::Links;
use crate::dynamics::plan::LinkKind;
use crate::dynamics::world::World;

/// Where a body turns farther than this about the axis of a joint in a sub-step, radians, the axis turns with the rest of the motion.
const FAR: f64 = 0.5;

/// How a body spins: about an axis, and else.
#[derive(Clone)]
pub(super) struct Spin {
    pub about: Vector3<f64>,
    pub rest: Vector3<f64>,
}

/// What a fast body takes along to the next sub-step.
pub(super) struct Rotor {
    /// By what its spin changed when the axis took it along.
    pub gained: Vector3<f64>,
    /// The angular momentum that came with it, not yet paid for.
    owed: Vector3<f64>,
    /// Gyroscopic impulse of the sub-step before.
    before: Option<Vector3<f64>>,
}

impl Chain {
    /// The spins of the bodies on joints that turn far in a sub-step, by their place.
    pub(super) fn far_spins(&self, links: &Links, world: &World, step: f64) -> Vec<Option<Spin>> {
        let mut spins: Vec<Option<Spin>> = vec![None; self.movers.len()];
        for node in &self.nodes {
            let Some(link) = links.get(&node.link).filter(|link| link.plan.kind == LinkKind::Revolute) else {
                continue;
            };
            let axis = self.movers[node.ends[0]].pose.rotation * (link.plan.base.rotation * Vector3::z());
            let of_ends = node.ends.map(|end| self.movers[end].spin_about(&axis, world));
            if !of_ends.iter().flatten().any(|spin| spin.about.norm() * step > FAR) {
                continue;
            }
            for (end, spin) in node.ends.into_iter().zip(of_ends) {
                let known = spins[end].as_ref().map_or(0.0, |known| known.about.norm());
                spins[end] = spin.filter(|spin| spin.about.norm() >= known).or(spins[end].take());
            }
        }
        spins
    }
}

impl Mover {
    /// Turns the body from where it was `before` the sub-step, the axis of its spin with the rest of the motion.
    pub(super) fn turn_with_axis(&mut self, spin: Option<Spin>, before: UnitQuaternion<f64>, step: f64) {
        let last = self.rotor.take().and_then(|rotor| rotor.before);
        let Some(Spin { about, rest }) = spin else { return };
        let turn = UnitQuaternion::from_scaled_axis;
        let of_axis = turn(rest * step);
        self.turn_to(of_axis * turn(about * step) * before);
        let gained = of_axis * about - about;
        self.rotor = Some(Rotor { gained, owed: self.world_inertia() * gained, before: last });
    }

    /// Angular impulse of the gyroscopic torque on a fast body, and of what it owes; None for others.
    pub(super) fn rotor_impulse(&mut self, spin: &Vector3<f64>, step: f64) -> Option<Vector3<f64>> {
        let inertia = self.world_inertia();
        let rotor = self.rotor.as_mut()?;
        let now = -spin.cross(&(inertia * spin)) * step - rotor.owed;
        let before = rotor.before.replace(now).unwrap_or(now);
        Some(now * 1.5 - before * 0.5)
    }
}
