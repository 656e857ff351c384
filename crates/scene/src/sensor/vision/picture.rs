//! Parts of pictures: reading and writing rectangles of pixels in the formats of scripts.

use std::borrow::Cow;
use std::ops::Range;

use super::VisionSensor;

/// A rectangle of pixels of a picture; the first row is the lowest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Area {
    x: usize,
    y: usize,
    width: usize,
    height: usize,
    /// Pixels in a row of the whole picture.
    stride: usize,
}

impl Area {
    /// The whole of a picture.
    pub fn whole(resolution: [u32; 2]) -> Self {
        let [width, height] = resolution.map(|side| side as usize);
        Self {
            x: 0,
            y: 0,
            width,
            height,
            stride: width,
        }
    }

    /// The part of a picture that starts at `position`; from its corner, with a width that is not positive, the whole picture. None when it
    /// reaches outside.
    pub fn part(resolution: [u32; 2], position: [i64; 2], size: [i64; 2]) -> Option<Self> {
        let whole = Self::whole(resolution);
        if size[0] <= 0 && position == [0, 0] {
            return Some(whole);
        }
        let within = |start: i64, length: i64, end: usize| {
            let (start, length) = (usize::try_from(start).ok()?, usize::try_from(length).ok()?);
            let fits = length > 0 && start.checked_add(length)? <= end;
            fits.then_some((start, length))
        };
        let (x, width) = within(position[0], size[0], whole.width)?;
        let (y, height) = within(position[1], size[1], whole.height)?;
        Some(Self {
            x,
            y,
            width,
            height,
            ..whole
        })
    }

    /// How many pixels it has.
    pub fn pixels(self) -> usize {
        self.width * self.height
    }

    /// For each of its rows the numbers of its pixels in the whole picture.
    fn rows(self) -> impl Iterator<Item = Range<usize>> {
        (self.y..self.y + self.height).map(move |y| {
            let start = y * self.stride + self.x;
            start..start + self.width
        })
    }

    /// The numbers of its pixels in the whole picture, row by row.
    fn indices(self) -> impl Iterator<Item = usize> {
        self.rows().flatten()
    }
}

/// Mean of red, green and blue, rounded down.
fn grey_level(pixel: &[u8]) -> u8 {
    (pixel.iter().map(|&part| u32::from(part)).sum::<u32>() / 3) as u8
}

impl VisionSensor {
    /// Red, green, blue of each pixel, from the lowest row; black before there was a picture.
    pub fn image(&self) -> Cow<'_, [u8]> {
        if self.image.is_empty() {
            vec![0; self.image_len()].into()
        } else {
            self.image.as_slice().into()
        }
    }

    /// Depth of each pixel, 0 near to 1 far; far before there was a picture.
    pub fn depth(&self) -> Cow<'_, [f32]> {
        if self.depth.is_empty() {
            vec![1.0; self.pixels()].into()
        } else {
            self.depth.as_slice().into()
        }
    }

    /// Pixels of a part: red, green, blue or one grey level. With `alpha`, another byte follows: 255 up to that depth, 0 behind it.
    pub fn image_part(&self, area: Area, grey: bool, alpha: Option<f32>) -> Vec<u8> {
        if !grey && alpha.is_none() {
            return self.colours(area);
        }
        let (image, depth) = (self.image(), self.depth());
        let mut part = Vec::with_capacity(
            area.pixels() * (if grey { 1 } else { 3 } + usize::from(alpha.is_some())),
        );
        for pixel in area.indices() {
            let colour = &image[3 * pixel..3 * pixel + 3];
            match grey {
                true => part.push(grey_level(colour)),
                false => part.extend_from_slice(colour),
            }
            part.extend(alpha.map(|limit| if depth[pixel] <= limit { 255 } else { 0 }));
        }
        part
    }

    /// Red, green, blue of each pixel of a part.
    fn colours(&self, area: Area) -> Vec<u8> {
        let image = self.image();
        let mut part = Vec::with_capacity(3 * area.pixels());
        for row in area.rows() {
            part.extend_from_slice(&image[3 * row.start..3 * row.end]);
        }
        part
    }

    /// Depths of a part, 0 near to 1 far, or in metres along the axis.
    pub fn depth_part(&self, area: Area, metres: bool) -> Vec<f32> {
        let (depth, [near, far]) = (self.depth(), self.view.clipping);
        let mut part = Vec::with_capacity(area.pixels());
        for row in area.rows() {
            let depths = depth[row].iter().copied();
            if metres {
                part.extend(depths.map(|depth| (near + f64::from(depth) * (far - near)) as f32));
            } else {
                part.extend(depths);
            }
        }
        part
    }

    /// Replaces the pixels of a part; false, and nothing changes, when there are not as many bytes as it needs.
    pub fn set_image_part(&mut self, area: Area, pixels: &[u8], grey: bool) -> bool {
        let bytes = if grey { 1 } else { 3 };
        if pixels.len() != area.pixels() * bytes {
            return false;
        }
        let mut image = std::mem::take(&mut self.image);
        image.resize(self.image_len(), 0);
        for (pixel, colour) in area.indices().zip(pixels.chunks_exact(bytes)) {
            let colour = if grey {
                [colour[0]; 3]
            } else {
                [colour[0], colour[1], colour[2]]
            };
            image[3 * pixel..3 * pixel + 3].copy_from_slice(&colour);
        }
        self.image = image;
        true
    }

    /// Replaces the depths of a part, 0 near to 1 far; false, and nothing changes, when there are not as many as it needs.
    pub fn set_depth_part(&mut self, area: Area, values: &[f32]) -> bool {
        if values.len() != area.pixels() {
            return false;
        }
        let mut depth = std::mem::take(&mut self.depth);
        depth.resize(self.pixels(), 1.0);
        area.indices()
            .zip(values)
            .for_each(|(pixel, &value)| depth[pixel] = value);
        self.depth = depth;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::VisionOptions;

    fn sensor() -> VisionSensor {
        let mut sensor = VisionSensor::new(VisionOptions::empty(), [3, 2], None);
        sensor.image = (0..18).collect();
        sensor.depth = vec![0.0, 0.2, 0.4, 0.6, 0.8, 1.0];
        sensor
    }

    #[test]
    fn parts_begin_with_their_lowest_row() {
        let (sensor, resolution) = (sensor(), [3, 2]);
        let part = Area::part(resolution, [1, 0], [2, 2]).unwrap();
        assert_eq!(sensor.image_part(part, true, None), [4, 7, 13, 16]);
        assert_eq!(
            sensor.image_part(part, false, None),
            [3, 4, 5, 6, 7, 8, 12, 13, 14, 15, 16, 17]
        );
        assert_eq!(
            sensor.image_part(part, true, Some(0.4)),
            [4, 255, 7, 255, 13, 0, 16, 0]
        );
        assert_eq!(sensor.depth_part(part, false), [0.2, 0.4, 0.8, 1.0]);
        assert_eq!(
            sensor.depth_part(Area::part(resolution, [2, 1], [1, 1]).unwrap(), true),
            [10.0]
        );
    }

    #[test]
    fn what_reaches_outside_is_no_part() {
        let part = |position, size| Area::part([3, 2], position, size);
        assert_eq!(part([0, 0], [0, 7]), Some(Area::whole([3, 2])));
        for (position, size) in [
            ([1, 0], [3, 1]),
            ([-1, 0], [1, 1]),
            ([0, 0], [1, 0]),
            ([0, 1], [1, 2]),
            ([i64::MAX, 0], [i64::MAX, 1]),
        ] {
            assert_eq!(part(position, size), None, "{position:?} {size:?}");
        }
    }

    #[test]
    fn written_parts_are_read_back() {
        let mut sensor = VisionSensor {
            image: Vec::new(),
            depth: Vec::new(),
            ..sensor()
        };
        let part = Area::part([3, 2], [1, 1], [2, 1]).unwrap();
        assert!(!sensor.set_image_part(part, &[1, 2, 3], true) && sensor.image.is_empty());
        assert!(sensor.set_image_part(part, &[9, 8], true));
        assert_eq!(sensor.image[9..], [0, 0, 0, 9, 9, 9, 8, 8, 8]);
        assert!(sensor.set_depth_part(part, &[0.5, 0.25]) && !sensor.set_depth_part(part, &[0.5]));
        assert_eq!(sensor.depth, [1.0, 1.0, 1.0, 1.0, 0.5, 0.25]);
    }
}
