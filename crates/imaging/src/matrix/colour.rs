//! Grey, HSV and HLS. The first channel counts as red, whatever it holds: images of cameras begin with blue.
//!
//! Hue is 0 to 179 in bytes, two degrees each, and 0 to 360 in floats; everything else is 0 to 255 or 0 to 1.

use super::{Depth, Matrix, MatrixResult, Value, Values};

/// The weights of red, green and blue in grey (ITU-R BT.601), and in bytes as parts of 2^15, whose sum is 2^15.
const GREY: [f64; 3] = [0.299, 0.587, 0.114];
const GREY_PARTS: [u32; 3] = [9798, 19235, 3735];

impl Matrix {
    /// The brightness of an image of three or four channels, as one channel.
    pub fn grey_from_rgb(&self) -> MatrixResult<Self> {
        self.require(
            self.channels == 3 || self.channels == 4,
            "conversion to grey",
        )?;
        let values = match &self.values {
            Values::Bytes(values) => {
                Values::Bytes(values.chunks_exact(self.channels).map(grey_byte).collect())
            }
            Values::Floats(values) => {
                Values::Floats(values.chunks_exact(self.channels).map(grey_float).collect())
            }
        };
        Ok(Self {
            channels: 1,
            values,
            ..self.shape()
        })
    }

    /// The first and the third channel exchanged: red, green, blue from blue, green, red.
    pub fn swapped(&self) -> MatrixResult<Self> {
        self.require(self.channels >= 3, "an exchange of channels")?;
        let mut swapped = self.clone();
        match &mut swapped.values {
            Values::Bytes(values) => values
                .chunks_exact_mut(self.channels)
                .for_each(|pixel| pixel.swap(0, 2)),
            Values::Floats(values) => values
                .chunks_exact_mut(self.channels)
                .for_each(|pixel| pixel.swap(0, 2)),
        }
        Ok(swapped)
    }

    /// Three equal channels from one.
    pub fn rgb_from_grey(&self) -> MatrixResult<Self> {
        self.require(self.channels == 1, "conversion from grey")?;
        let values = match &self.values {
            Values::Bytes(values) => {
                Values::Bytes(values.iter().flat_map(|value| [*value; 3]).collect())
            }
            Values::Floats(values) => {
                Values::Floats(values.iter().flat_map(|value| [*value; 3]).collect())
            }
        };
        Ok(Self {
            channels: 3,
            values,
            ..self.shape()
        })
    }

    /// Hue, saturation and value from red, green and blue.
    pub fn hsv_from_rgb(&self) -> MatrixResult<Self> {
        self.convert_colours(hsv_from_rgb, [1.0; 3], hue_scale(self.format().depth))
    }

    /// Red, green and blue from hue, saturation and value.
    pub fn rgb_from_hsv(&self) -> MatrixResult<Self> {
        self.convert_colours(rgb_from_hsv, hue_scale(self.format().depth), [1.0; 3])
    }

    /// Hue, lightness and saturation from red, green and blue.
    pub fn hls_from_rgb(&self) -> MatrixResult<Self> {
        self.convert_colours(hls_from_rgb, [1.0; 3], hue_scale(self.format().depth))
    }

    /// Red, green and blue from hue, lightness and saturation.
    pub fn rgb_from_hls(&self) -> MatrixResult<Self> {
        self.convert_colours(rgb_from_hls, hue_scale(self.format().depth), [1.0; 3])
    }

    /// Converts pixels, as numbers of 0 to 1 and hue in degrees. The units are those of a number in this image and in the result.
    fn convert_colours(
        &self,
        convert: fn([f64; 3]) -> [f64; 3],
        from: [f64; 3],
        to: [f64; 3],
    ) -> MatrixResult<Self> {
        self.require(self.channels == 3, "conversion of colours")?;
        fn all<T: Value>(
            values: &[T],
            largest: f64,
            convert: impl Fn([f64; 3]) -> [f64; 3],
        ) -> Vec<T> {
            let (pixels, _) = values.as_chunks::<3>();
            let converted = |pixel: &[T; 3]| convert(pixel.map(|value| value.to_f64() / largest));
            pixels
                .iter()
                .flat_map(|pixel| converted(pixel).map(|value| T::from_f64(value * largest)))
                .collect()
        }
        let scaled = |pixel: [f64; 3]| {
            let result = convert([0, 1, 2].map(|i| pixel[i] * from[i]));
            [0, 1, 2].map(|i| result[i] / to[i])
        };
        let values = match &self.values {
            Values::Bytes(values) => {
                // Two degrees make a step, and the last one is the first.
                let mut bytes = all(values, 255.0, scaled);
                if to[0] != 1.0 {
                    bytes
                        .iter_mut()
                        .step_by(3)
                        .filter(|hue| **hue >= 180)
                        .for_each(|hue| *hue -= 180);
                }
                Values::Bytes(bytes)
            }
            Values::Floats(values) => Values::Floats(all(values, 1.0, scaled)),
        };
        Ok(self.with(values))
    }
}

/// Degrees, and the units of the other two, for 255 or 1.
fn hue_scale(depth: Depth) -> [f64; 3] {
    match depth {
        Depth::Byte => [510.0, 1.0, 1.0],
        Depth::Float => [1.0; 3],
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the parts add up to one, so that the mean of bytes is a byte"
)]
fn grey_byte(pixel: &[u8]) -> u8 {
    const HALF: u32 = 1 << 14;
    let sum: u32 = pixel
        .iter()
        .zip(GREY_PARTS)
        .map(|(value, part)| u32::from(*value) * part)
        .sum();
    ((sum + HALF) >> 15) as u8
}

fn grey_float(pixel: &[f32]) -> f32 {
    numbers::single(
        pixel
            .iter()
            .zip(GREY)
            .map(|(value, weight)| f64::from(*value) * weight)
            .sum::<f64>(),
    )
}

/// Hue in degrees, of the largest, its distance to the smallest, and the channels.
fn hue([red, green, blue]: [f64; 3], largest: f64, difference: f64) -> f64 {
    if difference == 0.0 {
        return 0.0;
    }
    let degrees = if largest == red {
        60.0 * (green - blue) / difference
    } else if largest == green {
        120.0 + 60.0 * (blue - red) / difference
    } else {
        240.0 + 60.0 * (red - green) / difference
    };
    if degrees < 0.0 {
        degrees + 360.0
    } else {
        degrees
    }
}

fn extremes([red, green, blue]: [f64; 3]) -> (f64, f64) {
    (red.max(green).max(blue), red.min(green).min(blue))
}

fn hsv_from_rgb(colour: [f64; 3]) -> [f64; 3] {
    let (largest, smallest) = extremes(colour);
    let difference = largest - smallest;
    let saturation = if largest == 0.0 {
        0.0
    } else {
        difference / largest
    };
    [hue(colour, largest, difference), saturation, largest]
}

fn hls_from_rgb(colour: [f64; 3]) -> [f64; 3] {
    let (largest, smallest) = extremes(colour);
    let (sum, difference) = (largest + smallest, largest - smallest);
    let saturation = match difference {
        0.0 => 0.0,
        _ if sum < 1.0 => difference / sum,
        _ => difference / (2.0 - sum),
    };
    [hue(colour, largest, difference), sum / 2.0, saturation]
}

fn rgb_from_hsv([hue, saturation, value]: [f64; 3]) -> [f64; 3] {
    let chroma = value * saturation;
    from_chroma(hue, chroma, value - chroma)
}

fn rgb_from_hls([hue, lightness, saturation]: [f64; 3]) -> [f64; 3] {
    let chroma = (1.0 - (2.0 * lightness - 1.0).abs()) * saturation;
    from_chroma(hue, chroma, lightness - chroma / 2.0)
}

/// The colour of a hue in degrees: the largest channel is `chroma` above the smallest, which is `base`.
fn from_chroma(hue: f64, chroma: f64, base: f64) -> [f64; 3] {
    let sixths = (hue / 60.0).rem_euclid(6.0);
    let second = chroma * (1.0 - (sixths % 2.0 - 1.0).abs());
    let parts = match numbers::truncated_u32(sixths) {
        0 => [chroma, second, 0.0],
        1 => [second, chroma, 0.0],
        2 => [0.0, chroma, second],
        3 => [0.0, second, chroma],
        4 => [second, 0.0, chroma],
        _ => [chroma, 0.0, second],
    };
    parts.map(|part| part + base)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{bytes, floats};
    use super::*;

    #[test]
    fn grey_is_weighted() {
        // Blue, green, red: what cameras deliver for red, blue and green light.
        let image = bytes([3, 1], 3, &[0, 0, 255, 255, 0, 0, 0, 255, 0]);
        assert_eq!(
            image.grey_from_rgb().unwrap(),
            bytes([3, 1], 1, &[29, 76, 150])
        );
        assert_eq!(
            floats([1, 1], 3, &[1.0; 3]).grey_from_rgb().unwrap(),
            floats([1, 1], 1, &[1.0])
        );
        assert!(bytes([1, 1], 2, &[0, 0]).grey_from_rgb().is_err());
    }

    #[test]
    fn hues_of_bytes_are_half_degrees() {
        let image = bytes([4, 1], 3, &[0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 0, 1]);
        assert_eq!(
            image.hsv_from_rgb().unwrap(),
            bytes(
                [4, 1],
                3,
                &[120, 255, 255, 60, 255, 255, 0, 255, 255, 0, 255, 255]
            )
        );
        let image = bytes([1, 1], 3, &[0, 0, 255]);
        assert_eq!(
            image.hls_from_rgb().unwrap(),
            bytes([1, 1], 3, &[120, 128, 255])
        );
    }

    #[test]
    fn hues_of_floats_are_degrees() {
        let image = floats([1, 1], 3, &[0.0, 0.0, 0.5]);
        assert_eq!(
            image.hsv_from_rgb().unwrap(),
            floats([1, 1], 3, &[240.0, 1.0, 0.5])
        );
        assert_eq!(
            image.hls_from_rgb().unwrap(),
            floats([1, 1], 3, &[240.0, 0.25, 1.0])
        );
    }

    #[test]
    fn colours_come_back() {
        let colours = [
            12, 200, 99, 255, 255, 255, 0, 0, 0, 1, 2, 3, 250, 5, 80, 128, 128, 128,
        ];
        let image = bytes([6, 1], 3, &colours).converted(Depth::Float, 1.0 / 255.0);
        for back in [
            image.hsv_from_rgb().unwrap().rgb_from_hsv(),
            image.hls_from_rgb().unwrap().rgb_from_hls(),
        ] {
            assert_eq!(
                back.unwrap().converted(Depth::Byte, 255.0),
                bytes([6, 1], 3, &colours)
            );
        }
        let hsv = bytes([1, 1], 3, &[60, 255, 200]);
        assert_eq!(hsv.rgb_from_hsv().unwrap(), bytes([1, 1], 3, &[0, 200, 0]));
    }
}
