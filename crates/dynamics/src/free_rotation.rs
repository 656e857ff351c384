//! The rotation of bodies that touch nothing: angular momentum is kept exactly.
//!
//! rapier bounds the gyroscopic torque so that spin energy is kept, and turns a body about where its angular velocity points at the end of the step: the
//! angular momentum of what tumbles drifts by percents. Here the rotation is split into turns about the principal axes, each of which is exact (R. McLachlan,
//! *Explicit Lie-Poisson integration and the Euler equations*, 1993), composed to the fourth order (H. Yoshida, *Construction of higher order symplectic
//! integrators*, 1990).

use rapier3d_f64::math::{Rotation, Vector};
use rapier3d_f64::prelude::RigidBody;

/// User data of bodies whose gyroscopic torque a mechanism applies.
pub(super) const LINKED: u128 = 1;
/// Rotation in a part of the integration, radians.
const MAX_PART: f64 = 0.1;
/// Largest number of parts of a sub-step.
const MAX_PARTS: f64 = 100.0;
/// Moments of inertia count as equal up to this relative difference.
const EQUAL: f64 = 1e-9;

/// Whether a body turns, and not about an axis of symmetry whatever the direction.
pub(super) fn tumbles(rigid: &RigidBody) -> bool {
    let inverse = rigid.mass_properties().local_mprops.inv_principal_inertia;
    let differs = |a: f64, b: f64| (a - b).abs() > EQUAL * a.max(b);
    let spin = rigid.angvel();
    (differs(inverse.x, inverse.y) || differs(inverse.y, inverse.z))
        && inverse.min_element() > 0.0
        && spin != Vector::ZERO
        && spin.is_finite()
}

/// Replaces the rotation that rapier has made in a step by that which keeps the angular momentum.
pub(super) fn complete(rigid: &mut RigidBody, step: f64) {
    let spin = rigid.angvel();
    let speed = spin.length();
    let made = 2.0 * libm::atan(speed * step / 2.0);
    let before = Rotation::from_scaled_axis(-spin * (made / speed)) * rigid.position().rotation;
    let properties = &rigid.mass_properties().local_mprops;
    let (frame, inverse) = (
        properties.principal_inertia_local_frame,
        properties.inv_principal_inertia,
    );
    let mut motion = Tumbling {
        rotation: before * frame,
        momentum: (before * frame).inverse() * spin / inverse,
        inverse,
    };
    let parts = (speed * step / MAX_PART).ceil().clamp(1.0, MAX_PARTS);
    for _ in 0..parts as usize {
        motion.advance(step / parts);
    }
    let (rotation, spin) = (motion.rotation * frame.inverse(), motion.spin());
    if !(rotation.is_finite() && spin.is_finite()) {
        return;
    }
    let com = rigid.center_of_mass();
    let mut pose = *rigid.position();
    let local = pose.rotation.inverse() * (pose.translation - com);
    pose.rotation = rotation.normalize();
    pose.translation = com + pose.rotation * local;
    rigid.set_position(pose, false);
    rigid.set_angvel(spin, false);
}

/// A free body, along its principal axes.
struct Tumbling {
    /// From the principal axes to the world.
    rotation: Rotation,
    /// Angular momentum along the principal axes.
    momentum: Vector,
    /// One over the moments of inertia.
    inverse: Vector,
}

impl Tumbling {
    /// Angular velocity, world axes.
    fn spin(&self) -> Vector {
        self.rotation * (self.momentum * self.inverse)
    }

    fn advance(&mut self, time: f64) {
        let outer = 1.0 / (2.0 - libm::cbrt(2.0));
        for share in [outer, 1.0 - 2.0 * outer, outer] {
            self.split(time * share);
        }
    }

    /// A step of second order.
    fn split(&mut self, time: f64) {
        for (axis, share) in [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)] {
            self.turn(axis, time * share);
        }
    }

    fn turn(&mut self, axis: usize, time: f64) {
        let angle = self.momentum[axis] * self.inverse[axis] * time;
        let turn = match axis {
            0 => Rotation::from_rotation_x(angle),
            1 => Rotation::from_rotation_y(angle),
            _ => Rotation::from_rotation_z(angle),
        };
        self.rotation *= turn;
        self.momentum = turn.inverse() * self.momentum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_tumbles_keeps_momentum_and_energy() {
        let inverse = Vector::new(1.0, 0.5, 0.4);
        let mut body = Tumbling {
            rotation: Rotation::IDENTITY,
            momentum: Vector::new(0.01, 16.0, 0.01),
            inverse,
        };
        let momentum = body.rotation * body.momentum;
        let energy = |body: &Tumbling| body.momentum.dot(body.momentum * inverse);
        let before = energy(&body);
        let mut has_turned_over = false;
        for _ in 0..10_000 {
            body.advance(0.005);
            assert!((body.rotation * body.momentum - momentum).length() < 1e-9);
            assert!((energy(&body) / before - 1.0).abs() < 1e-6);
            has_turned_over |= body.momentum.y < -10.0;
        }
        // The axis in the middle is not stable.
        assert!(has_turned_over);
    }
}
