//! Symmetric positive definite systems of 6 x 6 blocks, most of which are zero.
//!
//! Cholesky's factorisation without square roots, `L D L^T`, block by block (A. George and J. Liu, *Computer Solution of Large Sparse Positive
//! Definite Systems*, 1981). The
//! fill-in is found once, symbolically; a tree eliminated from its leaves has none, and the cost is proportional to the number of joints.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{SMatrix, SVector};

pub(crate) type Block = SMatrix<f64, 6, 6>;
pub(crate) type Segment = SVector<f64, 6>;

/// The positions of the blocks: the lower triangle by columns.
#[derive(Default)]
pub(crate) struct Pattern {
    /// For every column: rows below the diagonal, rising, with the place of their block.
    columns: Vec<Vec<(usize, usize)>>,
    /// For every column: target, left and right block of `target -= left * right^T`.
    updates: Vec<Vec<(Place, usize, usize)>>,
    places: BTreeMap<(usize, usize), usize>,
}

/// The place of a block. Of those on the diagonal only the lower triangle counts.
#[derive(Clone, Copy)]
pub(crate) enum Place {
    Diagonal(usize),
    Below(usize),
}

impl Pattern {
    /// A pattern of `size` columns in which `pairs` of them are coupled; the order of the columns is the order of elimination.
    pub(crate) fn new(size: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let mut below = vec![BTreeSet::new(); size];
        for (a, b) in pairs.into_iter().filter(|(a, b)| a != b) {
            below[a.min(b)].insert(a.max(b));
        }
        let mut pattern = Self::default();
        for column in 0..size {
            let rows: Vec<usize> = below[column].iter().copied().collect();
            for (i, &first) in rows.iter().enumerate() {
                below[first].extend(&rows[i + 1..]);
            }
            pattern.push_column(column, &rows);
        }
        pattern.updates = (0..size).map(|column| pattern.updates_of(column)).collect();
        pattern
    }

    fn push_column(&mut self, column: usize, rows: &[usize]) {
        let first = self.places.len();
        self.places.extend(
            rows.iter()
                .enumerate()
                .map(|(i, &row)| ((row, column), first + i)),
        );
        self.columns.push(
            rows.iter()
                .enumerate()
                .map(|(i, &row)| (row, first + i))
                .collect(),
        );
    }

    fn updates_of(&self, column: usize) -> Vec<(Place, usize, usize)> {
        let rows = &self.columns[column];
        let mut updates = Vec::new();
        for (i, &(column, right)) in rows.iter().enumerate() {
            updates.push((Place::Diagonal(column), right, right));
            updates.extend(
                rows[i + 1..]
                    .iter()
                    .map(|&(row, left)| (Place::Below(self.places[&(row, column)]), left, right)),
            );
        }
        updates
    }

    /// The place of the block in `row` and `column`, the row being no less.
    ///
    /// # Panics
    /// When the two are not coupled.
    pub(crate) fn place(&self, row: usize, column: usize) -> Place {
        if row == column {
            Place::Diagonal(row)
        } else {
            Place::Below(self.places[&(row, column)])
        }
    }
}

/// A matrix of a pattern, or its factor.
#[derive(Default)]
pub(crate) struct Matrix {
    pub diagonal: Vec<Block>,
    pub below: Vec<Block>,
    /// Of the factor: one over its pivots.
    reciprocals: Vec<[f64; 6]>,
}

/// The factor of a block and one over its pivots; None when it is not positive definite. Below the diagonal the factor holds `L`, on it the
/// pivots `D`; what is above the diagonal is left.
#[allow(
    clippy::needless_range_loop,
    reason = "loops of fixed length become straight code, iterators do not"
)]
fn factor_of(block: &Block) -> Option<(Block, [f64; 6])> {
    let (mut factor, mut reciprocals) = (*block, [0.0; 6]);
    let columns = &mut factor.data.0;
    for column in 0..6 {
        for before in 0..column {
            let share = columns[before][column] * columns[before][before];
            for row in column..6 {
                columns[column][row] -= columns[before][row] * share;
            }
        }
        let pivot = columns[column][column];
        if pivot <= 0.0 || !pivot.is_finite() {
            return None;
        }
        reciprocals[column] = 1.0 / pivot;
        for row in column + 1..6 {
            columns[column][row] *= reciprocals[column];
        }
    }
    Some((factor, reciprocals))
}

/// Solves `x D L^T = x` in place, column by column.
#[allow(
    clippy::needless_range_loop,
    reason = "loops of fixed length become straight code, iterators do not"
)]
fn divide_by_upper(factor: &Block, reciprocals: &[f64; 6], x: &mut Block) {
    let columns = &mut x.data.0;
    for column in 0..6 {
        for before in 0..column {
            let share = factor.data.0[before][column];
            for row in 0..6 {
                columns[column][row] -= columns[before][row] * share;
            }
        }
    }
    for column in 0..6 {
        columns[column]
            .iter_mut()
            .for_each(|x| *x *= reciprocals[column]);
    }
}

/// `target -= block D block^T`, its lower triangle; `factor` holds the pivots.
#[allow(
    clippy::needless_range_loop,
    reason = "loops of fixed length become straight code, iterators do not"
)]
fn subtract_lower_square(target: &mut Block, block: &Block, factor: &Block) {
    for inner in 0..6 {
        for column in 0..6 {
            let share = block.data.0[inner][column] * factor.data.0[inner][inner];
            for row in column..6 {
                target.data.0[column][row] -= block.data.0[inner][row] * share;
            }
        }
    }
}

/// Solves `L x = x` in place.
#[allow(
    clippy::needless_range_loop,
    reason = "loops of fixed length become straight code, iterators do not"
)]
fn solve_lower(factor: &Block, x: &mut [f64; 6]) {
    for column in 0..5 {
        for row in column + 1..6 {
            x[row] -= factor.data.0[column][row] * x[column];
        }
    }
}

/// Solves `L^T x = x` in place.
#[allow(
    clippy::needless_range_loop,
    reason = "loops of fixed length become straight code, iterators do not"
)]
fn solve_upper(factor: &Block, x: &mut [f64; 6]) {
    for column in (0..5).rev() {
        for row in column + 1..6 {
            x[column] -= factor.data.0[column][row] * x[row];
        }
    }
}

impl Matrix {
    /// Zero everywhere.
    pub(crate) fn clear(&mut self, pattern: &Pattern) {
        self.diagonal.clear();
        self.diagonal.resize(pattern.columns.len(), Block::zeros());
        self.below.clear();
        self.below.resize(pattern.places.len(), Block::zeros());
    }

    /// Replaces the matrix by its factor; false when it is not positive definite.
    pub(crate) fn factorize(&mut self, pattern: &Pattern) -> bool {
        self.reciprocals.clear();
        for column in 0..pattern.columns.len() {
            let Some((factor, reciprocals)) = factor_of(&self.diagonal[column]) else {
                return false;
            };
            self.diagonal[column] = factor;
            self.reciprocals.push(reciprocals);
            for &(_, place) in &pattern.columns[column] {
                divide_by_upper(&factor, &reciprocals, &mut self.below[place]);
            }
            for &(target, left, right) in &pattern.updates[column] {
                match target {
                    Place::Diagonal(row) => {
                        subtract_lower_square(&mut self.diagonal[row], &self.below[left], &factor);
                    }
                    Place::Below(place) => {
                        let mut scaled = self.below[left];
                        (0..6).for_each(|column| {
                            scaled.data.0[column]
                                .iter_mut()
                                .for_each(|x| *x *= factor.data.0[column][column]);
                        });
                        let product = scaled * self.below[right].transpose();
                        self.below[place] -= product;
                    }
                }
            }
        }
        true
    }

    /// Whether it is a factor, with which systems can be solved.
    pub(crate) fn is_factor(&self) -> bool {
        self.reciprocals.len() == self.diagonal.len()
    }

    /// Solves `L D^(1/2) x = x` for six right-hand sides at once; None stands for zeros.
    pub(crate) fn carry(&self, pattern: &Pattern, x: &mut [Option<Block>]) {
        for column in 0..pattern.columns.len() {
            let Some(mut solved) = x[column] else {
                continue;
            };
            let (factor, reciprocals) = (&self.diagonal[column], &self.reciprocals[column]);
            solved
                .data
                .0
                .iter_mut()
                .for_each(|x| solve_lower(factor, x));
            for &(row, place) in &pattern.columns[column] {
                *x[row].get_or_insert_with(Block::zeros) -= self.below[place] * solved;
            }
            let scale = reciprocals.map(f64::sqrt);
            solved
                .data
                .0
                .iter_mut()
                .for_each(|x| x.iter_mut().zip(scale).for_each(|(x, scale)| *x *= scale));
            x[column] = Some(solved);
        }
    }

    /// Solves the system whose factor this is; `x` is the right-hand side first, the solution then.
    pub(crate) fn solve(&self, pattern: &Pattern, x: &mut [Segment]) {
        for column in 0..pattern.columns.len() {
            solve_lower(&self.diagonal[column], &mut x[column].data.0[0]);
            for &(row, place) in &pattern.columns[column] {
                let known = self.below[place] * x[column];
                x[row] -= known;
            }
        }
        for column in (0..pattern.columns.len()).rev() {
            x[column]
                .iter_mut()
                .zip(self.reciprocals[column])
                .for_each(|(x, reciprocal)| *x *= reciprocal);
            for &(row, place) in &pattern.columns[column] {
                let known = self.below[place].transpose() * x[row];
                x[column] -= known;
            }
            solve_upper(&self.diagonal[column], &mut x[column].data.0[0]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring of four with a chord: elimination fills blocks in.
    const PAIRS: [(usize, usize); 5] = [(0, 1), (1, 2), (2, 3), (3, 0), (1, 4)];

    fn entry(i: usize, j: usize) -> f64 {
        ((i * 7 + j * 13) % 11) as f64 / 11.0 - 0.5
    }

    #[test]
    fn the_solution_solves_the_dense_system() {
        let pattern = Pattern::new(5, PAIRS);
        let mut matrix = Matrix::default();
        matrix.clear(&pattern);
        let mut dense = nalgebra::DMatrix::<f64>::identity(30, 30) * 20.0;
        for i in 0..5 {
            matrix.diagonal[i] = Block::identity() * 20.0;
        }
        for (a, b) in PAIRS {
            let (row, column) = (a.max(b), a.min(b));
            let block = Block::from_fn(|i, j| entry(i + row, j + column));
            if let Place::Below(place) = pattern.place(row, column) {
                matrix.below[place] = block;
            }
            dense
                .view_mut((row * 6, column * 6), (6, 6))
                .copy_from(&block);
            dense
                .view_mut((column * 6, row * 6), (6, 6))
                .copy_from(&block.transpose());
        }
        let right = nalgebra::DVector::from_fn(30, |i, _| entry(i, 3));
        let mut x: Vec<Segment> = (0..5)
            .map(|i| Segment::from_fn(|j, _| right[i * 6 + j]))
            .collect();
        assert!(matrix.factorize(&pattern));
        matrix.solve(&pattern, &mut x);
        let x = nalgebra::DVector::from_fn(30, |i, _| x[i / 6][i % 6]);
        assert!((dense * x - right).norm() < 1e-12);
    }
}
