//! Light links under tension, which swing to and fro like a string: faster than steps can resolve when the load is heavy.
//!
//! A body that turns by a small angle `a` out of the line of the forces at its ends is turned back by the torque `k a`, the forces times
//! their levers: geometric stiffness. A step `t` resolves such a swing as long as `k t^2 < 4 i`, `i` being the body's inertia; beyond,
//! the integration gains energy. In a chain `k` is exactly that of each body by itself, and its neighbours only add inertia, so that it
//! suffices to look at one after the other. A body for which the step is too long gets as much inertia as it needs about its free axes, as
//! in Newmark's method: such swings are slower than they should be, while those that are resolved hardly change.
//! (S. Andrews, M. Teichmann and P. Kry, *Geometric stiffness for real-time constrained multibody dynamics*, Eurographics 2017.)

use nalgebra::{Matrix3, Vector3};

use crate::joint::{Joint, JointKind, JointProperties};
use crate::linked_body::LinkedBody;
use crate::mechanism::Mechanism;

/// Inertia is added until the ratio of `k t^2` to the inertia is this.
const TARGET_RATIO: f64 = 2.0;
/// During the solution inertia is added where the forces make the ratio larger than this.
const MAX_RATIO: f64 = 3.0;

/// The geometric stiffness of a body under tension.
#[derive(Default)]
pub(crate) struct GeometricStiffness {
    /// The sum `M` of levers times forces, `l f^T`, times the square of the step: about a unit vector `a` the stiffness is `tr M - a^T M a`.
    tension: Matrix3<f64>,
    /// The contribution of the body's mass to its inertia, if it is attached to a fixed point.
    pendulum_inertia: Matrix3<f64>,
    /// World axes.
    added_inertia: Option<Matrix3<f64>>,
    /// The largest response of the body to torques about a free axis of its joints, 1/(kg m2).
    response: f64,
    /// What the stiffness cannot exceed, times the square of the step.
    bound: f64,
}

impl GeometricStiffness {
    pub(crate) fn added_inertia(&self) -> Option<&Matrix3<f64>> {
        self.added_inertia.as_ref()
    }
}

impl Mechanism {
    /// Begins a step with the inertia that the forces of the one before require.
    pub(crate) fn stabilize(&mut self) {
        for body in self
            .bodies
            .iter_mut()
            .filter(|body| body.geometric_stiffness.added_inertia.is_some())
        {
            body.geometric_stiffness.added_inertia = None;
            body.update_inertia();
        }
        self.add_inertia(TARGET_RATIO);
    }

    /// Adds the inertia that the forces just found require; true when the system must be solved again.
    pub(crate) fn stabilize_again(&mut self) -> bool {
        self.add_inertia(MAX_RATIO)
    }

    /// Finds how easily bodies turn about the free axes of their joints, for [`may_exceed`](Self::may_exceed).
    pub(crate) fn find_turning_responses(&mut self) {
        for joint in &self.joints {
            let JointProperties { base, tip, .. } = &joint.properties;
            for (side, frame) in [base, tip].into_iter().enumerate() {
                let body = &mut self.bodies[joint.body(side)];
                let axis = frame.rotation * Vector3::z();
                let inertia = match joint.properties.kind {
                    JointKind::Revolute => axis.dot(&(body.inertia * axis)),
                    JointKind::Spherical => body.inertia.symmetric_eigenvalues().min(),
                    JointKind::Prismatic | JointKind::Fixed => continue,
                };
                let of_body = &mut body.geometric_stiffness;
                of_body.response = of_body.response.max(1.0 / inertia);
            }
        }
    }

    /// Whether the stiffness of a body may be more than that many times its inertia. Most often the sizes of forces and levers tell that it
    /// is not, whatever their directions.
    fn may_exceed(&mut self, ratio: f64) -> bool {
        self.bodies
            .iter_mut()
            .for_each(|body| body.geometric_stiffness.bound = 0.0);
        for joint in self.joints.iter().filter(|joint| joint.holds_point()) {
            let force = joint.impulse.fixed_rows::<3>(0).norm() * self.step;
            for side in 0..2 {
                self.bodies[joint.body(side)].geometric_stiffness.bound +=
                    force * joint.levers[side].norm();
            }
        }
        let exceeds = |of_body: &GeometricStiffness| of_body.bound * of_body.response > ratio;
        self.bodies
            .iter()
            .any(|body| body.is_dynamic() && exceeds(&body.geometric_stiffness))
    }

    fn add_inertia(&mut self, largest_ratio: f64) -> bool {
        if !self.may_exceed(largest_ratio) {
            return false;
        }
        for body in &mut self.bodies {
            let of_body = &mut body.geometric_stiffness;
            (of_body.tension, of_body.pendulum_inertia) = (Matrix3::zeros(), Matrix3::zeros());
        }
        for joint in self.joints.iter().filter(|joint| joint.holds_point()) {
            let [first, second] = joint
                .properties
                .bodies
                .map(|body| self.bodies[body].is_dynamic());
            let force = joint.axes.tr_mul(&joint.impulse.fixed_rows::<3>(0)) * self.step;
            for (side, force, other_moves) in [(0, -force, second), (1, force, first)] {
                self.bodies[joint.body(side)].add_tension(joint, &force, other_moves);
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
    /// `force`: on the body at the joint, times the square of the step.
    fn add_tension(&mut self, joint: &Joint, force: &Vector3<f64>, other_moves: bool) {
        let lever = joint.point - self.com;
        self.geometric_stiffness.tension += lever * force.transpose();
        if !other_moves && self.is_dynamic() {
            let square = Matrix3::identity() * lever.norm_squared() - lever * lever.transpose();
            self.geometric_stiffness.pendulum_inertia += square / self.properties.inverse_mass;
        }
    }

    /// Adds inertia about an axis if the ratio of stiffness to inertia is too large there; true if it is.
    fn add_inertia(&mut self, axis: &Vector3<f64>, largest_ratio: f64) -> bool {
        let GeometricStiffness {
            tension,
            pendulum_inertia,
            added_inertia,
            ..
        } = &mut self.geometric_stiffness;
        let stiffness = tension.trace() - axis.dot(&(*tension * axis));
        let inertia = axis.dot(&((self.inertia + *pendulum_inertia) * axis));
        if !(self.properties.is_dynamic()
            && stiffness.is_finite()
            && stiffness > largest_ratio * inertia)
        {
            return false;
        }
        let missing = axis * axis.transpose() * (stiffness / TARGET_RATIO - inertia);
        *added_inertia.get_or_insert_with(Matrix3::zeros) += missing;
        self.update_inertia();
        true
    }
}
