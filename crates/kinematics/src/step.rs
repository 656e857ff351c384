//! The step of one group: from errors to changes of joints.

use nalgebra::{DMatrix, DVector};

use crate::environment::Environment;
use crate::equations::{JacobianColumn, JacobianRow};
use crate::error::Result;
use crate::group::{Constraints, Group, Method};
use crate::joint::{JointType, wrapped};
use crate::least_squares::{Problem, Scratch};
use crate::solver::Revision;

/// Damping of [`Method::PseudoInverse`].
const PSEUDO_INVERSE_DAMPING: f64 = 1e-6;

pub(crate) struct Solved {
    pub step: Vec<f64>,
    pub used: Option<DMatrix<f64>>,
}

/// One group's step from its errors.
pub(crate) struct Step<'a> {
    pub group: &'a Group,
    pub jacobian: &'a [f64],
    pub columns: &'a [JacobianColumn],
    pub revision: &'a Revision,
}

impl Step<'_> {
    /// None where it cannot be computed. `J+ J` comes with it where other groups come after this one.
    pub fn solve(
        &self,
        env: &Environment,
        errors: &[f64],
        with_used: bool,
        scratch: &mut Scratch,
    ) -> Result<Option<Solved>> {
        let transpose = self.group.method == Method::JacobianTranspose;
        let roots = if transpose {
            None
        } else {
            roots_of_weights(env, self.columns)?
        };
        let scaled = roots.as_ref().map(|roots| scaled(self.jacobian, roots));
        let jacobian = scaled.as_deref().unwrap_or(self.jacobian);
        let problem = Problem {
            jacobian,
            columns: self.columns.len(),
            damping: self.damping(),
        };
        let inverse = self.own_inverse(errors.len());
        let inverse = inverse.or_else(|| {
            if with_used {
                with_roots(problem.inverse()?, roots.as_deref())
            } else {
                None
            }
        });
        let mut step = Vec::new();
        match (&self.revision.step, &inverse) {
            (Some(own), _) => step.clone_from(own),
            (None, Some(inverse)) => {
                step.extend((inverse * DVector::from_column_slice(errors)).iter());
            }
            (None, None) if !problem.solve(errors, &mut step, scratch) => return Ok(None),
            (None, None) => step
                .iter_mut()
                .zip(roots.iter().flatten())
                .for_each(|(dq, root)| *dq *= root),
        }
        self.wrap(env, &mut step)?;
        let jacobian = || DMatrix::from_row_slice(errors.len(), self.columns.len(), self.jacobian);
        let used = inverse
            .filter(|_| with_used)
            .map(|inverse| inverse * jacobian());
        Ok(Some(Solved { step, used }))
    }

    fn damping(&self) -> f64 {
        match self.group.method {
            Method::PseudoInverse => PSEUDO_INVERSE_DAMPING,
            Method::DampedLeastSquares => self.group.damping,
            Method::JacobianTranspose | Method::UndampedPseudoInverse => 0.0,
        }
    }

    /// The inverse that needs no computation: a callback's, or the transpose.
    fn own_inverse(&self, rows: usize) -> Option<DMatrix<f64>> {
        match &self.revision.inverse {
            Some(inverse) => Some(DMatrix::from_row_slice(self.columns.len(), rows, inverse)),
            None if self.group.method == Method::JacobianTranspose => Some(
                DMatrix::from_column_slice(self.columns.len(), rows, self.jacobian),
            ),
            None => None,
        }
    }

    /// Brings steps of revolute joints within half a turn.
    fn wrap(&self, env: &Environment, step: &mut [f64]) -> Result<()> {
        for (dq, column) in step.iter_mut().zip(self.columns) {
            if dq.is_finite() && env.joint(column.joint)?.joint_type == JointType::Revolute {
                *dq = wrapped(*dq);
            }
        }
        Ok(())
    }
}

fn with_roots(mut inverse: DMatrix<f64>, roots: Option<&[f64]>) -> Option<DMatrix<f64>> {
    for (i, root) in roots.into_iter().flatten().enumerate() {
        inverse.row_mut(i).scale_mut(*root);
    }
    Some(inverse)
}

/// Roots of the joint weights; None where all weights are 1.
fn roots_of_weights(env: &Environment, columns: &[JacobianColumn]) -> Result<Option<Vec<f64>>> {
    let weight = |column: &JacobianColumn| env.joint(column.joint).map(|joint| joint.weight);
    let mut different = false;
    for column in columns {
        different |= weight(column)? != 1.0;
    }
    let roots = || {
        columns
            .iter()
            .map(|column| weight(column).map(|weight| weight.max(0.0).sqrt()))
            .collect()
    };
    different.then(roots).transpose()
}

fn scaled(jacobian: &[f64], roots: &[f64]) -> Vec<f64> {
    let rows = jacobian.chunks_exact(roots.len());
    rows.flat_map(|row| row.iter().zip(roots).map(|(j, root)| j * root))
        .collect()
}

/// Multiplies errors by the weights of their elements.
pub(crate) fn weigh(group: &Group, rows: &[JacobianRow], errors: &mut [f64]) {
    for (row, error) in rows.iter().zip(errors) {
        let JacobianRow::Constraint {
            element,
            constraint,
        } = row
        else {
            continue;
        };
        if let Some(element) = &group.elements[element.0] {
            let kind = usize::from(constraint.intersects(Constraints::ORIENTATION));
            *error *= element.weights[kind] * element.weights[2];
        }
    }
}

/// Largest ratio of a step to what is allowed.
pub(crate) fn too_big(env: &Environment, columns: &[JacobianColumn], step: &[f64]) -> Result<f64> {
    let mut largest = 0.0_f64;
    for (column, dq) in columns.iter().zip(step) {
        let joint = env.joint(column.joint)?;
        if joint.max_step > 0.0 {
            largest = largest.max(dq.abs() / joint.max_step);
        }
    }
    Ok(largest)
}
