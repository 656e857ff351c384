//! Images in another size. Each side is resampled with weights of its own; beyond the border, the pixels there count again.

use super::{Matrix, MatrixResult, Value, value_count, with_values};

/// How pixels of a resized image are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// The nearest pixel.
    Nearest,
    /// The two nearest pixels, weighted by their distance.
    Linear,
    /// The average of what a pixel covers.
    Area,
    /// Four pixels (Keys, 1981, with a = -0.75).
    Cubic,
    /// Eight pixels.
    Lanczos,
}

/// The sources of one pixel: the first, and the weights from there on.
struct Sources {
    first: usize,
    weights: Vec<f64>,
}

impl Matrix {
    /// The image in another size: columns and rows.
    ///
    /// # Errors
    /// When the size is none an image can have.
    pub fn resized(&self, size: [usize; 2], interpolation: Interpolation) -> MatrixResult<Self> {
        value_count(size, self.channels)?;
        // Intermediate result between the two passes.
        value_count([size[0], self.height], self.channels)?;
        if interpolation == Interpolation::Nearest {
            let from = |at: usize, old: usize, new: usize| at * old / new;
            return Ok(self.rearranged(size, |x, y| {
                [from(x, self.width, size[0]), from(y, self.height, size[1])]
            }));
        }
        let [columns, rows] = [
            sources(self.width, size[0], interpolation),
            sources(self.height, size[1], interpolation),
        ];
        let values = with_values!(self, values => self.weighted(values, &columns, &rows));
        Ok(Self {
            width: size[0],
            height: size[1],
            channels: self.channels,
            values,
        })
    }

    fn weighted<T: Value>(&self, values: &[T], columns: &[Sources], rows: &[Sources]) -> Vec<T> {
        let channels = self.channels;
        let length = columns.len() * channels;
        let mut narrow = Vec::with_capacity(length * self.height);
        for row in values.chunks_exact(self.width * channels) {
            for source in columns {
                for channel in 0..channels {
                    let weighted = source.weights.iter().enumerate();
                    let value = |(n, weight): (usize, &f64)| {
                        row[(source.first + n) * channels + channel].to_f64() * weight
                    };
                    narrow.push(weighted.map(value).sum::<f64>());
                }
            }
        }
        let mut result = Vec::with_capacity(length * rows.len());
        let mut sums = vec![0.0; length];
        for source in rows {
            sums.fill(0.0);
            for (row, weight) in narrow
                .chunks_exact(length)
                .skip(source.first)
                .zip(&source.weights)
            {
                sums.iter_mut()
                    .zip(row)
                    .for_each(|(sum, value)| *sum += value * weight);
            }
            result.extend(sums.iter().map(|sum| T::from_f64(*sum)));
        }
        result
    }
}

fn sources(old: usize, new: usize, interpolation: Interpolation) -> Vec<Sources> {
    let scale = numbers::real(old) / numbers::real(new);
    (0..new)
        .map(|at| match interpolation {
            Interpolation::Area => covered(
                numbers::real(at) * scale,
                numbers::real(at + 1) * scale,
                old,
            ),
            _ => around((numbers::real(at) + 0.5) * scale - 0.5, old, interpolation),
        })
        .collect()
}

/// The pixels between two places, by how much of each.
fn covered(from: f64, to: f64, count: usize) -> Sources {
    let first = numbers::index(from).min(count - 1);
    let last = (numbers::index(to.ceil()).max(first + 1) - 1).min(count - 1);
    let part = |at: usize| {
        (to.min(numbers::real(at + 1)) - from.max(numbers::real(at))).max(0.0) / (to - from)
    };
    Sources {
        first,
        weights: (first..=last).map(part).collect(),
    }
}

/// The pixels around a place, weighted by a kernel; those outside count for the ones at the border.
fn around(place: f64, count: usize, interpolation: Interpolation) -> Sources {
    let reach = match interpolation {
        Interpolation::Cubic => 2,
        Interpolation::Lanczos => 4,
        _ => 1,
    };
    let below = place.floor();
    let weight = |n: i64| kernel(place - below - numbers::real_of(n), interpolation);
    let all: f64 = (1 - reach..=reach).map(weight).sum();
    let inside = |n: i64| {
        numbers::place_of((numbers::truncated(below) + n).clamp(0, numbers::count(count) - 1))
    };
    let first = inside(1 - reach);
    let mut weights = vec![0.0; inside(reach) - first + 1];
    (1 - reach..=reach).for_each(|n| weights[inside(n) - first] += weight(n) / all);
    Sources { first, weights }
}

fn kernel(distance: f64, interpolation: Interpolation) -> f64 {
    let x = distance.abs();
    match interpolation {
        Interpolation::Cubic => {
            const A: f64 = -0.75;
            match x {
                x if x <= 1.0 => ((A + 2.0) * x - (A + 3.0)) * x * x + 1.0,
                x if x < 2.0 => ((A * x - 5.0 * A) * x + 8.0 * A) * x - 4.0 * A,
                _ => 0.0,
            }
        }
        Interpolation::Lanczos if x < 1e-9 => 1.0,
        Interpolation::Lanczos if x >= 4.0 => 0.0,
        Interpolation::Lanczos => {
            let y = std::f64::consts::PI * x;
            4.0 * libm::sin(y) * libm::sin(y / 4.0) / (y * y)
        }
        _ => (1.0 - x).max(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{bytes, floats};
    use super::*;

    const ALL: [Interpolation; 5] = [
        Interpolation::Nearest,
        Interpolation::Linear,
        Interpolation::Area,
        Interpolation::Cubic,
        Interpolation::Lanczos,
    ];

    #[test]
    fn even_images_stay_even() {
        let image = bytes([5, 3], 3, &[[10, 20, 30]; 15].concat());
        for interpolation in ALL {
            for size in [[5, 3], [2, 9], [13, 1], [1, 1]] {
                let expected = bytes(size, 3, &[10, 20, 30].repeat(size[0] * size[1]));
                assert_eq!(
                    image.resized(size, interpolation).unwrap(),
                    expected,
                    "{interpolation:?} {size:?}"
                );
            }
        }
    }

    #[test]
    fn the_same_size_is_the_same_image() {
        let image = bytes([4, 2], 1, &[1, 80, 3, 200, 5, 6, 90, 8]);
        for interpolation in ALL {
            assert_eq!(
                image.resized([4, 2], interpolation).unwrap(),
                image,
                "{interpolation:?}"
            );
        }
    }

    #[test]
    fn pixels_are_mixed() {
        let image = floats([2, 1], 1, &[0.0, 4.0]);
        assert_eq!(
            image.resized([4, 1], Interpolation::Linear).unwrap(),
            floats([4, 1], 1, &[0.0, 1.0, 3.0, 4.0])
        );
        assert_eq!(
            image.resized([4, 1], Interpolation::Nearest).unwrap(),
            floats([4, 1], 1, &[0.0, 0.0, 4.0, 4.0])
        );
        let image = floats([3, 1], 1, &[0.0, 3.0, 9.0]);
        assert_eq!(
            image.resized([2, 1], Interpolation::Area).unwrap(),
            floats([2, 1], 1, &[1.0, 7.0])
        );
        assert_eq!(
            image.resized([1, 1], Interpolation::Area).unwrap(),
            floats([1, 1], 1, &[4.0])
        );
    }

    #[test]
    fn sizes_are_limited() {
        let image = bytes([1, 1], 1, &[0]);
        assert!(image.resized([0, 1], Interpolation::Linear).is_err());
        assert!(
            image
                .resized([1 << 20, 1 << 20], Interpolation::Linear)
                .is_err()
        );
    }
}
