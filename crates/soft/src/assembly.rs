//! The equations of a step: of each rod, and of the bodies that it is coupled with.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix3x6, Matrix6, Vector6};

use crate::V3;
use crate::banded::Banded;

/// The equations of one rod, linearised: `matrix` times the change of the unknowns is minus `gradient`.
#[derive(Default)]
pub(crate) struct Equations {
    pub matrix: Banded,
    pub gradient: Vec<f64>,
    /// The columns of common unknowns.
    pub border: Vec<Border>,
}

/// What of a rod's equations stands in the columns of some common unknowns: the displacement of a body, or of a contact of two rods.
pub(crate) struct Border {
    /// Their place among all common unknowns.
    pub columns: std::ops::Range<usize>,
    pub rows: Vec<[f64; 6]>,
}

impl Equations {
    pub(crate) fn clear(&mut self, nodes: usize) {
        self.matrix.clear(4 * nodes);
        self.gradient.clear();
        self.gradient.resize(4 * nodes, 0.0);
        self.border.clear();
    }

    /// A quantity with a gradient that begins at `base`: the force against it, and its stiffness.
    pub(crate) fn add_spring<const N: usize>(
        &mut self,
        base: usize,
        gradient: &[f64; N],
        force: f64,
        stiffness: f64,
    ) {
        for (entry, part) in self.gradient[base..].iter_mut().zip(gradient) {
            *entry += part * force;
        }
        self.matrix.add_square(base, gradient, stiffness);
    }

    /// A force on points of nodes, given with their weights, and its stiffness.
    pub(crate) fn add_push(
        &mut self,
        nodes: &[(usize, f64)],
        force: &V3,
        stiffness: &Matrix3<f64>,
    ) {
        for &(node, weight) in nodes {
            for axis in 0..3 {
                self.gradient[4 * node + axis] -= weight * force[axis];
            }
            for &(other, other_weight) in nodes.iter().filter(|(other, _)| *other <= node) {
                let factor = weight * other_weight;
                for row in 0..3 {
                    let most = if other == node { row } else { 2 };
                    for column in 0..=most {
                        let value = factor * stiffness[(row, column)];
                        self.matrix.add(4 * node + row, 4 * other + column, value);
                    }
                }
            }
        }
    }

    /// Adds to a row in the columns of common unknowns.
    pub(crate) fn add_to_border(
        &mut self,
        columns: std::ops::Range<usize>,
        row: usize,
        values: &[f64],
    ) {
        let is_known = |border: &Border| border.columns == columns;
        let place = self.border.iter().position(is_known);
        let place = place.unwrap_or_else(|| {
            let rows = vec![[0.0; 6]; self.gradient.len()];
            self.border.push(Border { columns, rows });
            self.border.len() - 1
        });
        for (entry, value) in self.border[place].rows[row].iter_mut().zip(values) {
            *entry += value;
        }
    }
}

/// How the displacement of a point of a body depends on that of the body.
pub(crate) fn lever_map(lever: &V3) -> Matrix3x6<f64> {
    let mut map = Matrix3x6::zeros();
    map.fixed_view_mut::<3, 3>(0, 0)
        .copy_from(&Matrix3::identity());
    map.fixed_view_mut::<3, 3>(0, 3)
        .copy_from(&-lever.cross_matrix());
    map
}

/// The equations of what rods have in common: bodies, six unknowns each, and then contacts of rods with each other, three each.
pub(crate) struct CommonEquations {
    pub bodies: Vec<(Matrix6<f64>, Vector6<f64>)>,
    pub contacts: usize,
}

impl CommonEquations {
    /// Number of unknowns.
    pub(crate) fn len(&self) -> usize {
        6 * self.bodies.len() + 3 * self.contacts
    }

    /// The columns of a body.
    pub(crate) fn columns_of(body: usize) -> std::ops::Range<usize> {
        6 * body..6 * body + 6
    }

    /// The columns of one more contact between rods.
    pub(crate) fn add_contact(&mut self) -> std::ops::Range<usize> {
        self.contacts += 1;
        self.len() - 3..self.len()
    }

    /// Matrix and right side, without what comes from the rods.
    pub(crate) fn system(&self) -> (DMatrix<f64>, DVector<f64>) {
        let size = self.len();
        // An elastic contact is an unknown force: the negative identity is its compliance.
        let mut matrix = -DMatrix::identity(size, size);
        let mut right = DVector::zeros(size);
        for (body, (own, gradient)) in self.bodies.iter().enumerate() {
            let mut block = matrix.fixed_view_mut::<6, 6>(6 * body, 6 * body);
            block.copy_from(own);
            right.fixed_rows_mut::<6>(6 * body).copy_from(&-gradient);
        }
        (matrix, right)
    }
}
