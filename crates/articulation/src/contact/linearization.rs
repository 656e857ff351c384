//! Contacts as dampers: the impulse of a contact near a velocity of its bodies.
//!
//! A contact that is barely compliant exerts an impulse that is a function of the velocities at the end of the step. With the impulses `p` that a step without
//! slip would need, `p = warm + (target - v) / T` along the tangents and `(target - v) / R` along the normal, it is open where `p` pulls, holds where `p` lies
//! within friction, and slides in the direction of `p` elsewhere (compare A. Castro, F. Permenter and X. Han, *An unconstrained convex formulation of
//! compliant contact*, 2022). `warm` is the impulse of the step before: what rests does not creep by the compliance. For a given limit of friction the
//! impulse is minus the gradient of a convex function; that the limit belongs to the normal impulse is left to the solver.

use nalgebra::{Matrix3, Vector3};

use crate::contact::Row;
use crate::contact::row::HOLDING;

/// The impulse of a contact near a velocity, along its axes: `offset - slope (v - target)`.
#[derive(Clone, Copy)]
pub(crate) struct Linearization {
    pub offset: Vector3<f64>,
    pub slope: Matrix3<f64>,
}

impl Linearization {
    /// Of a contact that exerts nothing.
    pub(crate) fn open() -> Self {
        Self {
            offset: Vector3::zeros(),
            slope: Matrix3::zeros(),
        }
    }

    /// Whether it exerts anything.
    pub(crate) fn acts(&self) -> bool {
        self.slope != Matrix3::zeros() || self.offset != Vector3::zeros()
    }

    /// `lag`: the target minus the velocity.
    pub(crate) fn impulse_at(&self, lag: &Vector3<f64>) -> Vector3<f64> {
        self.offset + self.slope * lag
    }
}

impl Row {
    /// How the contact acts if it does as it did in the step before; `approach`: its normal velocity without new impulses.
    pub(super) fn expected(&self, approach: f64) -> Linearization {
        let warm = self.warm;
        if warm[0] <= 0.0 && approach > self.target[0] {
            return Linearization::open();
        }
        let stiffness = 1.0 / self.least_compliance;
        let holds = across(&warm).norm() < self.friction_limit * HOLDING;
        let along_tangents = if holds {
            1.0 / self.friction_compliance()
        } else {
            0.0
        };
        Linearization {
            offset: across(&warm),
            slope: Matrix3::from_diagonal(&Vector3::new(stiffness, along_tangents, along_tangents)),
        }
    }

    /// The impulse at a velocity along the axes, and how it changes with it.
    pub(super) fn linearized(&self, velocity: &Vector3<f64>) -> (Vector3<f64>, Linearization) {
        let lag = self.target - velocity;
        let (normal, offset, slope) = self.normal_impulse(lag[0]);
        let (mut impulse, mut linear) = self.friction_impulse(&across(&lag));
        for axis in 0..3 {
            (linear.slope[(0, axis)], linear.slope[(axis, 0)]) = (0.0, 0.0);
        }
        if normal > 0.0 {
            (impulse[0], linear.offset[0], linear.slope[(0, 0)]) = (normal, offset, slope);
        }
        (impulse, linear)
    }

    /// The impulse at a velocity along the axes.
    pub(super) fn exerted(&self, velocity: &Vector3<f64>) -> Vector3<f64> {
        let lag = self.target - velocity;
        let (normal, ..) = self.normal_impulse(lag[0]);
        let needed = across(&self.warm) + across(&lag) / self.friction_compliance();
        let length = needed.norm();
        let share = if length > self.friction_limit {
            self.friction_limit / length
        } else {
            1.0
        };
        needed * share + Vector3::new(normal.max(0.0), 0.0, 0.0)
    }

    /// The part along the tangents: up to its limit, whatever the normal impulse is, which keeps the function convex.
    fn friction_impulse(&self, lag: &Vector3<f64>) -> (Vector3<f64>, Linearization) {
        if self.friction_limit == 0.0 {
            return (Vector3::zeros(), Linearization::open());
        }
        let stiffness = 1.0 / self.friction_compliance();
        let warm = across(&self.warm);
        let needed = warm + lag * stiffness;
        let length = needed.norm();
        if length <= self.friction_limit {
            let slope = Matrix3::from_diagonal_element(stiffness);
            let holding = Linearization {
                offset: warm,
                slope,
            };
            return (needed, holding);
        }
        let direction = needed / length;
        let impulse = direction * self.friction_limit;
        let turning = (Matrix3::identity() - direction * direction.transpose())
            * (self.friction_limit / length);
        let sliding = Linearization {
            offset: impulse + turning * warm,
            slope: turning * stiffness,
        };
        (impulse, sliding)
    }

    /// The normal impulse where the velocity lags behind its target, and as a linear function of the lag: offset and slope.
    fn normal_impulse(&self, lag: f64) -> (f64, f64, f64) {
        let rigid = 1.0 / self.least_compliance;
        let full = lag + self.lead;
        let yields = self.yield_compliance > 0.0 && full * rigid > self.rigid_impulse;
        let (offset, slope) = if yields {
            let slope = 1.0 / (self.least_compliance + self.yield_compliance);
            (self.rigid_impulse * self.yield_compliance * slope, slope)
        } else {
            (0.0, rigid)
        };
        let offset = offset + slope * self.lead;
        (offset + slope * lag, offset, slope)
    }
}

/// Without the part along the normal.
fn across(vector: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(0.0, vector[1], vector[2])
}
