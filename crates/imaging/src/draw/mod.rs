//! Drawing on matrices: lines, polygons, circles, ellipses, text. What lies outside of the image is left out.
//!
//! Pixel centres have whole coordinates, x to the right and y to later rows. Thin lines are Bresenham's; thick and antialiased ones
//! are the pixels near the ideal line.

mod circle;
mod line;
mod mask;
mod polygon;
mod text;

pub use line::clip_line;
pub use text::{FontFace, Text, TextSize, text_size};

use crate::matrix::{Matrix, MatrixError, MatrixResult};

/// A place, in pixels.
pub type PixelPosition = [f64; 2];

/// How the pixels of a line touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineType {
    /// Over sides only.
    FourConnected,
    /// Over sides and corners.
    EightConnected,
    /// The edges are mixed with what is below them.
    Antialiased,
}

/// Colour and line type of strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// A value for each channel, in the order they are stored.
    pub colour: [f64; 4],
    /// How the pixels of strokes touch.
    pub line_type: LineType,
}

/// The width of an outline, in pixels, or the inside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// An outline of so many pixels.
    Outline(u32),
    /// The inside is filled.
    Fill,
}

impl Stroke {
    const MAX_THICKNESS: i64 = 32_767;

    /// Negative numbers fill.
    ///
    /// # Errors
    /// When the outline is too thick.
    pub fn from_thickness(thickness: i64) -> MatrixResult<Self> {
        match thickness {
            ..0 => Ok(Self::Fill),
            0..=Self::MAX_THICKNESS => Ok(Self::Outline(numbers::low_u32(thickness.max(1)))),
            _ => Err(MatrixError::Range("the thickness")),
        }
    }
}

impl Matrix {
    /// Mixes the colour of a pen into a pixel, if it is inside.
    fn paint(&mut self, [x, y]: [i64; 2], pen: &Pen, coverage: f64) {
        let [width, height] = self.size();
        if x < 0 || y < 0 || x >= numbers::count(width) || y >= numbers::count(height) {
            return;
        }
        let channels = self.format().channels;
        let first = (numbers::place_of(y) * width + numbers::place_of(x)) * channels;
        for (channel, new) in pen.colour.iter().enumerate().take(channels) {
            let old = if coverage < 1.0 {
                self.value(first + channel).unwrap_or_default()
            } else {
                0.0
            };
            self.set_value(first + channel, old + (new - old) * coverage);
        }
    }

    /// Paints the pixels of a row between two columns, both included.
    fn paint_span(&mut self, row: i64, from: f64, to: f64, pen: &Pen) {
        let last = numbers::real(self.size()[0]) - 1.0;
        if row < 0 || row >= numbers::count(self.size()[1]) || from > last || to < 0.0 {
            return;
        }
        for column in numbers::truncated(from.max(0.0))..=numbers::truncated(to.min(last)) {
            self.paint([column, row], pen, 1.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::{Depth, PixelFormat};

    pub(super) const WHITE: Pen = Pen {
        colour: [255.0; 4],
        line_type: LineType::EightConnected,
    };

    pub(super) fn blank(width: usize, height: usize) -> Matrix {
        Matrix::new([width, height], PixelFormat::new(Depth::Byte, 1), 0.0).unwrap()
    }

    /// The image as text, a line for each row.
    pub(super) fn shown(image: &Matrix) -> Vec<String> {
        let rows = image.bytes().unwrap().chunks(image.size()[0]);
        rows.map(|row| {
            row.iter()
                .map(|byte| match byte {
                    0 => '.',
                    255 => '#',
                    _ => '+',
                })
                .collect()
        })
        .collect()
    }

    #[test]
    fn colours_are_mixed_inside_only() {
        let mut image = Matrix::from_bytes([1, 1], 3, vec![100, 0, 0]).unwrap();
        let pen = Pen {
            colour: [200.0, 50.0, 1e9, 7.0],
            line_type: LineType::Antialiased,
        };
        image.paint([0, 0], &pen, 0.5);
        image.paint([1, 0], &pen, 1.0);
        image.paint([0, i64::MIN], &pen, 1.0);
        assert_eq!(image.bytes(), Some(&[150, 25, 255][..]));
    }

    #[test]
    fn thickness_has_limits() {
        assert_eq!(Stroke::from_thickness(-1), Ok(Stroke::Fill));
        assert_eq!(Stroke::from_thickness(0), Ok(Stroke::Outline(1)));
        assert!(Stroke::from_thickness(i64::MAX).is_err());
    }
}
