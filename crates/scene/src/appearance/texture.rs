//! Texture images.

use std::rc::Rc;

use crate::{SceneError, SceneResult};

/// An image. Its first row is the bottom one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texture {
    /// The name scripts and files give it.
    pub name: String,
    size: [u32; 2],
    has_alpha: bool,
    /// Shared between copies until one is written to.
    pixels: Rc<[u8]>,
}

/// A part of an image, within its borders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rectangle {
    position: [usize; 2],
    size: [usize; 2],
}

impl Rectangle {
    /// Number of pixels.
    fn area(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// Where its pixels are in an image of that width, row by row.
    fn places(self, width: usize) -> impl Iterator<Item = usize> {
        let [x, y] = self.position;
        (y..y + self.size[1])
            .flat_map(move |row| (x..x + self.size[0]).map(move |column| row * width + column))
    }
}

impl Texture {
    /// Largest width and height, pixels.
    pub const MAX_SIDE: u32 = 16_384;

    /// None where the pixels are not as many as the size says: red, green and blue of each, and opacity if there is one.
    pub fn new(name: &str, size: [u32; 2], has_alpha: bool, pixels: &[u8]) -> Option<Self> {
        let possible = size.iter().all(|side| (1..=Self::MAX_SIDE).contains(side));
        let texture = Self {
            name: name.to_owned(),
            size,
            has_alpha,
            pixels: pixels.into(),
        };
        (possible && texture.width() * size[1] as usize * texture.bytes_per_pixel() == pixels.len())
            .then_some(texture)
    }

    /// Width and height, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Whether pixels have an opacity after red, green and blue.
    pub fn has_alpha(&self) -> bool {
        self.has_alpha
    }

    /// Red, green, blue and, with [`has_alpha`](Self::has_alpha), opacity of each pixel, one byte each; the bottom row first.
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    fn width(&self) -> usize {
        self.size[0] as usize
    }

    fn bytes_per_pixel(&self) -> usize {
        if self.has_alpha { 4 } else { 3 }
    }

    /// Every pixel with an opacity.
    pub fn rgba(&self) -> Vec<u8> {
        let of = |pixel: &[u8]| {
            [
                pixel[0],
                pixel[1],
                pixel[2],
                pixel.get(3).copied().unwrap_or(u8::MAX),
            ]
        };
        self.pixels
            .chunks_exact(self.bytes_per_pixel())
            .flat_map(of)
            .collect()
    }

    /// A part of the image, or all of it where a side is zero.
    ///
    /// # Errors
    /// When it is not within the image.
    pub fn rectangle(&self, position: [i64; 2], size: [i64; 2]) -> SceneResult<Rectangle> {
        if size.iter().any(|side| *side <= 0) {
            return Ok(Rectangle {
                position: [0, 0],
                size: self.size.map(|side| side as usize),
            });
        }
        let within = |axis: usize| {
            let (at, side) = (
                u32::try_from(position[axis]).ok()?,
                u32::try_from(size[axis]).ok()?,
            );
            (at.checked_add(side)? <= self.size[axis]).then_some((at as usize, side as usize))
        };
        let outside = || SceneError::Refused("invalid arguments.".into());
        let ((x, width), (y, height)) = within(0).zip(within(1)).ok_or_else(outside)?;
        Ok(Rectangle {
            position: [x, y],
            size: [width, height],
        })
    }

    /// Red, green, blue of a part.
    pub fn read(&self, part: Rectangle) -> Vec<u8> {
        let step = self.bytes_per_pixel();
        part.places(self.width())
            .flat_map(|place| self.pixels[step * place..][..3].iter().copied())
            .collect()
    }

    /// Replaces red, green, blue of a part; `remains` is how much of the old colours stays, 0 to 1. Opacities stay.
    ///
    /// # Errors
    /// When there are not three bytes for each pixel.
    pub fn write(&mut self, part: Rectangle, rgb: &[u8], remains: f64) -> SceneResult<()> {
        if rgb.len() != 3 * part.area() {
            return Err(SceneError::Refused("incorrect buffer size.".into()));
        }
        let remains = if remains.is_finite() {
            remains.clamp(0.0, 1.0)
        } else {
            0.0
        };
        let mix = |old: u8, new: u8| {
            (remains * f64::from(old) + (1.0 - remains) * f64::from(new)).round() as u8
        };
        let (step, width) = (self.bytes_per_pixel(), self.width());
        let pixels = Rc::make_mut(&mut self.pixels);
        for (place, colour) in part.places(width).zip(rgb.chunks_exact(3)) {
            let old = &mut pixels[step * place..][..3];
            old.iter_mut()
                .zip(colour)
                .for_each(|(old, new)| *old = mix(*old, *new));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(has_alpha: bool) -> Texture {
        let bytes: Vec<u8> = (0..if has_alpha { 24 } else { 18 }).collect();
        Texture::new("a", [3, 2], has_alpha, &bytes).unwrap()
    }

    #[test]
    fn parts_are_read_and_written() {
        for has_alpha in [false, true] {
            let mut texture = image(has_alpha);
            let part = texture.rectangle([1, 1], [2, 1]).unwrap();
            let before = texture.read(part);
            assert_eq!(before[0], if has_alpha { 16 } else { 12 });
            texture.write(part, &[100; 6], 0.5).unwrap();
            assert_eq!(
                texture.read(part)[0],
                ((f64::from(before[0]) + 100.0) / 2.0).round() as u8
            );
            assert_eq!(texture.pixels()[..12], image(has_alpha).pixels()[..12]);
            assert_eq!(texture.rgba()[7], if has_alpha { 7 } else { 255 });
            assert!(texture.write(part, &[1; 5], 0.0).is_err());
        }
    }

    #[test]
    fn parts_outside_are_refused() {
        let texture = image(false);
        assert_eq!(
            texture.read(texture.rectangle([9, 9], [0, 0]).unwrap()),
            texture.pixels()
        );
        for (position, size) in [
            ([1, 0], [3, 1]),
            ([-1, 0], [1, 1]),
            ([0, 2], [1, 1]),
            ([i64::MAX, 0], [i64::MAX, 1]),
        ] {
            assert!(
                texture.rectangle(position, size).is_err(),
                "{position:?} {size:?}"
            );
        }
        assert!(Texture::new("a", [0, 2], false, &[]).is_none());
        assert!(Texture::new("a", [u32::MAX, u32::MAX], false, &[]).is_none());
    }
}
