//! Symmetric positive definite matrices with entries near the diagonal only.

use nalgebra::Matrix3;

/// Number of entries beside the diagonal. Three nodes with the angles between them are coupled: eleven unknowns in a row.
pub(crate) const HALF: usize = 10;
const WIDTH: usize = HALF + 1;

/// The lower half, by rows: the last entry of a row is that on the diagonal.
#[derive(Debug, Clone, Default)]
pub(crate) struct Banded {
    rows: Vec<[f64; WIDTH]>,
}

impl Banded {
    /// A matrix of zeros.
    pub(crate) fn clear(&mut self, size: usize) {
        self.rows.clear();
        self.rows.resize(size, [0.0; WIDTH]);
    }

    /// Adds to an entry on or below the diagonal, and so to its mirror image.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][HALF + column - row] += value;
    }

    /// Adds `factor` times a vector times itself, the first entry of which stands at `base`.
    pub(crate) fn add_square<const N: usize>(
        &mut self,
        base: usize,
        vector: &[f64; N],
        factor: f64,
    ) {
        for (row, &left) in vector.iter().enumerate() {
            let left = left * factor;
            let entries = &mut self.rows[base + row][HALF - row..=HALF];
            for (entry, right) in entries.iter_mut().zip(vector) {
                *entry += left * right;
            }
        }
    }

    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// An entry near the diagonal.
    pub(crate) fn get(&self, row: usize, column: usize) -> f64 {
        let (low, high) = (row.min(column), row.max(column));
        self.rows[high][HALF + low - high]
    }

    /// Adds a symmetric block on the diagonal that begins at `base`.
    pub(crate) fn add_block(&mut self, base: usize, block: &Matrix3<f64>) {
        for row in 0..3 {
            for column in 0..=row {
                self.add(base + row, base + column, block[(row, column)]);
            }
        }
    }

    /// Writes the product with a vector.
    pub(crate) fn multiply(&self, vector: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        for (row, entries) in self.rows.iter().enumerate() {
            let first = HALF.saturating_sub(row);
            for (entry, column) in entries[first..HALF].iter().zip(row + first - HALF..row) {
                product[row] += entry * vector[column];
                product[column] += entry * vector[row];
            }
            product[row] += entries[HALF] * vector[row];
        }
    }

    /// Cholesky's factorisation, in place; false if the matrix is not positive definite.
    pub(crate) fn factorize(&mut self) -> bool {
        for row in 0..self.rows.len() {
            let (above, here) = self.rows.split_at_mut(row);
            let here = &mut here[0];
            let first = HALF.saturating_sub(row);
            for column in first..HALF {
                // Entries of this row and of that one which stand in the same columns.
                let other = &above[row + column - HALF];
                let shift = HALF - column;
                let known = here[first..column].iter().zip(&other[first + shift..]);
                let sum: f64 = known.map(|(a, b)| a * b).sum();
                here[column] = (here[column] - sum) / other[HALF];
            }
            let sum: f64 = here[first..HALF].iter().map(|x| x * x).sum();
            let rest = here[HALF] - sum;
            if rest.is_nan() || rest <= 0.0 {
                return false;
            }
            here[HALF] = rest.sqrt();
        }
        true
    }

    /// Solves for a right side, in place, with the factors.
    pub(crate) fn solve(&self, x: &mut [f64]) {
        for (row, entries) in self.rows.iter().enumerate() {
            let first = HALF.saturating_sub(row);
            let known = &x[row + first - HALF..row];
            let sum: f64 = known
                .iter()
                .zip(&entries[first..])
                .map(|(x, a)| x * a)
                .sum();
            x[row] = (x[row] - sum) / entries[HALF];
        }
        for (row, entries) in self.rows.iter().enumerate().rev() {
            let first = HALF.saturating_sub(row);
            let value = x[row] / entries[HALF];
            x[row] = value;
            let above = &mut x[row + first - HALF..row];
            for (x, a) in above.iter_mut().zip(&entries[first..]) {
                *x -= a * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_multiplied_is_solved_again() {
        let size = 30;
        let mut matrix = Banded::default();
        matrix.clear(size);
        let mut next = 1.0_f64;
        let mut random = || {
            next = (next * 16807.0) % 2147483647.0;
            next / 2147483647.0 - 0.5
        };
        for base in 0..=size - WIDTH {
            let vector: [f64; WIDTH] = std::array::from_fn(|_| random());
            matrix.add_square(base, &vector, 2.0);
        }
        (0..size).for_each(|row| matrix.add(row, row, 0.1));
        let x: Vec<f64> = (0..size).map(|_| random()).collect();
        let entry = |row: usize, column: usize| {
            let (low, high) = (row.max(column), row.min(column));
            if low - high > HALF {
                return 0.0;
            }
            matrix.rows[low][HALF + high - low]
        };
        let mut right: Vec<f64> = (0..size)
            .map(|row| (0..size).map(|column| entry(row, column) * x[column]).sum())
            .collect();
        let mut factors = matrix.clone();
        assert!(factors.factorize());
        factors.solve(&mut right);
        for (a, b) in right.iter().zip(&x) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
    }

    #[test]
    fn what_is_not_positive_is_refused() {
        let mut matrix = Banded::default();
        matrix.clear(2);
        matrix.add(0, 0, 1.0);
        matrix.add(1, 0, 2.0);
        matrix.add(1, 1, 1.0);
        assert!(!matrix.factorize());
    }
}
