//! Text. OpenCV has fonts of strokes; here the glyphs are those of DejaVu Sans, in the same height.

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};

use super::mask::{Mask, coverage};
use super::{LineType, Pen, PixelPosition};
use crate::matrix::{DistanceType, MaskSize, Matrix, MatrixError, MatrixResult};

/// Height of capitals of DejaVu Sans, by that of its lines.
const CAPITALS: f64 = 0.729 / 1.164;
/// Columns an italic letter leans by, for each row.
const SLANT: f64 = 0.2;
/// Largest height of a line of text, pixels.
const MAX_LINE_HEIGHT: f64 = 4096.0;

/// A font of OpenCV, of which the size counts here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FontFace {
    /// Sans serif.
    Simplex,
    /// Sans serif, small.
    Plain,
    /// Sans serif with double strokes.
    Duplex,
    /// Serif.
    Complex,
    /// Serif with triple strokes.
    Triplex,
    /// Serif, small.
    ComplexSmall,
    /// Handwriting.
    ScriptSimplex,
    /// Handwriting with double strokes.
    ScriptComplex,
}

impl FontFace {
    /// Pixels of a capital above the baseline, and of a line below it, at scale 1.
    fn heights(self) -> [f64; 2] {
        match self {
            Self::Plain => [9.0, 5.0],
            Self::ComplexSmall => [13.0, 6.0],
            _ => [21.0, 9.0],
        }
    }
}

/// The size of a text, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TextSize {
    /// From the first letter to the last.
    pub width: i64,
    /// Height above the baseline, pixels.
    pub height: i64,
    /// Height below the baseline, pixels.
    pub baseline: i64,
}

/// The size of a text with letters of `scale` times the font's size and strokes of `thickness` pixels.
///
/// # Errors
/// When the letters are too large.
pub fn text_size(text: &str, face: FontFace, scale: f64, thickness: u32) -> MatrixResult<TextSize> {
    let font = font();
    let (_, width) = glyphs(&font, text, pixel_scale(face, scale)?, f64::INFINITY);
    let [capitals, below] = face.heights();
    Ok(TextSize {
        width: numbers::truncated((width + f64::from(thickness)).round()),
        height: numbers::truncated(
            (capitals * scale + f64::from(thickness + 1) / 2.0).round_ties_even(),
        ),
        baseline: numbers::truncated(
            (below * scale + f64::from(thickness) / 2.0).round_ties_even(),
        ),
    })
}

/// A text and how it looks.
#[derive(Debug, Clone, Copy)]
pub struct Text<'a> {
    /// What is written.
    pub text: &'a str,
    /// The font.
    pub face: FontFace,
    /// Size of the letters as a factor of the font's.
    pub scale: f64,
    /// Pixels of a stroke.
    pub thickness: u32,
    /// Whether letters lean.
    pub is_italic: bool,
    /// Rows go up from the bottom of the image, so that letters stand on their heads in the order of rows.
    pub is_from_bottom: bool,
}

impl Matrix {
    /// Draws a text whose baseline begins at a place.
    ///
    /// # Errors
    /// When the letters are too large.
    pub fn draw_text(&mut self, at: PixelPosition, text: &Text<'_>, pen: &Pen) -> MatrixResult<()> {
        let font = font();
        let scale = pixel_scale(text.face, text.scale)?;
        let height = f64::from(scale.y);
        let (glyphs, width) = glyphs(
            &font,
            text.text,
            scale,
            numbers::real(self.size()[0]) - at[0] + height,
        );
        let margin = f64::from(text.thickness) + height;
        let ends = [at, [at[0] + width, at[1]]];
        let Some(mut mask) = Mask::around(self, &ends, margin) else {
            return Ok(());
        };
        let direction = if text.is_from_bottom { -1.0 } else { 1.0 };
        for glyph in glyphs
            .into_iter()
            .filter_map(|glyph| font.outline_glyph(glyph))
        {
            let bounds = glyph.px_bounds();
            glyph.draw(|x, y, part| {
                let (x, y) = (
                    f64::from(bounds.min.x) + f64::from(x),
                    f64::from(bounds.min.y) + f64::from(y),
                );
                let x = if text.is_italic { x - y * SLANT } else { x };
                mask.add_pixel(
                    [
                        numbers::truncated((at[0] + x).round()),
                        numbers::truncated((at[1] + y * direction).round()),
                    ],
                    part.into(),
                );
            });
        }
        thicken(&mut mask, text.thickness, pen.line_type)?;
        mask.paint(self, pen);
        Ok(())
    }
}

fn font() -> FontRef<'static> {
    FontRef::try_from_slice(dejavu::sans::regular()).expect("the font of the library is one")
}

fn pixel_scale(face: FontFace, scale: f64) -> MatrixResult<PxScale> {
    let height = face.heights()[0] * scale / CAPITALS;
    let is_possible = (0.0..=MAX_LINE_HEIGHT).contains(&height);
    if is_possible {
        Ok(PxScale::from(numbers::single(height)))
    } else {
        Err(MatrixError::Range("the font scale"))
    }
}

/// The glyphs of a text from a place (0, 0) on, as far as `limit`, and its width.
fn glyphs(font: &FontRef<'_>, text: &str, scale: PxScale, limit: f64) -> (Vec<Glyph>, f64) {
    let scaled = font.as_scaled(scale);
    let mut glyphs = Vec::new();
    let mut width = 0.0;
    for letter in text.chars() {
        let id = font.glyph_id(letter);
        if f64::from(width) > limit {
            break;
        }
        glyphs.push(id.with_scale_and_position(scale, point(width, 0.0)));
        width += scaled.h_advance(id);
    }
    (glyphs, width.into())
}

/// Letters of a thickness above 1 reach half of it farther. Without antialiasing a pixel is covered or not.
fn thicken(mask: &mut Mask, thickness: u32, line_type: LineType) -> MatrixResult<()> {
    if thickness > 1 {
        let inverse = mask
            .coverage_mut()
            .iter()
            .map(|part| u8::from(*part < 0.5))
            .collect();
        let inverse = Matrix::from_bytes(mask.size(), 1, inverse)?;
        let distances = inverse.distance_transform(DistanceType::Euclidean, MaskSize::Precise)?;
        let radius = f64::from(thickness - 1) / 2.0;
        for (at, part) in mask.coverage_mut().iter_mut().enumerate() {
            *part = numbers::single(coverage(
                radius - distances.value(at).unwrap_or_default(),
                line_type,
            ));
        }
    } else if line_type != LineType::Antialiased {
        mask.coverage_mut()
            .iter_mut()
            .for_each(|part| *part = if *part >= 0.5 { 1.0 } else { 0.0 });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::tests::{WHITE, blank};
    use super::*;

    const PLAIN: Text<'static> = Text {
        text: "HI",
        face: FontFace::Simplex,
        scale: 1.0,
        thickness: 1,
        is_italic: false,
        is_from_bottom: false,
    };

    /// First and last row with letters, and how many pixels they have.
    fn rows(text: &Text<'_>, pen: &Pen) -> (usize, usize, usize) {
        let mut image = blank(80, 80);
        image.draw_text([5.0, 40.0], text, pen).unwrap();
        let white: Vec<usize> = (0..6400)
            .filter(|at| image.value(*at) == Some(255.0))
            .map(|at| at / 80)
            .collect();
        (white[0], *white.last().unwrap(), white.len())
    }

    #[test]
    fn capitals_stand_on_the_baseline() {
        let (first, last, _) = rows(&PLAIN, &WHITE);
        assert!(
            (18..=20).contains(&first) && (39..=40).contains(&last),
            "{first} {last}"
        );
        let (first, last, _) = rows(
            &Text {
                is_from_bottom: true,
                ..PLAIN
            },
            &WHITE,
        );
        assert!(
            (40..=41).contains(&first) && (60..=62).contains(&last),
            "{first} {last}"
        );
    }

    #[test]
    fn thick_letters_are_larger() {
        let (first, last, count) = rows(
            &Text {
                thickness: 5,
                ..PLAIN
            },
            &WHITE,
        );
        let (_, _, thin) = rows(&PLAIN, &WHITE);
        assert!(
            count > 2 * thin && first <= 18 && last >= 41,
            "{first} {last} {count} {thin}"
        );
        let (_, _, italic) = rows(
            &Text {
                is_italic: true,
                ..PLAIN
            },
            &Pen {
                line_type: LineType::Antialiased,
                ..WHITE
            },
        );
        assert!(italic > 0);
    }

    #[test]
    fn sizes() {
        let size = text_size("HI", FontFace::Simplex, 1.0, 1).unwrap();
        assert_eq!((size.height, size.baseline), (22, 10));
        assert!(
            size.width > 20
                && text_size("HIHI", FontFace::Simplex, 1.0, 1).unwrap().width
                    >= 2 * size.width - 2
        );
        assert!(text_size("x", FontFace::Plain, 1e9, 1).is_err());
        assert!(text_size("x", FontFace::Plain, f64::NAN, 1).is_err());
        assert_eq!(text_size("", FontFace::Plain, 1.0, 1).unwrap().width, 1);
    }

    #[test]
    fn odd_texts_are_drawn() {
        for text in ["", "\0\n\u{10ffff}", &"W".repeat(10_000)] {
            let mut image = blank(20, 20);
            image
                .draw_text([-1e9, 5.0], &Text { text, ..PLAIN }, &WHITE)
                .unwrap();
            image
                .draw_text(
                    [3.0, 1e9],
                    &Text {
                        text,
                        thickness: 32_767,
                        ..PLAIN
                    },
                    &WHITE,
                )
                .unwrap();
            image
                .draw_text(
                    [3.0, 10.0],
                    &Text {
                        text,
                        scale: 0.0,
                        ..PLAIN
                    },
                    &WHITE,
                )
                .unwrap();
        }
        assert!(
            blank(2, 2)
                .draw_text(
                    [0.0, 0.0],
                    &Text {
                        scale: 1e300,
                        ..PLAIN
                    },
                    &WHITE
                )
                .is_err()
        );
    }
}
