//! A symmetric matrix of blocks of three rows and columns, sparse as the mesh is.

use std::collections::BTreeSet;

use nalgebra::Matrix3;

use crate::V3;

/// One block for each pair of nodes that share an element, in the order of rows.
#[derive(Debug, Clone, Default)]
pub(crate) struct Blocks {
    /// Where the blocks of each row begin, and where the last row ends.
    starts: Vec<usize>,
    columns: Vec<usize>,
    /// Where the block on the diagonal is, for each row.
    diagonals: Vec<usize>,
    values: Vec<Matrix3<f64>>,
}

impl Blocks {
    /// The matrix of `nodes` nodes and elements of some of them.
    pub(crate) fn new<'a>(nodes: usize, elements: impl Iterator<Item = &'a [usize]>) -> Self {
        let mut rows: Vec<BTreeSet<usize>> =
            (0..nodes).map(|node| BTreeSet::from([node])).collect();
        for element in elements {
            for &node in element {
                rows[node].extend(element);
            }
        }
        let mut blocks = Self::default();
        for (row, columns) in rows.iter().enumerate() {
            blocks.starts.push(blocks.columns.len());
            blocks.columns.extend(columns);
            blocks
                .diagonals
                .push(blocks.starts[row] + columns.range(..row).count());
        }
        blocks.starts.push(blocks.columns.len());
        blocks.values = vec![Matrix3::zeros(); blocks.columns.len()];
        blocks
    }

    /// The columns of a row.
    pub(crate) fn columns(&self, row: usize) -> &[usize] {
        &self.columns[self.starts[row]..self.starts[row + 1]]
    }

    /// Where the block of two nodes is, which share an element.
    pub(crate) fn slot(&self, row: usize, column: usize) -> usize {
        let row = self.starts[row]..self.starts[row + 1];
        let columns = &self.columns[row.clone()];
        row.start + columns.partition_point(|known| *known < column)
    }

    /// Where the blocks of all pairs of an element's nodes are, row by row.
    pub(crate) fn slots<const N: usize>(&self, nodes: &[usize; N]) -> [[usize; N]; N] {
        nodes.map(|row| nodes.map(|column| self.slot(row, column)))
    }

    /// Number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.diagonals.len()
    }

    pub(crate) fn clear(&mut self) {
        self.values.fill(Matrix3::zeros());
    }

    pub(crate) fn add(&mut self, slot: usize, block: &Matrix3<f64>) {
        self.values[slot] += block;
    }

    pub(crate) fn add_to_diagonal(&mut self, node: usize, value: f64) {
        let block = &mut self.values[self.diagonals[node]];
        (0..3).for_each(|axis| block[(axis, axis)] += value);
    }

    pub(crate) fn diagonal(&self, node: usize) -> &Matrix3<f64> {
        &self.values[self.diagonals[node]]
    }

    /// Writes the product with a vector.
    pub(crate) fn multiply(&self, vector: &[V3], product: &mut [V3]) {
        for (row, out) in product.iter_mut().enumerate() {
            let blocks = self.starts[row]..self.starts[row + 1];
            let pairs = self.values[blocks.clone()]
                .iter()
                .zip(&self.columns[blocks]);
            *out = pairs.fold(V3::zeros(), |sum, (block, column)| {
                sum + block * vector[*column]
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_is_that_of_the_dense_matrix() {
        let elements: [&[usize]; 2] = [&[0, 1, 2], &[3, 1]];
        let mut blocks = Blocks::new(4, elements.into_iter());
        let block = Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
        blocks.add(blocks.slot(1, 3), &block);
        blocks.add(blocks.slots(&[2, 0])[0][1], &(block * 2.0));
        blocks.add_to_diagonal(3, 10.0);
        let vector = [V3::x(), V3::y(), V3::z(), V3::new(1.0, 1.0, 0.0)];
        let mut product = [V3::zeros(); 4];
        blocks.multiply(&vector, &mut product);
        assert_eq!(product[0], V3::zeros());
        assert_eq!(product[1], V3::new(3.0, 9.0, 15.0));
        assert_eq!(product[2], V3::new(2.0, 8.0, 14.0));
        assert_eq!(product[3], V3::new(10.0, 10.0, 0.0));
        blocks.clear();
        assert_eq!(*blocks.diagonal(3), Matrix3::zeros());
    }
}
