//! Connected bright regions and the smallest boxes around them.

use super::{BLACK, Rgb, RgbImage, mean};

/// A connected region, in pixels; places are indices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blob {
    /// Number of pixels.
    pub count: usize,
    /// Angle of the box, rad.
    pub orientation: f64,
    /// Centre of the box.
    pub centre: [f64; 2],
    /// Sides of the box: the pixels from end to end, less 1.
    pub extent: [f64; 2],
}

/// Regions of an image: each pixel has the number of its region, in the order of their first pixels.
struct Regions {
    of_pixel: Vec<Option<u32>>,
    count: usize,
}

impl RgbImage {
    /// Finds the regions of pixels whose mean reaches `threshold`, connected over sides and corners. Those with a smaller share of the
    /// image than `smallest` are blackened and left out. With `modify`, everything else is black and each region has one colour.
    pub fn detect_blobs(&mut self, threshold: f64, smallest: f64, modify: bool) -> Vec<Blob> {
        let regions = self.regions(threshold);
        let mut outlines = vec![Outline::default(); regions.count];
        for (at, region) in regions.of_pixel.iter().enumerate() {
            if let Some(region) = region {
                outlines[*region as usize].add(at % self.width, at / self.width);
            }
        }
        let all = numbers::real(self.pixels.len());
        let is_small = |outline: &Outline| (numbers::real(outline.count) / all) < smallest;
        let removed: Vec<bool> = outlines.iter().map(is_small).collect();
        for (pixel, region) in self.pixels.iter_mut().zip(&regions.of_pixel) {
            match *region {
                Some(region) if removed[region as usize] => *pixel = BLACK,
                Some(region) if modify => *pixel = colour_of(region),
                None if modify => *pixel = BLACK,
                _ => {}
            }
        }
        outlines
            .iter()
            .filter(|outline| !is_small(outline))
            .map(Outline::smallest_box)
            .collect()
    }

    fn regions(&self, threshold: f64) -> Regions {
        let is_bright: Vec<bool> = self
            .pixels
            .iter()
            .map(|pixel| mean(*pixel) >= threshold)
            .collect();
        let mut of_pixel = vec![None; is_bright.len()];
        let mut count = 0;
        let mut pending = Vec::new();
        for first in 0..is_bright.len() {
            if !is_bright[first] || of_pixel[first].is_some() {
                continue;
            }
            of_pixel[first] = Some(count);
            pending.push(first);
            while let Some(at) = pending.pop() {
                self.each_neighbour(at, |neighbour| {
                    if is_bright[neighbour] && of_pixel[neighbour].is_none() {
                        of_pixel[neighbour] = Some(count);
                        pending.push(neighbour);
                    }
                });
            }
            count += 1;
        }
        Regions {
            of_pixel,
            count: count as usize,
        }
    }

    /// The pixels beside a pixel, over sides and corners, itself included.
    fn each_neighbour(&self, at: usize, mut visit: impl FnMut(usize)) {
        let (column, row) = (at % self.width, at / self.width);
        for y in row.saturating_sub(1)..=(row + 1).min(self.height - 1) {
            for x in column.saturating_sub(1)..=(column + 1).min(self.width - 1) {
                visit(y * self.width + x);
            }
        }
    }

    /// Draws the boxes of blobs.
    pub fn draw_boxes(&mut self, blobs: &[Blob], colour: Rgb) {
        for blob in blobs {
            let (sin, cos) = libm::sincos(blob.orientation);
            let corner = |[x, y]: [f64; 2]| {
                let (x, y) = (x * blob.extent[0] / 2.0, y * blob.extent[1] / 2.0);
                [
                    blob.centre[0] + x * cos - y * sin,
                    blob.centre[1] + x * sin + y * cos,
                ]
            };
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner);
            (0..4).for_each(|i| self.draw_line(corners[i], corners[(i + 1) % 4], colour));
        }
    }
}

/// Seven colours, then the same ones darker.
fn colour_of(region: u32) -> Rgb {
    const COLOURS: [Rgb; 7] = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
        [1.0; 3],
    ];
    const DARKEST: f64 = 0.19;
    const RISE: f64 = 0.7;
    let mut brightness = 0.8 - 0.2 * f64::from(region / 7);
    if brightness < DARKEST {
        brightness += RISE * ((DARKEST - brightness) / RISE).ceil();
    }
    COLOURS[region as usize % 7].map(|part| part * brightness)
}

/// The first and last pixel of a region in each of its rows: all that a box around it depends on.
#[derive(Clone, Default)]
struct Outline {
    count: usize,
    /// Row, first and last column.
    rows: Vec<[usize; 3]>,
}

impl Outline {
    /// Adds a pixel; pixels come row by row.
    fn add(&mut self, column: usize, row: usize) {
        self.count += 1;
        match self.rows.last_mut() {
            Some([last, _, end]) if *last == row => *end = column,
            _ => self.rows.push([row, column, column]),
        }
    }

    /// The box of least area. Angles are tried in steps of an eighth of a turn's quarter, then three times around the best in thirds.
    fn smallest_box(&self) -> Blob {
        const STEP: f64 = std::f64::consts::FRAC_PI_8;
        let mut best = self.box_at(0.0);
        for n in 1..4 {
            self.improve(&mut best, STEP * f64::from(n));
        }
        let mut step = STEP;
        for _ in 0..3 {
            step /= 3.0;
            let middle = best.orientation;
            for n in [-2.0, -1.0, 1.0, 2.0] {
                self.improve(&mut best, n * step - middle);
            }
        }
        best
    }

    fn improve(&self, best: &mut Blob, angle: f64) {
        let area = |blob: &Blob| blob.extent[0] * blob.extent[1];
        let other = self.box_at(angle);
        if area(&other) < area(best) {
            *best = other;
        }
    }

    /// The box that is upright once everything is turned by `angle`.
    fn box_at(&self, angle: f64) -> Blob {
        let (sin, cos) = libm::sincos(angle);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for &[row, first, last] in &self.rows {
            for column in [first, last] {
                let (x, y) = (numbers::real(column), numbers::real(row));
                let turned = [x * cos - y * sin, x * sin + y * cos];
                low = [0, 1].map(|i| low[i].min(turned[i]));
                high = [0, 1].map(|i| high[i].max(turned[i]));
            }
        }
        let [x, y] = [0, 1].map(|i| (low[i] + high[i]) / 2.0);
        Blob {
            count: self.count,
            orientation: 0.0 - angle,
            centre: [x * cos + y * sin, y * cos - x * sin],
            extent: [0, 1].map(|i| high[i] - low[i]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{white, white_at};
    use super::*;

    const RECTANGLE: [(usize, usize); 6] = [(2, 3), (3, 3), (4, 3), (2, 4), (3, 4), (4, 4)];

    #[test]
    fn a_box_around_a_rectangle() {
        let mut image = white_at([8, 8], &RECTANGLE);
        let blobs = image.detect_blobs(0.5, 0.0, false);
        assert_eq!(
            blobs,
            [Blob {
                count: 6,
                orientation: 0.0,
                centre: [3.0, 3.5],
                extent: [2.0, 1.0]
            }]
        );
        assert_eq!(white(&image), RECTANGLE);
    }

    #[test]
    fn small_blobs_become_black() {
        let mut image = white_at([8, 8], &RECTANGLE);
        assert_eq!(image.detect_blobs(0.5, 0.1, false), []);
        assert_eq!(image, RgbImage::uniform([8, 8], BLACK));
    }

    #[test]
    fn corners_connect_and_the_first_pixel_orders() {
        let mut image = white_at([9, 4], &[(8, 0), (0, 1), (1, 2), (2, 1), (8, 3)]);
        let counts: Vec<usize> = image
            .detect_blobs(0.5, 0.0, true)
            .iter()
            .map(|blob| blob.count)
            .collect();
        assert_eq!(counts, [1, 3, 1]);
        assert_eq!(image.get(8, 0), Some([0.8, 0.0, 0.0]));
        assert_eq!(image.get(1, 2), Some([0.0, 0.8, 0.0]));
        assert_eq!(image.get(8, 3), Some([0.8, 0.8, 0.0]));
    }

    #[test]
    fn a_diagonal_strip_has_a_box_along_it() {
        let places: Vec<_> = (0..20).flat_map(|k| [(k, k), (k + 1, k)]).collect();
        let blobs = white_at([32, 32], &places).detect_blobs(0.5, 0.0, false);
        assert!(
            (blobs[0].orientation.rem_euclid(std::f64::consts::FRAC_PI_2)
                - std::f64::consts::FRAC_PI_4)
                .abs()
                < 0.05
        );
        assert!(
            blobs[0].extent[0].min(blobs[0].extent[1]) < 2.0,
            "{blobs:?}"
        );
    }

    #[test]
    fn colours_stay_visible() {
        for region in [0, 20, 21, 34, 35, u32::MAX] {
            let brightest = colour_of(region).into_iter().fold(0.0, f64::max);
            assert!((0.18..=0.9).contains(&brightest), "{region} {brightest}");
        }
        assert!((colour_of(28)[0] - 0.7).abs() < 1e-12);
    }

    #[test]
    fn boxes_are_drawn() {
        let mut image = white_at([8, 8], &RECTANGLE);
        let blobs = image.detect_blobs(0.5, 0.0, false);
        image.draw_boxes(&blobs, [1.0, 0.0, 1.0]);
        assert_eq!(white(&image), []);
    }
}
