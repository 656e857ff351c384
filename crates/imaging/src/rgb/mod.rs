//! RGB images of floats, nominally 0 to 1, and the filters of vision sensors on them (spec: simvision 2).
//!
//! Pixel (column i, row j) counts from the lower left corner, as in vision sensors: row 0 is the bottom row.

mod arithmetic;
pub mod blobs;
pub mod changes;
mod colour;
mod cut;
mod kernel;
pub mod moments;
pub mod points;
pub mod segmentation;
pub mod sphere;
mod warp;

pub use colour::{Component, hsl_from_rgb, rgb_from_hsl};
pub use kernel::Kernel;

/// Red, green, blue.
pub type Rgb = [f64; 3];

/// Black.
pub const BLACK: Rgb = [0.0; 3];

/// An image, row by row from the bottom.
#[derive(Debug, Clone, PartialEq)]
pub struct RgbImage {
    width: usize,
    height: usize,
    pixels: Vec<Rgb>,
}

impl RgbImage {
    /// An image of one colour.
    pub fn uniform([width, height]: [usize; 2], colour: Rgb) -> Self {
        Self {
            width,
            height,
            pixels: vec![colour; width * height],
        }
    }

    /// Three bytes for each pixel, 255 is 1. None unless there are as many as the resolution asks for.
    pub fn from_bytes([width, height]: [usize; 2], bytes: &[u8]) -> Option<Self> {
        let (pixels, rest) = bytes.as_chunks::<3>();
        let fits = pixels.len() == width * height && rest.is_empty();
        fits.then(|| Self {
            width,
            height,
            pixels: pixels
                .iter()
                .map(|p| p.map(|byte| f64::from(byte) / 255.0))
                .collect(),
        })
    }

    /// A grey image of one value per pixel. None unless there are as many as the resolution asks for.
    pub fn from_values([width, height]: [usize; 2], values: &[f32]) -> Option<Self> {
        let grey = |&value: &f32| [f64::from(value); 3];
        (values.len() == width * height).then(|| Self {
            width,
            height,
            pixels: values.iter().map(grey).collect(),
        })
    }

    /// Bytes of each pixel: 1 is 255. Values beyond 0 and 1 are limited.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.pixels
            .iter()
            .flat_map(|pixel| pixel.map(byte))
            .collect()
    }

    /// The mean of red, green and blue of each pixel.
    pub fn to_values(&self) -> Vec<f32> {
        self.pixels
            .iter()
            .map(|&pixel| numbers::single(mean(pixel)))
            .collect()
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// All pixels, row by row from the bottom.
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// All pixels, row by row from the bottom, to be changed.
    pub fn pixels_mut(&mut self) -> &mut [Rgb] {
        &mut self.pixels
    }

    /// The pixel in a column of a row, None outside.
    pub fn get(&self, column: usize, row: usize) -> Option<Rgb> {
        self.pixels.get(self.index(column, row)?).copied()
    }

    fn index(&self, column: usize, row: usize) -> Option<usize> {
        (column < self.width && row < self.height).then_some(row * self.width + column)
    }

    /// The image with a colour computed for each column and row.
    fn map_places(&self, colour: impl Fn(usize, usize) -> Rgb) -> Self {
        let (width, height) = (self.width, self.height);
        let pixels = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
        Self {
            width,
            height,
            pixels: pixels.map(|(column, row)| colour(column, row)).collect(),
        }
    }
}

/// The byte of a value: just above the half of a step is enough for the next.
pub fn byte(value: f64) -> u8 {
    numbers::level(value * 255.1)
}

/// The intensity of a colour.
pub fn mean([red, green, blue]: Rgb) -> f64 {
    (red + green + blue) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image that is black but for white pixels.
    pub(super) fn white_at(size: [usize; 2], places: &[(usize, usize)]) -> RgbImage {
        let mut image = RgbImage::uniform(size, BLACK);
        for &(column, row) in places {
            let at = image.index(column, row).unwrap();
            image.pixels[at] = [1.0; 3];
        }
        image
    }

    /// The white pixels of an image.
    pub(super) fn white(image: &RgbImage) -> Vec<(usize, usize)> {
        let [width, _] = image.size();
        let is_white = |(_, pixel): &(usize, &Rgb)| **pixel == [1.0; 3];
        image
            .pixels
            .iter()
            .enumerate()
            .filter(is_white)
            .map(|(at, _)| (at % width, at / width))
            .collect()
    }

    #[test]
    fn bytes_come_back() {
        let bytes: Vec<u8> = (0..=255).flat_map(|k| [k, k, 255 - k]).collect();
        let image = RgbImage::from_bytes([16, 16], &bytes).unwrap();
        assert_eq!(image.to_bytes(), bytes);
        assert_eq!(RgbImage::from_bytes([16, 15], &bytes), None);
    }

    #[test]
    fn values_beyond_the_range_are_limited() {
        let image = RgbImage::uniform([1, 1], [-3.0, f64::NAN, 7.0]);
        assert_eq!(image.to_bytes(), [0, 0, 255]);
        assert_eq!(byte(0.5), 127);
    }

    #[test]
    fn depths_are_grey() {
        let image = RgbImage::from_values([2, 1], &[0.25, 1.0]).unwrap();
        assert_eq!(image.to_values(), [0.25, 1.0]);
        assert_eq!(image.get(1, 0), Some([1.0; 3]));
        assert_eq!((image.get(2, 0), image.get(0, 1)), (None, None));
    }
}
