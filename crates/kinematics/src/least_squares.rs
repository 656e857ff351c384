//! `dq = W Jt (J W Jt + l^2 I)+ e` for small matrices, stored row by row.
//!
//! The smaller one of `J Jt` and `Jt J` is factorised by Cholesky. Where its pivots differ so much that digits would be lost (singular
//! postures without damping), singular values are used instead; those that are zero to rounding contribute nothing.

use nalgebra::{DMatrix, DVector, SVD};

/// Ratio of pivots below which Cholesky is not exact enough.
const MIN_PIVOT_RATIO: f64 = 1e-9;

/// Buffers that are used again.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    normal: Vec<f64>,
    right: Vec<f64>,
}

/// A Jacobian whose columns are scaled by the roots of the joint weights.
pub(crate) struct Problem<'a> {
    pub jacobian: &'a [f64],
    pub columns: usize,
    pub damping: f64,
}

impl Problem<'_> {
    fn rows(&self) -> usize {
        self.jacobian.len() / self.columns
    }

    /// The step for `errors`, in `step`; false where there is none: numbers are not finite.
    pub fn solve(&self, errors: &[f64], step: &mut Vec<f64>, scratch: &mut Scratch) -> bool {
        let solved = if self.rows() <= self.columns {
            self.by_rows(errors, step, scratch)
        } else {
            self.by_columns(errors, step, scratch)
        };
        solved || self.by_singular_values(errors, step)
    }

    /// `Jt (J Jt + l^2)^-1 e`
    fn by_rows(&self, errors: &[f64], step: &mut Vec<f64>, scratch: &mut Scratch) -> bool {
        let (rows, n) = (self.rows(), self.columns);
        scratch.normal.clear();
        scratch.normal.resize(rows * rows, 0.0);
        for i in 0..rows {
            let a = &self.jacobian[i * n..(i + 1) * n];
            for j in 0..=i {
                let b = &self.jacobian[j * n..(j + 1) * n];
                scratch.normal[i * rows + j] = a.iter().zip(b).map(|(x, y)| x * y).sum();
            }
            scratch.normal[i * rows + i] += self.damping * self.damping;
        }
        scratch.right.clear();
        scratch.right.extend_from_slice(errors);
        if !solve_in_place(&mut scratch.normal, &mut scratch.right) {
            return false;
        }
        step.clear();
        step.resize(n, 0.0);
        for (row, x) in self.jacobian.chunks_exact(n).zip(&scratch.right) {
            step.iter_mut().zip(row).for_each(|(dq, j)| *dq += j * x);
        }
        true
    }

    /// `(Jt J + l^2)^-1 Jt e`
    fn by_columns(&self, errors: &[f64], step: &mut Vec<f64>, scratch: &mut Scratch) -> bool {
        let n = self.columns;
        scratch.normal.clear();
        scratch.normal.resize(n * n, 0.0);
        step.clear();
        step.resize(n, 0.0);
        for (row, error) in self.jacobian.chunks_exact(n).zip(errors) {
            for i in 0..n {
                step[i] += row[i] * error;
                (0..=i).for_each(|j| scratch.normal[i * n + j] += row[i] * row[j]);
            }
        }
        (0..n).for_each(|i| scratch.normal[i * n + i] += self.damping * self.damping);
        solve_in_place(&mut scratch.normal, step)
    }

    fn by_singular_values(&self, errors: &[f64], step: &mut Vec<f64>) -> bool {
        let Some(inverse) = self.inverse() else {
            return false;
        };
        step.clear();
        step.extend((inverse * DVector::from_column_slice(errors)).iter());
        step.iter().all(|x| x.is_finite())
    }

    /// The damped pseudo-inverse as a matrix; None where numbers are not finite.
    pub fn inverse(&self) -> Option<DMatrix<f64>> {
        if !self.jacobian.iter().all(|x| x.is_finite()) {
            return None;
        }
        let matrix = DMatrix::from_row_slice(self.rows(), self.columns, self.jacobian);
        let svd = SVD::try_new(matrix, true, true, f64::EPSILON, 1000)?;
        let largest = svd.singular_values.iter().fold(0.0_f64, |a, b| a.max(*b));
        let cut = largest * largest * f64::EPSILON * self.rows().max(self.columns) as f64;
        let inverted = svd.singular_values.map(|s| {
            let square = s * s + self.damping * self.damping;
            if square > cut { s / square } else { 0.0 }
        });
        Some(svd.v_t?.transpose() * DMatrix::from_diagonal(&inverted) * svd.u?.transpose())
    }
}

/// Solves a symmetric positive definite system whose lower triangle is given; false where the pivots are too different.
pub(crate) fn solve_in_place(matrix: &mut [f64], right: &mut [f64]) -> bool {
    factorise(matrix, right.len()) && {
        substitute(matrix, right);
        true
    }
}

/// Cholesky's factor in place of the lower triangle, with inverted diagonal.
fn factorise(matrix: &mut [f64], n: usize) -> bool {
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
    for i in 0..n {
        let (above, rest) = matrix.split_at_mut(i * n);
        let row = &mut rest[..n];
        for j in 0..i {
            let other = &above[j * n..j * n + j + 1];
            let sum: f64 = (0..j).map(|k| row[k] * other[k]).sum();
            row[j] = (row[j] - sum) * other[j];
        }
        let pivot = row[i] - row[..i].iter().map(|x| x * x).sum::<f64>();
        (smallest, largest) = (smallest.min(pivot), largest.max(pivot));
        // Not `<=`: what is not a number is refused.
        if !(pivot > largest * MIN_PIVOT_RATIO && pivot < f64::INFINITY) {
            return false;
        }
        row[i] = 1.0 / pivot.sqrt();
    }
    smallest > largest * MIN_PIVOT_RATIO
}

fn substitute(factor: &[f64], right: &mut [f64]) {
    let n = right.len();
    for i in 0..n {
        let sum: f64 = (0..i).map(|k| factor[i * n + k] * right[k]).sum();
        right[i] = (right[i] - sum) * factor[i * n + i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|k| factor[k * n + i] * right[k]).sum();
        right[i] = (right[i] - sum) * factor[i * n + i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(jacobian: &[f64], columns: usize, damping: f64, errors: &[f64]) -> Option<Vec<f64>> {
        let mut step = Vec::new();
        let problem = Problem {
            jacobian,
            columns,
            damping,
        };
        problem
            .solve(errors, &mut step, &mut Scratch::default())
            .then_some(step)
    }

    #[track_caller]
    fn close(a: &[f64], b: &[f64]) {
        assert!(
            a.len() == b.len() && a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9),
            "{a:?} is not {b:?}"
        );
    }

    #[test]
    fn both_forms_and_singular_values_agree() {
        let wide = [1.0, 2.0, 0.5, -1.0, 0.3, 2.0];
        let errors = [0.1, -0.2];
        for damping in [0.0, 0.1, 1.0] {
            let problem = Problem {
                jacobian: &wide,
                columns: 3,
                damping,
            };
            let expected = problem.inverse().unwrap() * DVector::from_column_slice(&errors);
            close(
                &step(&wide, 3, damping, &errors).unwrap(),
                expected.as_slice(),
            );
        }
        let tall = [1.0, -1.0, 2.0, 0.3, 0.5, 2.0];
        for damping in [0.0, 0.1] {
            let problem = Problem {
                jacobian: &tall,
                columns: 2,
                damping,
            };
            let expected =
                problem.inverse().unwrap() * DVector::from_column_slice(&[0.1, 0.2, 0.3]);
            close(
                &step(&tall, 2, damping, &[0.1, 0.2, 0.3]).unwrap(),
                expected.as_slice(),
            );
        }
    }

    #[test]
    fn a_singular_matrix_has_the_shortest_step() {
        close(
            &step(&[1.0, 1.0, 1.0, 1.0], 2, 0.0, &[1.0, 1.0]).unwrap(),
            &[0.5, 0.5],
        );
        close(
            &step(&[1.0, 1.0, 1.0, 1.0], 2, 0.0, &[1.0, -1.0]).unwrap(),
            &[0.0, 0.0],
        );
        close(&step(&[0.0; 4], 2, 0.0, &[1.0, -1.0]).unwrap(), &[0.0, 0.0]);
    }

    #[test]
    fn numbers_that_are_not_finite_have_no_step() {
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(step(&[bad, 0.0, 0.0, 1.0], 2, 0.1, &[1.0, 1.0]), None);
        }
    }
}
