//! Inertia of bodies and of what hangs on them, as 6 x 6 matrices by blocks of 3 x 3; shifts of velocities and momenta from point to point.

use nalgebra::{Matrix3, Vector3, Vector6};

use crate::jacobian::{halves, times_cross_matrix};
use crate::spatial;

/// From the velocity at a point to the momentum about it, world axes: `[linear coupling; coupling^T angular]`.
#[derive(Clone, Copy)]
pub(crate) struct SpatialInertia {
    pub linear: Matrix3<f64>,
    pub coupling: Matrix3<f64>,
    pub angular: Matrix3<f64>,
}

impl SpatialInertia {
    pub(crate) fn zero() -> Self {
        Self {
            linear: Matrix3::zeros(),
            coupling: Matrix3::zeros(),
            angular: Matrix3::zeros(),
        }
    }

    /// That of a body about its centre of mass: kg, kg m2.
    pub(crate) fn of_body(mass: f64, angular: Matrix3<f64>) -> Self {
        Self {
            linear: Matrix3::from_diagonal_element(mass),
            coupling: Matrix3::zeros(),
            angular,
        }
    }

    /// The sum with another one about the same point.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            linear: self.linear + other.linear,
            coupling: self.coupling + other.coupling,
            angular: self.angular + other.angular,
        }
    }

    /// The momentum at a velocity.
    #[inline]
    pub(crate) fn times(&self, velocity: &Vector6<f64>) -> Vector6<f64> {
        let (linear, angular) = halves(velocity);
        spatial(
            self.linear * linear + self.coupling * angular,
            self.coupling.tr_mul(&linear) + self.angular * angular,
        )
    }

    /// Subtracts `vector vector^T factor`.
    #[inline]
    pub(crate) fn subtract_square(&mut self, vector: &Vector6<f64>, factor: f64) {
        let (linear, angular) = halves(vector);
        let scaled = angular * factor;
        self.linear -= linear * (linear * factor).transpose();
        self.coupling -= linear * scaled.transpose();
        self.angular -= angular * scaled.transpose();
    }

    /// Adds another inertia, given about a point that is `arm` away from the point of this one.
    #[inline]
    pub(crate) fn add_shifted(&mut self, other: &Self, arm: &Vector3<f64>) {
        let coupling = other.coupling - times_cross_matrix(&other.linear, arm);
        let turned = times_cross_matrix(&other.coupling.transpose(), arm)
            + times_cross_matrix(&coupling.transpose(), arm).transpose();
        self.linear += other.linear;
        self.coupling += coupling;
        self.angular += other.angular - turned;
    }
}

/// The velocity at a point that is `arm` away on the same rigid body.
#[inline]
pub(crate) fn shifted_velocity(velocity: &Vector6<f64>, arm: &Vector3<f64>) -> Vector6<f64> {
    let (linear, angular) = halves(velocity);
    spatial(linear + angular.cross(arm), angular)
}

/// The momentum, impulse or force at a point about a point from which it is `arm` away.
#[inline]
pub(crate) fn shifted_impulse(impulse: &Vector6<f64>, arm: &Vector3<f64>) -> Vector6<f64> {
    let (linear, angular) = halves(impulse);
    spatial(linear, angular + arm.cross(&linear))
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix6;

    use super::*;

    fn dense(inertia: &SpatialInertia) -> Matrix6<f64> {
        Matrix6::from_fn(|row, column| inertia.times(&Vector6::ith(column, 1.0))[row])
    }

    fn inertia() -> SpatialInertia {
        let mut inertia =
            SpatialInertia::of_body(2.0, Matrix3::from_diagonal(&Vector3::new(0.1, 0.2, 0.25)));
        inertia.subtract_square(&Vector6::new(0.3, 0.2, -0.1, 0.05, 0.02, 0.04), 0.5);
        inertia
    }

    #[test]
    fn a_square_is_subtracted() {
        let vector = Vector6::new(0.3, 0.2, -0.1, 0.05, 0.02, 0.04);
        let diagonal = Matrix6::from_diagonal(&Vector6::new(2.0, 2.0, 2.0, 0.1, 0.2, 0.25));
        assert!(
            (dense(&inertia()) - (diagonal - vector * vector.transpose() * 0.5)).amax() < 1e-15
        );
    }

    #[test]
    fn a_shifted_inertia_has_the_momentum_of_the_shifted_velocity() {
        let (arm, velocity) = (
            Vector3::new(0.3, -0.5, 0.7),
            Vector6::new(1.0, -2.0, 0.5, 0.3, 0.8, -0.6),
        );
        let mut shifted = SpatialInertia::zero();
        shifted.add_shifted(&inertia(), &arm);
        let momentum = inertia().times(&shifted_velocity(&velocity, &arm));
        assert!((shifted.times(&velocity) - shifted_impulse(&momentum, &arm)).amax() < 1e-14);
        assert!((dense(&shifted) - dense(&shifted).transpose()).amax() < 1e-14);
    }
}
