//! The first packet of results: smallest, largest and mean values of a picture (spec: sensors 3).

use super::VisionSensor;
use super::picture::grey_level;

/// Intensity, red, green, blue.
const CHANNELS: usize = 4;

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
        for pixel in image.chunks_exact(3) {
            let levels = [grey_level(pixel), pixel[0], pixel[1], pixel[2]];
            for (channel, level) in levels.into_iter().enumerate() {
                statistics.smallest[channel] = statistics.smallest[channel].min(level);
                statistics.largest[channel] = statistics.largest[channel].max(level);
                statistics.sums[channel] += u64::from(level);
            }
        }
        statistics
    }
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
        let total: f64 = depth.iter().map(|&depth| f64::from(depth)).sum();
        let depths = [
            depth.iter().copied().fold(f32::INFINITY, f32::min),
            depth.iter().copied().fold(f32::NEG_INFINITY, f32::max),
            (total / pixels as f64) as f32,
        ];
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

    #[test]
    fn without_a_picture_all_is_black_and_far() {
        let sensor = VisionSensor::new(VisionOptions::empty(), [2, 2], None);
        assert_eq!(sensor.statistics(), [0.0, 0.0, 0.0, 0.0, 1.0].repeat(3));
    }
}
