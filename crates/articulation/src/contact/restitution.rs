//! Rebounds that gain no energy.
//!
//! With friction, velocities that are reversed by the coefficient of restitution can gain energy (T. Kane and D. Levinson, *Dynamics: Theory and Applications*,
//! 1985): a cylinder that lands on its rim would jump higher than it fell. The contacts of a step do work on the bodies, by their impulses and the mean of the
//! velocities before and after; where it is positive all rebounds are made smaller until there is none.

use nalgebra::{Vector3, Vector6};

use crate::contact::{Contacts, Row};

/// Number of bisections.
const BISECTIONS: usize = 8;
/// Work below this fraction of what the impulses exchange is none.
const TOLERANCE: f64 = 1e-6;

impl Contacts {
    /// Makes rebounds smaller if they gain energy.
    pub(super) fn limit_restitution(&mut self) {
        let free = self.velocities_without();
        if self.gains_no_energy(&free) {
            return;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..BISECTIONS {
            let share = (low + high) / 2.0;
            self.scale_restitution(share);
            if self.gains_no_energy(&free) {
                low = share;
            } else {
                high = share;
            }
        }
        self.scale_restitution(low);
    }

    /// The velocities of the touching bodies without the impulses of the contacts.
    fn velocities_without(&self) -> Vec<Vector6<f64>> {
        let mut velocities = self.velocities.clone();
        for (index, row) in self.rows.iter().enumerate() {
            for change in self.changes_of(index) {
                velocities[change.place] -= change.velocity * row.impulse;
            }
        }
        velocities
    }

    fn scale_restitution(&mut self, share: f64) {
        for row in self.rows.iter_mut().filter(|row| row.has_restitution()) {
            row.target[0] = row.obstacle[0] + row.restitution_velocity * share;
        }
        self.sweep_to_rest();
    }

    /// Whether the impulses do no work; `free`: the velocities without them.
    fn gains_no_energy(&self, free: &[Vector6<f64>]) -> bool {
        let (mut work, mut exchanged) = (0.0, 0.0);
        for row in &self.rows {
            let [before, after] =
                [free, &self.velocities].map(|all| row.velocity_past(all) - row.obstacle);
            work += row.impulse.dot(&(before + after)) / 2.0;
            exchanged += row.impulse.norm() * (before.norm() + after.norm());
        }
        work <= TOLERANCE * exchanged
    }
}

impl Row {
    /// Velocity of the first body relative to the second along the axes, for velocities by place.
    pub(crate) fn velocity_past(&self, velocities: &[Vector6<f64>]) -> Vector3<f64> {
        let of_side = |side: &crate::contact::Side| side.jacobian.tr_mul(&velocities[side.place]);
        self.sides.iter().flatten().map(of_side).sum()
    }
}
