//! Cuts: what is outside of a circle or a rectangle around the centre becomes black.

use super::{BLACK, RgbImage};

impl RgbImage {
    /// Blackens pixels farther from the centre than `radius` times half of the smaller side; returns what was removed, on black.
    pub fn cut_circle(&mut self, radius: f64) -> Self {
        let limit = radius * 0.5 * numbers::real(self.width.min(self.height));
        self.cut(|x, y| libm::hypot(x, y) > limit)
    }

    /// Blackens pixels outside of a rectangle that has `sizes` of the image's sides; returns what was removed, on black.
    pub fn cut_rectangle(&mut self, sizes: [f64; 2]) -> Self {
        let limits = [
            0.5 * sizes[0] * numbers::real(self.width),
            0.5 * sizes[1] * numbers::real(self.height),
        ];
        self.cut(|x, y| x.abs() > limits[0] || y.abs() > limits[1])
    }

    /// Cuts by the position of pixel centres relative to that of the image.
    fn cut(&mut self, is_outside: impl Fn(f64, f64) -> bool) -> Self {
        let mut removed = Self::uniform(self.size(), BLACK);
        let middle = [
            numbers::real(self.width) / 2.0,
            numbers::real(self.height) / 2.0,
        ];
        let width = self.width;
        for (at, (pixel, removed)) in self.pixels.iter_mut().zip(&mut removed.pixels).enumerate() {
            let (x, y) = (
                numbers::real(at % width) + 0.5 - middle[0],
                numbers::real(at / width) + 0.5 - middle[1],
            );
            if is_outside(x, y) {
                *removed = std::mem::replace(pixel, BLACK);
            }
        }
        removed
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::white;
    use super::*;

    const INNER: [(usize, usize); 4] = [(1, 1), (2, 1), (1, 2), (2, 2)];

    #[test]
    fn the_middle_remains() {
        let mut image = RgbImage::uniform([4, 4], [1.0; 3]);
        let removed = image.cut_rectangle([0.5, 0.5]);
        assert_eq!(white(&image), INNER);
        assert_eq!(white(&removed).len(), 12);
        let mut image = RgbImage::uniform([4, 4], [1.0; 3]);
        image.cut_circle(0.5);
        assert_eq!(white(&image), INNER);
    }
}
