//! Colours of many small parts of a mesh, as pixels of an image.

use std::collections::BTreeMap;
use std::sync::Arc;

use rendering::{Image, Texture, TextureMode};

/// Pixels in a row of the image.
const WIDTH: usize = 256;

/// Colours, each once.
#[derive(Default)]
pub(super) struct Palette {
    numbers: BTreeMap<[u8; 3], usize>,
    pixels: Vec<u8>,
}

impl Palette {
    /// The number of a colour, which is added if it is new.
    pub(super) fn number(&mut self, colour: [u8; 3]) -> usize {
        let next = self.numbers.len();
        *self.numbers.entry(colour).or_insert_with(|| {
            self.pixels.extend(colour);
            next
        })
    }

    fn height(&self) -> usize {
        self.numbers.len().div_ceil(WIDTH)
    }

    /// Texture coordinates of a colour, once all colours are there.
    pub(super) fn place(&self, number: usize) -> [f32; 2] {
        let (column, row) = (number % WIDTH, number / WIDTH);
        [
            (column as f32 + 0.5) / WIDTH as f32,
            (row as f32 + 0.5) / self.height() as f32,
        ]
    }

    /// The image; None without colours.
    pub(super) fn texture(mut self) -> Option<Texture> {
        let height = self.height();
        self.pixels.resize(3 * WIDTH * height, 0);
        let image = Arc::new(Image::new(
            [WIDTH as u32, height as u32],
            false,
            &self.pixels,
        )?);
        Some(Texture {
            repeat: [false; 2],
            interpolate: false,
            mode: TextureMode::Modulate,
            image,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_has_one_number() {
        let mut palette = Palette::default();
        let numbers: Vec<usize> = [[1, 2, 3], [4, 5, 6], [1, 2, 3]]
            .map(|colour| palette.number(colour))
            .into();
        assert_eq!(numbers, [0, 1, 0]);
        assert_eq!(palette.place(1), [1.5 / 256.0, 0.5]);
        assert_eq!(palette.texture().unwrap().image.size(), [256, 1]);
        assert!(Palette::default().texture().is_none());
    }

    #[test]
    fn many_colours_have_rows_of_their_own() {
        let mut palette = Palette::default();
        for number in 0..600_u16 {
            let [low, high] = number.to_le_bytes();
            assert_eq!(palette.number([low, high, 0]), usize::from(number));
        }
        assert_eq!(palette.place(0), [0.5 / 256.0, 0.5 / 3.0]);
        assert_eq!(palette.place(258), [2.5 / 256.0, 0.5]);
        assert_eq!(palette.place(599), [87.5 / 256.0, 2.5 / 3.0]);
    }
}
