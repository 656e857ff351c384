//! How far a step of Newton's method goes.

use nalgebra::Vector3;

use crate::contact::Row;
use crate::contact::unknowns::Unknowns;
use crate::mechanism::Mechanism;

/// Largest number of evaluations.
const MAX_EVALUATIONS: usize = 30;
/// A step is taken whole if the slope at its end is less than this fraction of that at its begin.
const TOLERANCE: f64 = 1e-6;

impl Mechanism {
    /// Goes from the velocities before towards the present ones as far as the convex function decreases; whether that is all of the way. `before` and `now`: those at the
    /// contacts.
    pub(super) fn shorten_step(
        &mut self,
        unknowns: &mut impl Unknowns,
        before: &[Vector3<f64>],
        now: &mut [Vector3<f64>],
    ) -> bool {
        let search = LineSearch::new(self, unknowns.square_of_step(self), before, now);
        let share = search.minimum();
        if share == 1.0 {
            return true;
        }
        unknowns.shorten(self, share);
        for (velocity, before) in now.iter_mut().zip(before) {
            *velocity = before + (*velocity - before) * share;
        }
        false
    }
}

/// The convex function along a step of Newton's method.
struct LineSearch<'a> {
    rows: Vec<(&'a Row, [Vector3<f64>; 2])>,
    /// The change of the slope along the step by the inertia, and what the linear contacts contribute at its end.
    inertia: f64,
    linear: f64,
}

impl<'a> LineSearch<'a> {
    fn new(
        mechanism: &'a Mechanism,
        inertia: f64,
        before: &[Vector3<f64>],
        now: &[Vector3<f64>],
    ) -> Self {
        let contacts = mechanism.contacts.rows.iter();
        let steps = before.iter().zip(now).map(|(from, to)| [*from, to - from]);
        let touching = contacts
            .zip(steps)
            .filter(|(row, _)| row.least_compliance > 0.0);
        let rows: Vec<(&Row, [Vector3<f64>; 2])> = touching.collect();
        let linear = rows.iter().map(|(row, [from, step])| {
            row.linear.impulse_at(&(row.target - from - step)).dot(step)
        });
        Self {
            linear: linear.sum(),
            inertia,
            rows,
        }
    }

    /// The slope of the function at a part of the step.
    fn slope(&self, share: f64) -> f64 {
        let pushed = |(row, [from, step]): &(&Row, [Vector3<f64>; 2])| {
            row.exerted(&(from + step * share)).dot(step)
        };
        let contacts: f64 = self.rows.iter().map(pushed).sum();
        self.linear + (share - 1.0) * self.inertia - contacts
    }

    /// Where the slope is zero: the whole step if it only falls.
    fn minimum(&self) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let [mut at_low, mut at_high] = [low, high].map(|share| self.slope(share));
        let tolerance = TOLERANCE * at_low.abs();
        if at_high <= tolerance || at_low >= 0.0 {
            return 1.0;
        }
        let mut share = 1.0;
        for evaluation in 0..MAX_EVALUATIONS {
            share = if evaluation % 3 == 2 {
                (low + high) / 2.0
            } else {
                low + (high - low) * at_low / (at_low - at_high)
            };
            let slope = self.slope(share);
            if slope.abs() <= tolerance {
                break;
            }
            if slope < 0.0 {
                (low, at_low) = (share, slope);
            } else {
                (high, at_high) = (share, slope);
            }
        }
        share
    }
}
