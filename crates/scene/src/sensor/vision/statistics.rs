//! The first packet of results: smallest, largest and mean values of a picture (spec: sensors 3).

use super::VisionSensor;

/// Intensity, red, green, blue.
const CHANNELS: usize = 4;

/// Bytes of sixteen pixels: as many are compared and added at a time.
const BLOCK: usize = 48;

/// Blocks whose sums fit into 16 bits.
const BLOCKS: usize = 256;

struct Statistics {
    smallest: [u8; CHANNELS],
    largest: [u8; CHANNELS],
    sums: [u64; CHANNELS],
}

impl Statistics {
    fn of(image: &[u8]) -> Self {
        let mut statistics = Self {
            smallest: [255; CHANNELS],
            largest: [0; CHANNELS],
            sums: [0; CHANNELS],
        };
        for part in image.chunks(BLOCK * BLOCKS) {
            statistics.add_intensities(part);
            let (blocks, rest) = part.as_chunks();
            statistics.add_colours(blocks);
            for (at, level) in rest.iter().enumerate() {
                statistics.add(1 + at % 3, *level, *level, (*level).into());
            }
        }
        statistics
    }

    fn add(&mut self, channel: usize, smallest: u8, largest: u8, sum: u64) {
        self.smallest[channel] = self.smallest[channel].min(smallest);
        self.largest[channel] = self.largest[channel].max(largest);
        self.sums[channel] += sum;
    }

    /// Intensities are means of red, green and blue, rounded down.
    fn add_intensities(&mut self, image: &[u8]) {
        let (mut smallest, mut largest) = ([u16::MAX; BLOCK], [0; BLOCK]);
        let mut sums = [0u16; BLOCK];
        let mut rest = image;
        // Of the three bytes from any byte of a block on: one in three begins a pixel, but all are computed at once.
        while let Some(block) = rest.first_chunk::<{ BLOCK + 2 }>() {
            let level = |at: usize| {
                let [r, g, b] = [block[at], block[at + 1], block[at + 2]].map(u16::from);
                (r + g + b) / 3
            };
            let levels: [u16; BLOCK] = std::array::from_fn(level);
            smallest = std::array::from_fn(|at| levels[at].min(smallest[at]));
            largest = std::array::from_fn(|at| levels[at].max(largest[at]));
            sums = std::array::from_fn(|at| sums[at] + levels[at]);
            rest = &rest[BLOCK..];
        }
        if rest.len() < image.len() {
            for at in (0..BLOCK).step_by(3) {
                self.add(0, smallest[at] as u8, largest[at] as u8, sums[at].into());
            }
        }
        for pixel in rest.as_chunks::<3>().0 {
            let level = (pixel.iter().map(|level| u32::from(*level)).sum::<u32>() / 3) as u8;
            self.add(0, level, level, level.into());
        }
    }

    fn add_colours(&mut self, blocks: &[[u8; BLOCK]]) {
        let (mut smallest, mut largest, mut sums) = ([255; BLOCK], [0; BLOCK], [0u16; BLOCK]);
        for block in blocks {
            for (at, level) in block.iter().enumerate() {
                smallest[at] = (*level).min(smallest[at]);
                largest[at] = (*level).max(largest[at]);
                sums[at] += u16::from(*level);
            }
        }
        for at in 0..BLOCK {
            self.add(1 + at % 3, smallest[at], largest[at], sums[at].into());
        }
    }
}

/// Numbers that are compared and added at a time. Part of the sum is each one's that stands at the same place of a block.
const LANES: usize = 8;

/// The smallest and the largest number, and the sum.
fn extremes_and_sum(numbers: &[f32]) -> (f32, f32, f64) {
    let (mut smallest, mut largest) = ([f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]);
    let mut sums = [0.0; LANES];
    let smaller = |a: f32, b: f32| if a < b { a } else { b };
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let (blocks, rest) = numbers.as_chunks::<LANES>();
    // Whole lists are made anew, which is compiled to a few instructions each.
    for block in blocks {
        smallest = std::array::from_fn(|at| smaller(block[at], smallest[at]));
        largest = std::array::from_fn(|at| larger(block[at], largest[at]));
        sums = std::array::from_fn(|at| sums[at] + f64::from(block[at]));
    }
    for (at, &number) in rest.iter().enumerate() {
        smallest[at] = smaller(number, smallest[at]);
        largest[at] = larger(number, largest[at]);
        sums[at] += f64::from(number);
    }
    (
        smallest.into_iter().fold(f32::INFINITY, f32::min),
        largest.into_iter().fold(f32::NEG_INFINITY, f32::max),
        sums.iter().sum(),
    )
}

impl VisionSensor {
    /// First packet of a picture, made by the simulator: its statistics, unless they are switched off.
    pub fn first_packet(&self) -> Vec<f32> {
        if self.omit_statistics {
            Vec::new()
        } else {
            self.statistics()
        }
    }

    /// Smallest, largest and mean value of intensity, red, green, blue and depth, 0 to 1. Means of colours are whole steps of a byte.
    pub fn statistics(&self) -> Vec<f32> {
        let colours = Statistics::of(&self.image());
        let pixels = self.pixels() as u64;
        let means = colours.sums.map(|sum| (sum / pixels) as u8);
        let (image, depth) = ([colours.smallest, colours.largest, means], self.depth());
        let (smallest, largest, total) = extremes_and_sum(&depth);
        let depths = [smallest, largest, (total / pixels as f64) as f32];
        let rows = image.into_iter().zip(depths);
        rows.flat_map(|(levels, depth)| {
            levels
                .into_iter()
                .map(|level| f32::from(level) / 255.0)
                .chain(std::iter::once(depth))
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::VisionOptions;

    #[test]
    fn means_are_whole_steps() {
        let mut sensor = VisionSensor::new(VisionOptions::empty(), [2, 1], None);
        sensor.image = vec![255, 0, 10, 0, 1, 10];
        sensor.depth = vec![0.25, 0.5];
        let level = |level: f32| level / 255.0;
        let expected = [level(3.0), 0.0, 0.0, level(10.0), 0.25];
        assert_eq!(sensor.statistics()[..5], expected);
        assert_eq!(
            sensor.statistics()[5..10],
            [level(88.0), 1.0, level(1.0), level(10.0), 0.5]
        );
        assert_eq!(
            sensor.statistics()[10..],
            [level(45.0), level(127.0), 0.0, level(10.0), 0.375]
        );
    }

    /// Pixel by pixel.
    fn expected(image: &[u8]) -> [[u8; 3]; CHANNELS] {
        let grey =
            |pixel: &[u8; 3]| (pixel.iter().map(|level| u32::from(*level)).sum::<u32>() / 3) as u8;
        let (pixels, _) = image.as_chunks::<3>();
        [0, 1, 2, 3].map(|channel| {
            let level = |pixel: &[u8; 3]| {
                if channel == 0 {
                    grey(pixel)
                } else {
                    pixel[channel - 1]
                }
            };
            let levels = || pixels.iter().map(level);
            let mean = levels().map(u64::from).sum::<u64>() / pixels.len() as u64;
            [levels().min().unwrap(), levels().max().unwrap(), mean as u8]
        })
    }

    #[test]
    fn all_pixels_of_large_and_odd_pictures_count() {
        for pixels in [1, 15, 17, 16 * BLOCKS, 16 * BLOCKS + 5, 40_000] {
            let mut image: Vec<u8> = (0..3 * pixels)
                .map(|at| (at * at % 251 + 2) as u8)
                .collect();
            image[3 * pixels - 2..].copy_from_slice(&[255, 0]);
            let found = Statistics::of(&image);
            let mean = |channel: usize| (found.sums[channel] / pixels as u64) as u8;
            let all = [0, 1, 2, 3].map(|at| [found.smallest[at], found.largest[at], mean(at)]);
            assert_eq!(all, expected(&image), "{pixels}");
        }
    }

    #[test]
    fn without_a_picture_all_is_black_and_far() {
        let sensor = VisionSensor::new(VisionOptions::empty(), [2, 2], None);
        assert_eq!(sensor.statistics(), [0.0, 0.0, 0.0, 0.0, 1.0].repeat(3));
    }
}
