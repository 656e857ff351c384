//! Projected Gauss-Seidel sweeps over the contacts of a step.

use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3};

use crate::contact::{Change, Contacts, Side};
use crate::jacobian::InverseMass;

/// Largest number of sweeps over all contacts.
const MAX_SWEEPS: usize = 200;
/// The solver has converged when no impulse changes by more than this fraction of the largest one.
const TOLERANCE: f64 = 1e-5;

impl Contacts {
    /// Sweeps over the contacts until no impulse changes any more; whether one did.
    pub(crate) fn sweep_to_rest(&mut self) -> bool {
        self.directions.clear();
        self.directions.resize(self.rows.len(), Vector3::zeros());
        let (mut changed, mut square) = (false, f64::INFINITY);
        for sweep in 1..=MAX_SWEEPS {
            self.before.clear();
            self.before.extend(self.rows.iter().map(|row| row.impulse));
            let (change, largest) = self.sweep();
            changed |= change > 0.0;
            // What is found in the end lies within the friction cones, where only sweeps keep it.
            if change <= TOLERANCE * largest || sweep == MAX_SWEEPS {
                break;
            }
            square = self.extrapolate(square);
        }
        changed
    }

    /// The response of bodies without joints. `masses`: of all bodies.
    pub(crate) fn find_changes(&mut self, masses: &[InverseMass]) {
        self.changes.clear();
        self.ends.clear();
        self.own.clear();
        for row in &self.rows {
            let mut response = Matrix3::zeros();
            for side in row.sides.iter().flatten() {
                let mass = &masses[side.body];
                let mut velocity = side.jacobian * mass.linear;
                velocity
                    .fixed_rows_mut::<3>(3)
                    .copy_from(&(mass.angular * side.jacobian.fixed_rows::<3>(3)));
                response += side.jacobian.tr_mul(&velocity);
                self.changes.push(Change {
                    place: side.place,
                    velocity,
                });
            }
            self.ends.push(self.changes.len());
            self.own.push(response);
        }
    }

    /// `bodies`: the response of touching bodies to each other.
    pub(crate) fn update_changes(&mut self, bodies: &[Matrix6<f64>]) {
        let Self {
            rows,
            bodies: touching,
            changes,
            ends,
            own,
            ..
        } = self;
        let count = touching.len();
        changes.clear();
        ends.clear();
        own.clear();
        for row in rows.iter() {
            let mut response = Matrix3::zeros();
            for place in 0..count {
                let change = |side: &Side| bodies[place * count + side.place] * side.jacobian;
                let velocity: Matrix6x3<f64> = row.sides.iter().flatten().map(change).sum();
                if velocity == Matrix6x3::zeros() {
                    continue;
                }
                let here = row.sides.iter().flatten();
                response += here
                    .filter(|side| side.place == place)
                    .map(|side| side.jacobian.tr_mul(&velocity))
                    .sum::<Matrix3<f64>>();
                changes.push(Change { place, velocity });
            }
            ends.push(changes.len());
            own.push(response);
        }
    }

    /// One visit of every contact; returns the largest change of an impulse, and the largest impulse.
    fn sweep(&mut self) -> (f64, f64) {
        let (mut change, mut largest) = (0.0, 0.0);
        for index in 0..self.rows.len() {
            let changes = self.push(index).max(self.apply_friction(index));
            change = f64::max(change, changes);
            largest = f64::max(largest, self.rows[index].impulse[0].abs());
        }
        (change, largest)
    }

    /// Goes on in the direction of the sweeps before: the nonsmooth conjugate gradients of M. Silcowitz, S. Niebe and K. Erleben (*A nonsmooth
    /// nonlinear conjugate gradient method for interactive contact force problems*, 2010), which need a tenth of the sweeps where bodies bear
    /// each other by many contacts. `before`: the squared length of the last step; returns that of this one.
    fn extrapolate(&mut self, before: f64) -> f64 {
        let step =
            |contacts: &Self, index: usize| contacts.rows[index].impulse - contacts.before[index];
        let square: f64 = (0..self.rows.len())
            .map(|index| step(self, index).norm_squared())
            .sum();
        let share = Some(square / before)
            .filter(|share| *share <= 1.0)
            .unwrap_or(0.0);
        for index in 0..self.rows.len() {
            let further = self.directions[index] * share;
            self.directions[index] = further + step(self, index);
            let pushes = self.rows[index].impulse[0] + further[0] > 0.0;
            if pushes && further != Vector3::zeros() && further.iter().all(|x| x.is_finite()) {
                (0..3).for_each(|axis| self.apply(index, axis, further[axis]));
            }
        }
        square
    }

    /// What the velocity of a contact lacks, along one of its axes.
    pub(crate) fn slip(&self, index: usize, axis: usize) -> f64 {
        let row = &self.rows[index];
        let velocity = |side: &Side| side.jacobian.column(axis).dot(&self.velocities[side.place]);
        row.sides.iter().flatten().map(velocity).sum::<f64>() - row.target[axis]
    }

    /// Changes the impulse of a contact along one of its axes.
    fn apply(&mut self, index: usize, axis: usize, change: f64) {
        self.rows[index].impulse[axis] += change;
        let Self {
            changes,
            ends,
            velocities,
            ..
        } = self;
        for of_body in of_contact(changes, ends, index) {
            velocities[of_body.place] += of_body.velocity.column(axis) * change;
        }
    }

    /// How the touching bodies answer the impulses of a contact.
    pub(crate) fn changes_of(&self, index: usize) -> &[Change] {
        of_contact(&self.changes, &self.ends, index)
    }

    /// Lets a contact push; returns the change of its impulse.
    fn push(&mut self, index: usize) -> f64 {
        let (row, response) = (&self.rows[index], self.own[index][(0, 0)]);
        let before = row.impulse[0];
        let missing = self.slip(index, 0) + row.compliance * before;
        let rigid = before - missing / (response + row.compliance);
        let change = row.yielded(rigid, response).max(0.0) - before;
        if change == 0.0 || !change.is_finite() {
            return 0.0;
        }
        self.apply(index, 0, change);
        change.abs()
    }

    /// Lets the friction of a contact slow down its tangential velocity; returns the change of its impulse.
    fn apply_friction(&mut self, index: usize) -> f64 {
        let own = &self.own[index];
        // The same for all directions, so that friction opposes the motion.
        let response =
            own[(1, 1)].max(own[(2, 2)]) + own[(1, 2)].abs() + self.rows[index].compliance;
        let row = &self.rows[index];
        if row.impulse == Vector3::zeros() {
            return 0.0;
        }
        let missing = |axis: usize| self.slip(index, axis);
        let free = [1, 2].map(|axis| row.impulse[axis] - missing(axis) / response);
        let (first, second) = row.within_cone(row.impulse[0], free[0], free[1]);
        let change = [first - row.impulse[1], second - row.impulse[2]];
        if change == [0.0; 2] || !change.iter().all(|x| x.is_finite()) {
            return 0.0;
        }
        self.apply(index, 1, change[0]);
        self.apply(index, 2, change[1]);
        change[0].abs().max(change[1].abs())
    }
}

fn of_contact<'a>(changes: &'a [Change], ends: &[usize], index: usize) -> &'a [Change] {
    let first = index.checked_sub(1).map_or(0, |before| ends[before]);
    &changes[first..ends[index]]
}
