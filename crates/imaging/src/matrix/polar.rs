//! Lengths and angles of vectors whose coordinates are in two images.

use std::f64::consts::TAU;

use super::{Depth, Matrix, MatrixResult};

impl Matrix {
    /// Lengths of the vectors (self, other).
    pub fn magnitude(&self, other: &Self) -> MatrixResult<Self> {
        self.require(self.format().depth == Depth::Float, "magnitude")?;
        self.zip(other, |x, y| (x * x + y * y).sqrt())
    }

    /// Angles of the vectors (self, other), from 0 to a full turn.
    pub fn phase(&self, other: &Self, in_degrees: bool) -> MatrixResult<Self> {
        self.require(self.format().depth == Depth::Float, "phase")?;
        self.zip(other, |x, y| {
            let angle = libm::atan2(y, x);
            let angle = if angle < 0.0 { angle + TAU } else { angle };
            if in_degrees {
                angle.to_degrees()
            } else {
                angle
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{bytes, floats};

    #[test]
    fn vectors_have_length_and_angle() {
        let (x, y) = (
            floats([2, 1], 1, &[3.0, 0.0]),
            floats([2, 1], 1, &[4.0, -2.0]),
        );
        assert_eq!(x.magnitude(&y).unwrap(), floats([2, 1], 1, &[5.0, 2.0]));
        assert_eq!(x.phase(&y, true).unwrap().value(1), Some(270.0));
        assert!(
            bytes([1, 1], 1, &[0])
                .magnitude(&bytes([1, 1], 1, &[0]))
                .is_err()
        );
    }
}
