//! The limits of friction, which follow the normal impulses.
//!
//! They may swing to and fro where friction loads a contact or unloads it, so that they are extrapolated by secants through the last steps (D. Anderson, *Iterative
//! procedures for nonlinear integral equations*, 1965).

use nalgebra::{DMatrix, DVector};

use crate::contact::Row;

/// Number of secants by which the limits of friction are extrapolated.
const MAX_SECANTS: usize = 4;
/// Secants of which the bends are smaller than this are left out, N s.
const MIN_SINGULAR_VALUE: f64 = 1e-14;

/// The limits of friction of the iterations.
#[derive(Default)]
pub(super) struct FrictionLimits {
    /// The last one comes last.
    steps: Vec<LimitStep>,
}

/// Limits that belong to the normal impulses that were found, and by how much they differ from those with which these were found.
struct LimitStep {
    found: DVector<f64>,
    change: DVector<f64>,
}

impl FrictionLimits {
    /// Lets friction and rebounds follow the normal impulses.
    pub(super) fn update(&mut self, rows: &mut [Row]) {
        let found = rows.iter().map(|row| row.friction * row.impulse[0]);
        let found = DVector::from_iterator(rows.len(), found);
        let limits = DVector::from_iterator(rows.len(), rows.iter().map(|row| row.friction_limit));
        for (row, found) in rows.iter_mut().zip(&found) {
            row.friction_limit = *found;
            if row.has_restitution() {
                row.lead = row.least_compliance * row.impulse[0];
            }
        }
        if self.steps.len() > MAX_SECANTS {
            self.steps.remove(0);
        }
        let change = &found - limits;
        self.steps.push(LimitStep { found, change });
    }

    /// Goes where the secants through the last steps meet zero.
    pub(super) fn extrapolate(&self, rows: &mut [Row]) {
        let Some((last, others)) = self.steps.split_last().filter(|(_, it)| !it.is_empty()) else {
            return;
        };
        let difference = |of: fn(&LimitStep) -> &DVector<f64>| {
            let columns: Vec<_> = others.iter().map(|other| of(last) - of(other)).collect();
            DMatrix::from_columns(&columns)
        };
        let bends = difference(|step| &step.change);
        let Ok(shares) = bends
            .svd(true, true)
            .solve(&last.change, MIN_SINGULAR_VALUE)
        else {
            return;
        };
        let limits = &last.found - difference(|step| &step.found) * shares;
        if limits.iter().all(|limit| limit.is_finite()) {
            for (row, limit) in rows.iter_mut().zip(&limits) {
                row.friction_limit = limit.max(0.0);
            }
        }
    }
}
