//! Rods taken out of the equations that they have in common.

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

use crate::assembly::{Border, Equations};
use crate::banded::Banded;

/// Takes a rod out of the common equations; its border by the inverse of its matrix.
pub(crate) fn condense(
    equations: &mut Equations,
    matrix: &mut DMatrix<f64>,
    right: &mut DVector<f64>,
) -> Vec<Border> {
    let Equations {
        matrix: factors,
        gradient,
        border,
    } = equations;
    factors.solve(gradient);
    let solved: Vec<Border> = border
        .iter()
        .map(|border| Border {
            columns: border.columns.clone(),
            rows: solve_columns(factors, border),
        })
        .collect();
    for first in border.iter() {
        for (row, known) in first.rows.iter().zip(gradient.iter()) {
            for (place, value) in first.columns.clone().zip(row) {
                right[place] += value * known;
            }
        }
        for second in &solved {
            subtract_product(first, second, matrix);
        }
    }
    solved
}

fn subtract_product(first: &Border, second: &Border, matrix: &mut DMatrix<f64>) {
    let mut product = Matrix6::zeros();
    let is_used = |(row, _): &(&[f64; 6], &[f64; 6])| row.iter().any(|value| *value != 0.0);
    for (row, other) in first.rows.iter().zip(&second.rows).filter(is_used) {
        product += Vector6::from(*row) * Vector6::from(*other).transpose();
    }
    for (i, row) in first.columns.clone().enumerate() {
        for (j, column) in second.columns.clone().enumerate() {
            matrix[(row, column)] -= product[(i, j)];
        }
    }
}

fn solve_columns(factors: &Banded, border: &Border) -> Vec<[f64; 6]> {
    let mut solved = border.rows.clone();
    for axis in 0..border.columns.len() {
        let mut column: Vec<f64> = border.rows.iter().map(|row| row[axis]).collect();
        factors.solve(&mut column);
        for (row, value) in solved.iter_mut().zip(column) {
            row[axis] = value;
        }
    }
    solved
}

/// The change of a rod's unknowns, once the common ones are known.
pub(crate) fn change_of(
    equations: &Equations,
    borders: &[Border],
    common: &DVector<f64>,
) -> Vec<f64> {
    let mut change: Vec<f64> = equations.gradient.iter().map(|x| -x).collect();
    for border in borders {
        for (entry, row) in change.iter_mut().zip(&border.rows) {
            for (place, value) in border.columns.clone().zip(row) {
                *entry -= value * common[place];
            }
        }
    }
    change
}
