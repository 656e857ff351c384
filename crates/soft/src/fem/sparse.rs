//! A sparse symmetric matrix of numbers.

use std::collections::BTreeMap;

use crate::V3;

/// Rows of numbers with their columns.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sparse {
    /// Where each row begins, and where the last one ends.
    starts: Vec<usize>,
    entries: Vec<(usize, f64)>,
}

impl Sparse {
    /// A matrix of so many rows, by row and column.
    pub(crate) fn new(rows: usize, entries: BTreeMap<[usize; 2], f64>) -> Self {
        let mut sparse = Self {
            starts: vec![0; rows + 1],
            entries: Vec::new(),
        };
        for ([row, column], value) in entries {
            sparse.starts[row + 1] += 1;
            sparse.entries.push((column, value));
        }
        for row in 0..rows {
            sparse.starts[row + 1] += sparse.starts[row];
        }
        sparse
    }

    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    fn row(&self, row: usize) -> &[(usize, f64)] {
        &self.entries[self.starts[row]..self.starts[row + 1]]
    }

    /// The product of a row with a vector, for each of three directions.
    pub(crate) fn row_times(&self, row: usize, vector: &[V3]) -> V3 {
        let entries = self.row(row).iter();
        entries.fold(V3::zeros(), |sum, (column, value)| {
            sum + vector[*column] * *value
        })
    }

    pub(crate) fn diagonal(&self, row: usize) -> f64 {
        let own = self.row(row).iter().find(|(column, _)| *column == row);
        own.map_or(0.0, |(_, value)| *value)
    }
}
