//! Segmentation by colour: each pixel takes the first colour of the palette that is close, or joins the palette.

use std::collections::HashMap;

use super::{Rgb, RgbImage};

/// Up to this size a palette is searched from its beginning, which is faster than a grid.
const MAX_LINEAR_SEARCH: usize = 64;

impl RgbImage {
    /// Pixels in index order take the first colour of the palette nearer than `distance`, else they extend the palette.
    pub fn segment_colours(&mut self, distance: f64) {
        let mut palette = Palette::new(distance);
        let mut last = None;
        for pixel in &mut self.pixels {
            // Neighbours are often equal.
            let colour = match last {
                Some((before, after)) if before == *pixel => after,
                _ => palette.first_near(*pixel),
            };
            last = Some((*pixel, colour));
            *pixel = colour;
        }
    }
}

/// Colours in order, and a grid over them: colours of one cell are at least `distance` apart, so a cell has few.
struct Palette {
    colours: Vec<Rgb>,
    cells: HashMap<[u64; 3], Vec<usize>>,
    distance: f64,
}

impl Palette {
    fn new(distance: f64) -> Self {
        Self {
            colours: Vec::new(),
            cells: HashMap::new(),
            distance: distance.abs(),
        }
    }

    fn first_near(&mut self, colour: Rgb) -> Rgb {
        // Nothing is near a colour that is not finite, and nothing is nearer than 0.
        let can_match =
            self.distance * self.distance > 0.0 && colour.iter().all(|value| value.is_finite());
        if !can_match {
            return colour;
        }
        let found = match self.colours.len() {
            ..=MAX_LINEAR_SEARCH => (0..self.colours.len()).find(|&at| self.is_near(at, colour)),
            _ => self.find_in_grid(colour),
        };
        match found {
            Some(at) => self.colours[at],
            None => self.join(colour),
        }
    }

    fn join(&mut self, colour: Rgb) -> Rgb {
        self.cells
            .entry(self.cell(colour, [0; 3]))
            .or_default()
            .push(self.colours.len());
        self.colours.push(colour);
        colour
    }

    fn is_near(&self, at: usize, colour: Rgb) -> bool {
        let squared: f64 = self.colours[at]
            .iter()
            .zip(colour)
            .map(|(a, b)| (a - b) * (a - b))
            .sum();
        squared < self.distance * self.distance
    }

    fn find_in_grid(&self, colour: Rgb) -> Option<usize> {
        let cells = (0..27).filter_map(|n: i8| {
            self.cells
                .get(&self.cell(colour, [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1]))
        });
        cells
            .flatten()
            .copied()
            .filter(|&at| self.is_near(at, colour))
            .min()
    }

    /// The cell beside that of a colour. Cells are floats, so that neither a tiny distance nor a huge value overflows.
    fn cell(&self, colour: Rgb, step: [i8; 3]) -> [u64; 3] {
        // Adding 0 makes -0 the same as 0.
        [0, 1, 2]
            .map(|i| ((colour[i] / self.distance).floor() + f64::from(step[i]) + 0.0).to_bits())
    }
}

#[cfg(test)]
mod tests {
    use test_support::random::Random;

    use super::*;

    /// The definition, without a grid.
    fn by_definition(image: &RgbImage, distance: f64) -> Vec<Rgb> {
        let mut palette: Vec<Rgb> = Vec::new();
        let near = |a: &Rgb, b: &Rgb| {
            a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() < distance * distance
        };
        image
            .pixels()
            .iter()
            .map(
                |pixel| match palette.iter().find(|colour| near(colour, pixel)) {
                    Some(colour) => *colour,
                    None => {
                        palette.push(*pixel);
                        *pixel
                    }
                },
            )
            .collect()
    }

    fn noise(size: [usize; 2]) -> RgbImage {
        let mut random = Random::new(1);
        let mut next = || f64::from(random.byte()) / 255.0;
        let mut image = RgbImage::uniform(size, [0.0; 3]);
        image
            .pixels_mut()
            .iter_mut()
            .for_each(|pixel| *pixel = [next(), next(), next()]);
        image
    }

    #[test]
    fn small_and_large_palettes_are_searched_in_order() {
        for distance in [
            0.0,
            0.05,
            0.12,
            -0.3,
            0.5,
            1.0,
            3.0,
            f64::INFINITY,
            f64::NAN,
            1e-300,
        ] {
            let mut image = noise([40, 30]);
            let expected = by_definition(&image, distance);
            image.segment_colours(distance);
            assert_eq!(image.pixels(), expected, "{distance}");
        }
    }

    #[test]
    fn colours_without_end_remain() {
        let mut image = RgbImage::uniform([2, 1], [f64::INFINITY, 0.0, 0.0]);
        image.segment_colours(0.5);
        assert_eq!(image.pixels(), [[f64::INFINITY, 0.0, 0.0]; 2]);
    }
}
