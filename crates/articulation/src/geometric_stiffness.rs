//! Light links under tension, which swing to and fro like a string: faster than steps can resolve when the load is heavy.
//!
//! A body that turns by a small angle `a` out of the line of the forces at its ends is turned back by the torque `k a`, the forces times
//! their levers: geometric stiffness. A step `t` resolves such a swing as long as `k t^2 < 4 i`, `i` being the body's inertia; beyond,
//! the integration gains energy. In a chain `k` is exactly that of each body by itself, and its neighbours only add inertia, so that it
//! suffices to look at one after the other. A body for which the step is too long gets as much inertia as it needs about its free axes, as
//! in Newmark's method: such swings are slower than they should be, while those that are resolved hardly change.
//! (S. Andrews, M. Teichmann and P. Kry, *Geometric stiffness for real-time constrained multibody dynamics*, Eurographics 2017.)

use nalgebra::{Matrix3, Vector3};

use crate::joint::Joint;
use crate::linked_body::LinkedBody;
use crate::mechanism::Mechanism;

/// Inertia is added until `k t^2` is this many times the inertia.
const TARGET_RATIO: f64 = 2.0;
/// Inertia is added during the solution where the forces turn out to make it more than this.
const LARGEST_RATIO: f64 = 3.0;

/// The geometric stiffness of a body under tension.
#[derive(Default)]
pub(crate) struct GeometricStiffness {
    /// The stiffness against rotation, times the square of the step.
    stiffness: Matrix3<f64>,
    /// The contribution of the body's mass to its inertia, if it is attached to a fixed point.
    pendulum_inertia: Matrix3<f64>,
    /// World axes.
    added_inertia: Option<Matrix3<f64>>,
}

impl GeometricStiffness {
    pub(crate) fn added_inertia(&self) -> Option<&Matrix3<f64>> {
        self.added_inertia.as_ref()
    }
}

impl Mechanism {
    /// Begins a step with the inertia that the forces of the one before require.
    pub(crate) fn stabilize(&mut self) {
        for body in self.bodies.iter_mut().filter(|body| body.geometric_stiffness.added_inertia.is_some()) {
            body.geometric_stiffness.added_inertia = None;
            body.update_inverse_inertia();
        }
        self.add_inertia(TARGET_RATIO);
    }

    /// Adds the inertia that the forces just found require; true when the system must be solved again.
    pub(crate) fn stabilize_again(&mut self) -> bool {
        self.add_inertia(LARGEST_RATIO)
    }

    fn add_inertia(&mut self, largest_ratio: f64) -> bool {
        for body in &mut self.bodies {
            let of_body = &mut body.geometric_stiffness;
            (of_body.stiffness, of_body.pendulum_inertia) = (Matrix3::zeros(), Matrix3::zeros());
        }
        for joint in self.joints.iter().filter(|joint| joint.holds_point()) {
            let [first, second] = joint.properties.bodies.map(|body| self.bodies[body].is_dynamic());
            for (side, other_moves) in [second, first].into_iter().enumerate() {
                self.bodies[joint.body(side)].add_tension(joint, side, other_moves, self.step);
            }
        }
        let mut added = false;
        for joint in &self.joints {
            for axis in joint.free_rotation_axes() {
                for body in joint.properties.bodies {
                    added |= self.bodies[body].add_inertia(&axis, largest_ratio);
                }
            }
        }
        added
    }
}

impl LinkedBody {
    fn add_tension(&mut self, joint: &Joint, side: usize, other_moves: bool, step: f64) {
        let lever = joint.point - self.com;
        let force = joint.jacobians[side].linear.tr_mul(&joint.impulse.fixed_rows::<3>(0));
        let across = lever * force.transpose();
        let restoring = Matrix3::identity() * lever.dot(&force) - (across + across.transpose()) * 0.5;
        self.geometric_stiffness.stiffness += restoring * step;
        if !other_moves && self.is_dynamic() {
            let square = Matrix3::identity() * lever.norm_squared() - lever * lever.transpose();
            self.geometric_stiffness.pendulum_inertia += square / self.properties.inverse_mass;
        }
    }

    /// Adds inertia about an axis if the ratio of stiffness to inertia is too large there.
    fn add_inertia(&mut self, axis: &Vector3<f64>, largest_ratio: f64) -> bool {
        let of_body = &self.geometric_stiffness;
        let stiffness = axis.dot(&(of_body.stiffness * axis));
        let response = axis.dot(&(self.inverse_mass.angular * axis));
        if !(self.is_dynamic() && stiffness.is_finite() && stiffness * response > largest_ratio) {
            return false;
        }
        let added = of_body.added_inertia.unwrap_or_else(Matrix3::zeros);
        let inertia = axis.dot(&((self.world_inertia() + of_body.pendulum_inertia + added) * axis));
        if stiffness <= largest_ratio * inertia {
            return false;
        }
        let added = added + axis * axis.transpose() * (stiffness / TARGET_RATIO - inertia);
        self.geometric_stiffness.added_inertia = Some(added);
        self.update_inverse_inertia();
        true
    }
}
