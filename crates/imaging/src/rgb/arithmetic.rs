//! Sums, differences and products of images of the same size, and the spread of values.

use super::{Rgb, RgbImage};

impl RgbImage {
    /// Adds an image; sums are at most 1.
    pub fn add(&mut self, other: &Self) {
        self.combine(other, |a, b| (a + b).min(1.0));
    }

    /// Subtracts an image; differences are at least 0.
    pub fn subtract(&mut self, other: &Self) {
        self.combine(other, |a, b| (a - b).max(0.0));
    }

    /// Multiplies with an image; products are at most 1.
    pub fn multiply(&mut self, other: &Self) {
        self.combine(other, |a, b| (a * b).min(1.0));
    }

    fn combine(&mut self, other: &Self, operation: impl Fn(f64, f64) -> f64) {
        debug_assert_eq!(self.size(), other.size());
        for (pixel, other) in self.pixels.iter_mut().zip(&other.pixels) {
            for (value, other) in pixel.iter_mut().zip(other) {
                *value = operation(*value, *other);
            }
        }
    }

    /// Makes all pixels one colour.
    pub fn fill(&mut self, colour: Rgb) {
        self.pixels.fill(colour);
    }

    /// Limits all values to 0 and 1.
    pub fn clamp(&mut self) {
        self.pixels
            .as_flattened_mut()
            .iter_mut()
            .for_each(|value| *value = value.clamp(0.0, 1.0));
    }

    /// Spreads the values over 0 to 1. The smallest counts as 1 at most and the largest as 0 at least, as in the original.
    pub fn normalize(&mut self) {
        let values = self.pixels.as_flattened_mut();
        let smallest = values.iter().copied().fold(1.0, f64::min);
        let largest = values.iter().copied().fold(0.0, f64::max);
        if largest != smallest {
            values
                .iter_mut()
                .for_each(|value| *value = (*value - smallest) / (largest - smallest));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_differences_are_limited_on_one_side() {
        let mut image = RgbImage::uniform([1, 1], [0.5, -2.0, 0.25]);
        let other = RgbImage::uniform([1, 1], [0.75, 0.5, 0.25]);
        image.add(&other);
        assert_eq!(image.pixels(), [[1.0, -1.5, 0.5]]);
        image.subtract(&other);
        assert_eq!(image.pixels(), [[0.25, 0.0, 0.25]]);
        image.multiply(&RgbImage::uniform([1, 1], [8.0, -1.0, 2.0]));
        assert_eq!(image.pixels(), [[1.0, 0.0, 0.5]]);
    }

    #[test]
    fn normalized_values_reach_from_0_to_1() {
        let mut image = RgbImage {
            width: 2,
            height: 1,
            pixels: vec![[0.25; 3], [0.25, 0.5, 0.75]],
        };
        image.normalize();
        assert_eq!(image.pixels(), [[0.0; 3], [0.0, 0.5, 1.0]]);
        let mut even = RgbImage::uniform([1, 1], [3.0; 3]);
        even.normalize();
        assert_eq!(even.pixels(), [[1.0; 3]]);
    }
}
