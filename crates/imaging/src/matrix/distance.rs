//! The distance of each pixel to the nearest black one.

use super::{Depth, Matrix, MatrixResult, Values};

/// How distances are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DistanceType {
    /// |dx| + |dy|.
    Manhattan,
    /// The length of the straight line.
    Euclidean,
    /// The larger of |dx| and |dy|.
    Chessboard,
}

/// How Euclidean distances are found: as sums of steps to neighbours, or exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MaskSize {
    /// Steps to the eight neighbours.
    Three,
    /// Steps to neighbours within two rows and columns.
    Five,
    /// Exact.
    Precise,
}

/// Farther than any two pixels are.
const FAR: f64 = 1e9;

/// Steps to neighbours: columns, rows, length. Those to rows before come first; the others are their mirror images.
type Steps = Vec<(i64, i64, f64)>;

impl Matrix {
    /// The distance of each pixel of a single channel to the nearest pixel of value 0, as floats.
    ///
    /// # Errors
    /// Unless the image has one channel of bytes.
    pub fn distance_transform(&self, distance: DistanceType, mask: MaskSize) -> MatrixResult<Self> {
        self.require(
            self.format().depth == Depth::Byte && self.channels == 1,
            "distance transform",
        )?;
        let black = self
            .bytes()
            .unwrap_or_default()
            .iter()
            .map(|byte| if *byte == 0 { 0.0 } else { FAR })
            .collect();
        let distances = match (distance, mask) {
            (DistanceType::Euclidean, MaskSize::Precise) => self.exact_distances(black),
            _ => self.summed_distances(black, &steps(distance, mask)),
        };
        Ok(self.with(Values::Floats(
            distances.into_iter().map(numbers::single).collect(),
        )))
    }

    /// Distances as sums of steps, by a pass forward and one backward.
    fn summed_distances(&self, mut distances: Vec<f64>, steps: &Steps) -> Vec<f64> {
        let (width, height) = (numbers::count(self.width), numbers::count(self.height));
        let mut relax = |at: usize, sign: i64| {
            let (x, y) = (numbers::count(at) % width, numbers::count(at) / width);
            for &(dx, dy, length) in steps {
                let (x, y) = (x + sign * dx, y + sign * dy);
                if (0..width).contains(&x) && (0..height).contains(&y) {
                    distances[at] =
                        distances[at].min(distances[numbers::place_of(y * width + x)] + length);
                }
            }
        };
        let count = self.width * self.height;
        (0..count).for_each(|at| relax(at, 1));
        (0..count).rev().for_each(|at| relax(at, -1));
        distances
    }

    /// Euclidean distances: squares along the columns, then the lower envelope of parabolas along the rows
    /// (Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions", 2012).
    fn exact_distances(&self, mut squares: Vec<f64>) -> Vec<f64> {
        let (width, height) = (self.width, self.height);
        for first in 0..width {
            let column: Vec<f64> = (0..height)
                .map(|row| squares[row * width + first])
                .collect();
            envelope(&column)
                .into_iter()
                .enumerate()
                .for_each(|(row, value)| squares[row * width + first] = value);
        }
        for row in squares.chunks_exact_mut(width) {
            let values = envelope(row);
            row.copy_from_slice(&values);
        }
        squares.into_iter().map(f64::sqrt).collect()
    }
}

/// The least of `f(q) + (p - q)^2` over all q, for each p.
fn envelope(f: &[f64]) -> Vec<f64> {
    // The parabolas of the envelope, and from where on each is the lowest.
    let mut lowest: Vec<(usize, f64)> = Vec::new();
    for (q, value) in f.iter().enumerate() {
        let height = |at: usize| f[at] + numbers::real(at * at);
        let mut from = f64::NEG_INFINITY;
        while let Some(&(last, start)) = lowest.last() {
            from = (value + numbers::real(q * q) - height(last)) / numbers::real(2 * (q - last));
            if from > start {
                break;
            }
            lowest.pop();
            from = f64::NEG_INFINITY;
        }
        lowest.push((q, from));
    }
    let mut at = 0;
    (0..f.len())
        .map(|p| {
            while lowest
                .get(at + 1)
                .is_some_and(|&(_, from)| from < numbers::real(p))
            {
                at += 1;
            }
            let q = lowest[at].0;
            f[q] + numbers::real((p.abs_diff(q)) * (p.abs_diff(q)))
        })
        .collect()
}

/// The lengths are those of Borgefors, "Distance transformations in digital images", 1986.
fn steps(distance: DistanceType, mask: MaskSize) -> Steps {
    let [straight, diagonal, knight] = match (distance, mask) {
        (DistanceType::Manhattan, _) => [1.0, 2.0, 3.0],
        (DistanceType::Chessboard, _) => [1.0, 1.0, 2.0],
        (DistanceType::Euclidean, MaskSize::Three) => [0.955, 1.3693, FAR],
        (DistanceType::Euclidean, _) => [1.0, 1.4, 2.1969],
    };
    let mut steps = vec![
        (-1, 0, straight),
        (0, -1, straight),
        (-1, -1, diagonal),
        (1, -1, diagonal),
    ];
    if knight < FAR {
        steps.extend([(-2, -1), (2, -1), (-1, -2), (1, -2)].map(|(x, y)| (x, y, knight)));
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::super::tests::bytes;
    use super::*;

    fn image(places: &[usize]) -> Matrix {
        let mut values = [255; 63];
        places.iter().for_each(|at| values[*at] = 0);
        bytes([9, 7], 1, &values)
    }

    fn nearest(places: &[usize], at: usize, length: impl Fn(f64, f64) -> f64) -> f64 {
        let distance = |place: &usize| {
            length(
                (place % 9).abs_diff(at % 9) as f64,
                (place / 9).abs_diff(at / 9) as f64,
            )
        };
        places.iter().map(distance).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn distances_are_exact() {
        let places = [4, 20, 61, 62];
        for (kind, length) in [
            (
                DistanceType::Euclidean,
                (|x, y| f64::hypot(x, y)) as fn(f64, f64) -> f64,
            ),
            (DistanceType::Manhattan, |x, y| x + y),
            (DistanceType::Chessboard, f64::max),
        ] {
            let found = image(&places)
                .distance_transform(kind, MaskSize::Precise)
                .unwrap();
            for at in 0..63 {
                let (found, expected) = (found.value(at).unwrap(), nearest(&places, at, length));
                assert!(
                    (found - expected).abs() < 1e-6,
                    "{kind:?} {at}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn steps_come_close() {
        for (mask, error) in [(MaskSize::Three, 0.1), (MaskSize::Five, 0.03)] {
            let found = image(&[0])
                .distance_transform(DistanceType::Euclidean, mask)
                .unwrap();
            for at in 1..63 {
                let expected = nearest(&[0], at, f64::hypot);
                assert!(
                    (found.value(at).unwrap() - expected).abs() <= error * expected,
                    "{mask:?} {at}"
                );
            }
        }
    }

    #[test]
    fn without_black_everything_is_far() {
        let found = image(&[])
            .distance_transform(DistanceType::Euclidean, MaskSize::Precise)
            .unwrap();
        assert!(found.value(30).unwrap() > 1e4);
        assert!(
            bytes([1, 1], 3, &[0; 3])
                .distance_transform(DistanceType::Euclidean, MaskSize::Five)
                .is_err()
        );
    }
}
