//! Mirrored, repeated and copied regions; rows and columns combined to one.

use super::{Depth, Matrix, MatrixError, MatrixResult, Value, Values, value_count, with_values};

/// What is mirrored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flip {
    /// Left and right change places.
    Columns,
    /// The first and the last rows change places.
    Rows,
    /// Both.
    Both,
}

/// How the values of a row or a column become one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reduction {
    /// Their sum.
    Sum,
    /// Their mean.
    Average,
    /// The largest one.
    Largest,
    /// The smallest one.
    Smallest,
}

impl Matrix {
    /// The mirrored image.
    pub fn flipped(&self, flip: Flip) -> Self {
        let from = |at: usize, size: usize, turned: bool| if turned { size - 1 - at } else { at };
        self.rearranged(self.size(), |column, row| {
            [
                from(column, self.width, flip != Flip::Rows),
                from(row, self.height, flip != Flip::Columns),
            ]
        })
    }

    /// The image beside itself.
    ///
    /// # Errors
    /// When there is none, or more than an image can have.
    pub fn repeated(&self, counts: [usize; 2]) -> MatrixResult<Self> {
        let size = [
            self.width.saturating_mul(counts[0]),
            self.height.saturating_mul(counts[1]),
        ];
        value_count(size, self.channels)?;
        Ok(self.rearranged(size, |column, row| [column % self.width, row % self.height]))
    }

    /// An image of pixels that are each taken from a place of this one.
    pub(super) fn rearranged(
        &self,
        size: [usize; 2],
        source: impl Fn(usize, usize) -> [usize; 2],
    ) -> Self {
        let [width, height] = size;
        let channels = self.channels;
        let from = |column, row| {
            let [x, y] = source(column, row);
            (y * self.width + x) * channels
        };
        let firsts = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
        let values = with_values!(self, values => {
            let mut out = Vec::with_capacity(width * height * channels);
            firsts.for_each(|(column, row)| {
                let first = from(column, row);
                out.extend_from_slice(&values[first..first + channels]);
            });
            out
        });
        Self {
            width,
            height,
            channels,
            values,
        }
    }

    /// Copies a region of another image into this one.
    ///
    /// # Errors
    /// When the region is not inside of both, or their formats differ.
    pub fn copy_from(
        &mut self,
        source: &Self,
        from: [i64; 2],
        to: [i64; 2],
        size: [i64; 2],
    ) -> MatrixResult<()> {
        if self.format() != source.format() {
            return Err(MatrixError::Mismatch);
        }
        let [from, to] = [source.region(from, size)?, self.region(to, size)?];
        let [columns, rows] = size.map(numbers::place_of);
        let length = columns * self.channels;
        for row in 0..rows {
            let first = ((from[1] + row) * source.width + from[0]) * self.channels;
            let target = ((to[1] + row) * self.width + to[0]) * self.channels;
            match (&mut self.values, &source.values) {
                (Values::Bytes(a), Values::Bytes(b)) => {
                    a[target..target + length].copy_from_slice(&b[first..first + length]);
                }
                (Values::Floats(a), Values::Floats(b)) => {
                    a[target..target + length].copy_from_slice(&b[first..first + length]);
                }
                _ => return Err(MatrixError::Mismatch),
            }
        }
        Ok(())
    }

    /// The corner of a region inside of the image.
    fn region(&self, corner: [i64; 2], size: [i64; 2]) -> MatrixResult<[usize; 2]> {
        let limits = [numbers::count(self.width), numbers::count(self.height)];
        let is_inside = (0..2).all(|i| {
            corner[i] >= 0
                && size[i] >= 0
                && corner[i]
                    .checked_add(size[i])
                    .is_some_and(|end| end <= limits[i])
        });
        if is_inside {
            Ok(corner.map(numbers::place_of))
        } else {
            Err(MatrixError::Region)
        }
    }

    /// All rows as one, or all columns.
    ///
    /// # Errors
    /// When bytes are to be summed: their sum would be no byte.
    pub fn reduced(&self, to_row: bool, reduction: Reduction) -> MatrixResult<Self> {
        self.require(
            self.format().depth == Depth::Float || reduction != Reduction::Sum,
            "a sum",
        )?;
        let size = if to_row {
            [self.width, 1]
        } else {
            [1, self.height]
        };
        let values = with_values!(self, values => self.reduced_values(values, to_row, reduction));
        Ok(Self {
            width: size[0],
            height: size[1],
            channels: self.channels,
            values,
        })
    }

    fn reduced_values<T: Value>(&self, values: &[T], to_row: bool, reduction: Reduction) -> Vec<T> {
        let row_length = self.width * self.channels;
        let (kept, count, step) = match to_row {
            true => (row_length, self.height, row_length),
            false => (self.height * self.channels, self.width, self.channels),
        };
        let first = |at: usize| {
            if to_row {
                at
            } else {
                at / self.channels * row_length + at % self.channels
            }
        };
        let of = |at: usize| (0..count).map(move |n| values[first(at) + n * step].to_f64());
        let reduced = |at: usize| match reduction {
            Reduction::Sum => of(at).sum(),
            Reduction::Average => of(at).sum::<f64>() / numbers::real(count),
            Reduction::Largest => of(at).fold(f64::NEG_INFINITY, f64::max),
            Reduction::Smallest => of(at).fold(f64::INFINITY, f64::min),
        };
        (0..kept).map(|at| T::from_f64(reduced(at))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{bytes, floats};
    use super::*;

    #[test]
    fn mirrors() {
        let image = bytes([2, 2], 1, &[1, 2, 3, 4]);
        assert_eq!(
            image.flipped(Flip::Columns),
            bytes([2, 2], 1, &[2, 1, 4, 3])
        );
        assert_eq!(image.flipped(Flip::Rows), bytes([2, 2], 1, &[3, 4, 1, 2]));
        assert_eq!(image.flipped(Flip::Both), bytes([2, 2], 1, &[4, 3, 2, 1]));
    }

    #[test]
    fn repeats() {
        let image = bytes([1, 1], 2, &[1, 2]);
        assert_eq!(
            image.repeated([2, 1]).unwrap(),
            bytes([2, 1], 2, &[1, 2, 1, 2])
        );
        assert_eq!(image.repeated([0, 1]), Err(MatrixError::Size));
        assert_eq!(
            image.repeated([usize::MAX, usize::MAX]),
            Err(MatrixError::Size)
        );
    }

    #[test]
    fn regions_are_copied() {
        let source = bytes([3, 1], 1, &[1, 2, 3]);
        let mut image = bytes([2, 2], 1, &[0; 4]);
        image.copy_from(&source, [1, 0], [0, 1], [2, 1]).unwrap();
        assert_eq!(image, bytes([2, 2], 1, &[0, 0, 2, 3]));
        for (from, to, size) in [
            ([2, 0], [0, 0], [2, 1]),
            ([0, 0], [0, 2], [1, 1]),
            ([-1, 0], [0, 0], [1, 1]),
            ([0, 0], [0, 0], [i64::MAX, 1]),
        ] {
            assert_eq!(
                image.copy_from(&source, from, to, size),
                Err(MatrixError::Region)
            );
        }
        assert_eq!(
            image.copy_from(&floats([1, 1], 1, &[0.0]), [0, 0], [0, 0], [1, 1]),
            Err(MatrixError::Mismatch)
        );
    }

    #[test]
    fn rows_and_columns_are_reduced() {
        let image = floats([2, 2], 1, &[1.0, 2.0, 5.0, 8.0]);
        assert_eq!(
            image.reduced(true, Reduction::Sum).unwrap(),
            floats([2, 1], 1, &[6.0, 10.0])
        );
        assert_eq!(
            image.reduced(false, Reduction::Average).unwrap(),
            floats([1, 2], 1, &[1.5, 6.5])
        );
        let image = bytes([2, 1], 2, &[1, 9, 4, 2]);
        assert_eq!(
            image.reduced(false, Reduction::Largest).unwrap(),
            bytes([1, 1], 2, &[4, 9])
        );
        assert_eq!(
            image.reduced(false, Reduction::Smallest).unwrap(),
            bytes([1, 1], 2, &[1, 2])
        );
        assert!(image.reduced(true, Reduction::Sum).is_err());
    }
}
