//! Pictures: pixels, and drawings in SVG.

use super::super::error::{UiError, UiResult};

/// A picture of pixels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Image {
    /// Pixels in a row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Red, green, blue, opacity of each pixel, the top row first; empty without a picture.
    pub pixels: Vec<u8>,
    /// The file to load it from; empty for none.
    pub file: String,
    pub(crate) scaled_contents: bool,
    pub(crate) keep_aspect_ratio: bool,
}

/// Largest number of pixels of a transparent picture.
pub(super) const MAX_PIXELS: usize = 1 << 24;

impl Image {
    /// A transparent picture; nothing for a size that is not positive.
    pub(crate) fn blank(width: i64, height: i64) -> Self {
        let sides = usize::try_from(width)
            .ok()
            .zip(usize::try_from(height).ok());
        let fits = |&(width, height): &(usize, usize)| width.saturating_mul(height) <= MAX_PIXELS;
        let (width, height) = sides
            .filter(fits)
            .filter(|(w, h)| *w > 0 && *h > 0)
            .unwrap_or_default();
        Self {
            width,
            height,
            pixels: vec![0; 4 * width * height],
            ..Self::default()
        }
    }

    /// Sets the picture from red, green, blue of each pixel, the bottom row first.
    ///
    /// # Errors
    /// When there are not as many bytes as the size asks for.
    pub fn set_rgb(&mut self, data: &[u8], width: i64, height: i64) -> UiResult<()> {
        let (width, height, pixels) = rgba_of(data, width, height)?;
        (self.width, self.height, self.pixels) = (width, height, pixels);
        Ok(())
    }
}

/// Width, height, and pixels with the top row first, of an image of a vision sensor.
pub(super) fn rgba_of(data: &[u8], width: i64, height: i64) -> UiResult<(usize, usize, Vec<u8>)> {
    let (columns, rows) = (
        usize::try_from(width).unwrap_or(0),
        usize::try_from(height).unwrap_or(0),
    );
    let expected = columns.saturating_mul(rows).saturating_mul(3);
    if expected != data.len() {
        return Err(UiError::ImageSize {
            expected,
            found: data.len(),
        });
    }
    let mut pixels = Vec::with_capacity(expected / 3 * 4);
    for row in data.chunks_exact((3 * columns).max(1)).rev() {
        for pixel in row.chunks_exact(3) {
            pixels.extend_from_slice(pixel);
            pixels.push(u8::MAX);
        }
    }
    Ok((columns, rows, pixels))
}

/// A vector drawing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Svg {
    /// The file to load it from; empty for none.
    pub file: String,
    /// The drawing in SVG.
    pub text: String,
}
