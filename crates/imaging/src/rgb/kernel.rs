//! Convolution with square kernels.
//!
//! Neighbours outside of the image are left out and the sum is divided by the share of those inside: a kernel whose sum is 0 brightens
//! the border of an even image.

use super::{BLACK, Rgb, RgbImage, mean};

/// A kernel of 3 by 3 or 5 by 5 weights, row by row from the lower neighbours.
#[derive(Debug, Clone, PartialEq)]
pub struct Kernel {
    side: usize,
    weights: Vec<f64>,
}

impl Kernel {
    /// None unless the weights are 9 or 25.
    pub fn new(weights: Vec<f64>) -> Option<Self> {
        let side = match weights.len() {
            9 => 3,
            25 => 5,
            _ => return None,
        };
        Some(Self { side, weights })
    }

    /// A Gaussian with a standard deviation of 2 pixels and the sum 1.
    pub fn gaussian_3x3() -> Self {
        Self::gaussian(3)
    }

    /// As [`Kernel::gaussian_3x3`], with 5 by 5 weights.
    pub fn gaussian_5x5() -> Self {
        Self::gaussian(5)
    }

    fn gaussian(side: usize) -> Self {
        const VARIANCE: f64 = 4.0;
        let middle = numbers::real(side / 2);
        let weight = |at: usize| {
            let (x, y) = (
                numbers::real(at % side) - middle,
                numbers::real(at / side) - middle,
            );
            libm::exp(-(x * x + y * y) / (2.0 * VARIANCE))
        };
        let weights: Vec<f64> = (0..side * side).map(weight).collect();
        let sum: f64 = weights.iter().sum();
        Self {
            side,
            weights: weights.iter().map(|weight| weight / sum).collect(),
        }
    }

    /// A kernel of one weight in the middle and another around it.
    fn centred(middle: f64, around: f64) -> Self {
        let mut weights = vec![around; 9];
        weights[4] = middle;
        Self { side: 3, weights }
    }

    /// All weights times a number.
    pub fn times(mut self, factor: f64) -> Self {
        self.weights.iter_mut().for_each(|weight| *weight *= factor);
        self
    }

    fn inside(&self, image: &RgbImage, from: usize) -> Rgb {
        let mut sum = BLACK;
        for (row, weights) in self.weights.chunks_exact(self.side).enumerate() {
            let start = from + row * image.width;
            for (pixel, weight) in image.pixels[start..start + self.side].iter().zip(weights) {
                (0..3).for_each(|i| sum[i] += pixel[i] * weight);
            }
        }
        sum
    }

    fn at_border(&self, image: &RgbImage, column: usize, row: usize) -> Rgb {
        let reach = self.side / 2;
        let (mut sum, mut present) = (BLACK, 0.0);
        for (at, weight) in self.weights.iter().enumerate() {
            let (x, y) = (column + at % self.side, row + at / self.side);
            let Some(pixel) = x
                .checked_sub(reach)
                .zip(y.checked_sub(reach))
                .and_then(|(x, y)| image.get(x, y))
            else {
                continue;
            };
            (0..3).for_each(|i| sum[i] += pixel[i] * weight);
            present += 1.0;
        }
        sum.map(|value| value / (present / numbers::real(self.weights.len())))
    }
}

impl RgbImage {
    /// The image after one pass of a kernel; values are not limited.
    pub fn convolved(&self, kernel: &Kernel) -> Self {
        let reach = kernel.side / 2;
        self.map_places(|column, row| {
            let is_inside = |at: usize, size: usize| at >= reach && at + reach < size;
            if is_inside(column, self.width) && is_inside(row, self.height) {
                kernel.inside(self, (row - reach) * self.width + column - reach)
            } else {
                kernel.at_border(self, column, row)
            }
        })
    }

    /// White where the difference to the neighbours is larger than `threshold` in the mean, else black.
    pub fn detect_edges(&mut self, threshold: f64) {
        *self = self.convolved(&Kernel::centred(24.0, -3.0));
        self.pixels.iter_mut().for_each(|pixel| {
            *pixel = if mean(*pixel) > threshold {
                [1.0; 3]
            } else {
                BLACK
            }
        });
    }

    /// Raises the differences to neighbours.
    pub fn sharpen(&mut self) {
        *self = self.convolved(&Kernel::centred(1.8888, -0.1111));
        self.clamp();
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{white, white_at};
    use super::*;

    #[test]
    fn a_point_becomes_a_blur() {
        let blurred = white_at([4, 4], &[(1, 1)]).convolved(&Kernel::gaussian_3x3());
        let grey: Vec<u8> = blurred.to_bytes().chunks(3).map(|pixel| pixel[0]).collect();
        assert_eq!(
            grey,
            [58, 44, 38, 0, 44, 33, 29, 0, 38, 29, 25, 0, 0, 0, 0, 0]
        );
    }

    #[test]
    fn an_even_image_has_edges_at_its_border() {
        let even = RgbImage::uniform([4, 4], [0.5; 3]);
        let edges = even.convolved(&Kernel::centred(24.0, -3.0));
        assert_eq!(
            (edges.pixels()[0], edges.pixels()[1], edges.pixels()[5]),
            ([16.875; 3], [6.75; 3], [0.0; 3])
        );
        let mut image = even;
        image.detect_edges(0.1);
        assert_eq!(white(&image).len(), 12);
        assert_eq!(image.get(1, 2), Some(BLACK));
    }

    #[test]
    fn the_first_row_of_a_kernel_is_the_lower_one() {
        let mut weights = vec![0.0; 9];
        weights[0] = 1.0;
        let moved = white_at([5, 5], &[(2, 2)]).convolved(&Kernel::new(weights).unwrap());
        assert_eq!(white(&moved), [(3, 3)]);
        assert_eq!(Kernel::new(vec![0.0; 10]), None);
    }

    #[test]
    fn sums_stay_with_the_kernel_of_25() {
        let even =
            RgbImage::uniform([9, 7], [0.25; 3]).convolved(&Kernel::gaussian_5x5().times(2.0));
        assert!((even.get(4, 3).unwrap()[0] - 0.5).abs() < 1e-12);
        // Images smaller than the kernel are all border.
        let tiny =
            RgbImage::uniform([1, 1], [0.5; 3]).convolved(&Kernel::new(vec![1.0; 25]).unwrap());
        assert_eq!(tiny.pixels(), [[12.5; 3]]);
    }
}
