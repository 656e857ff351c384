//! Images on surfaces.

use std::sync::Arc;

use wide::{f32x8, i32x8};

use crate::three::three;

/// An image on a mesh, at the mesh's texture coordinates.
#[derive(Debug, Clone)]
pub struct Texture {
    /// The pixels.
    pub image: Arc<Image>,
    /// Whether the image repeats beyond 0 and 1 along u and v; otherwise its border pixels continue.
    pub repeat: [bool; 2],
    /// Whether colours between the pixels of the image are interpolated.
    pub interpolate: bool,
    /// How the image is combined with the lit surface.
    pub mode: TextureMode,
}

/// How an image is combined with the lit surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextureMode {
    /// The image multiplies the surface's colour.
    Modulate,
    /// The image covers the surface, where the image is opaque, and is not lit.
    Decal,
}

/// Pixels with an opacity. The first row is the bottom one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    size: [u32; 2],
    pixels: Vec<[u8; 4]>,
}

impl Texture {
    /// An image that repeats, interpolated, multiplied with the colour below it.
    pub fn new(image: Arc<Image>) -> Self {
        Self {
            image,
            repeat: [true; 2],
            interpolate: true,
            mode: TextureMode::Modulate,
        }
    }

    /// Combines lit colours with the colours and opacities of the image at eight places.
    #[inline]
    pub(crate) fn cover(&self, lit: [f32x8; 3], uv: [f32x8; 2]) -> [f32x8; 3] {
        let samples = self.sample(uv);
        match self.mode {
            TextureMode::Modulate => three(|i| lit[i] * samples.channel(i)),
            TextureMode::Decal => {
                let opacity = samples.channel(3);
                three(|i| lit[i] + (samples.channel(i) - lit[i]) * opacity)
            }
        }
    }

    #[inline]
    fn sample(&self, [u, v]: [f32x8; 2]) -> Samples {
        let ([width, height], image) = (self.image.size, &self.image);
        if !self.interpolate {
            let column = nearest(u, width, self.repeat[0]);
            return Samples::Nearest(image.pixels(column, nearest(v, height, self.repeat[1])));
        }
        let ([left, right], to_right) = neighbours(u, width, self.repeat[0]);
        let ([low, high], up) = neighbours(v, height, self.repeat[1]);
        Samples::Interpolated {
            low: [image.pixels(left, low), image.pixels(right, low)],
            high: [image.pixels(left, high), image.pixels(right, high)],
            to_right,
            up,
        }
    }
}

/// Pixels of an image at eight places: red in the lowest byte of each number, then green, blue and opacity.
enum Samples {
    Nearest(i32x8),
    /// Those around the places, and how far these are from the left to the right ones, and from the low to the high ones.
    Interpolated {
        low: [i32x8; 2],
        high: [i32x8; 2],
        to_right: f32x8,
        up: f32x8,
    },
}

impl Samples {
    /// Red, green, blue or opacity, 0 to 1.
    #[inline]
    fn channel(&self, number: usize) -> f32x8 {
        let shift = 8 * numbers::count_i32(number);
        let part = |pixels: i32x8| ((pixels >> shift) & i32x8::splat(0xff)).round_float() / 255.0;
        match self {
            Self::Nearest(pixels) => part(*pixels),
            Self::Interpolated {
                low: [a, b],
                high: [c, d],
                to_right,
                up,
            } => {
                let low = mix(part(*a), part(*b), *to_right);
                mix(low, mix(part(*c), part(*d), *to_right), *up)
            }
        }
    }
}

impl Image {
    /// From three or four bytes per pixel (the fourth is the opacity), row by row from the bottom. None where there are no pixels, or
    /// not as many as the size says.
    pub fn new(size: [u32; 2], has_alpha: bool, bytes: &[u8]) -> Option<Self> {
        let width = if has_alpha { 4 } else { 3 };
        let count = numbers::place(size[0]).checked_mul(numbers::place(size[1]))?;
        if count == 0 || count.checked_mul(width)? != bytes.len() {
            return None;
        }
        let pixels = bytes
            .chunks_exact(width)
            .map(|p| [p[0], p[1], p[2], p.get(3).copied().unwrap_or(u8::MAX)]);
        Some(Self {
            size,
            pixels: pixels.collect(),
        })
    }

    /// Width and height, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Eight of its pixels.
    #[inline]
    fn pixels(&self, columns: [u32; 8], rows: [u32; 8]) -> i32x8 {
        let width = numbers::place(self.size[0]);
        let mut pixels = [0; 8];
        for lane in 0..8 {
            let at = numbers::place(rows[lane]) * width + numbers::place(columns[lane]);
            pixels[lane] = i32::from_le_bytes(self.pixels[at]);
        }
        i32x8::new(pixels)
    }
}

/// The coordinates within the image along one axis, 0 to 1.
#[inline]
fn within(coordinates: f32x8, repeat: bool) -> f32x8 {
    if repeat {
        coordinates - floor(coordinates)
    } else {
        let from_zero = coordinates
            .simd_lt(f32x8::ZERO)
            .select(f32x8::ZERO, coordinates);
        from_zero.simd_gt(f32x8::ONE).select(f32x8::ONE, from_zero)
    }
}

/// The two pixels around eight coordinates along one axis, and how far they are from the first to the second.
#[inline]
fn neighbours(coordinates: f32x8, size: u32, repeat: bool) -> ([[u32; 8]; 2], f32x8) {
    let at = within(coordinates, repeat) * size as f32 - 0.5;
    let first = floor(at);
    let (lowest, highest) = (i32x8::ZERO, i32x8::splat(size.cast_signed() - 1));
    let all = i32x8::splat(if repeat { size.cast_signed() } else { 0 });
    let pixel = |at: i32x8| {
        // Not more than a pixel outside, where the image repeats.
        let turned = at + (at.simd_lt(lowest) & all) - (at.simd_gt(highest) & all);
        bytemuck::cast(turned.max(lowest).min(highest))
    };
    let whole = first.trunc_int();
    ([pixel(whole), pixel(whole + i32x8::ONE)], at - first)
}

/// The pixels at eight coordinates along one axis.
#[inline]
fn nearest(coordinates: f32x8, size: u32, repeat: bool) -> [u32; 8] {
    let at = (within(coordinates, repeat) * size as f32).trunc_int();
    let last = i32x8::splat(size.cast_signed() - 1);
    bytemuck::cast(at.max(i32x8::ZERO).min(last))
}

/// The largest whole numbers that are not larger. Without SSE 4.1 that of `wide` calls a function for each number.
#[inline]
fn floor(numbers: f32x8) -> f32x8 {
    let whole = numbers.trunc_int().round_float();
    let floor = whole - (whole.simd_gt(numbers) & f32x8::ONE);
    // From there on all numbers are whole.
    let is_fractional = numbers.abs().simd_lt(f32x8::splat((1 << 23) as f32));
    is_fractional.select(floor, numbers)
}

#[inline]
fn mix(a: f32x8, b: f32x8, part: f32x8) -> f32x8 {
    a + (b - a) * part
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On and between pixels of an image of five columns, at its borders, far outside.
    const COORDINATES: [f32; 16] = [
        0.0, 0.05, 0.1, 0.5, 0.7, 0.99, 1.0, 1.3, -0.0, -0.05, -1e-9, -1.0, -7.1, 12.6, 3e7, -4e9,
    ];

    /// Red is the column.
    fn texture(repeat: bool, interpolate: bool) -> Texture {
        let bytes: Vec<u8> = (0..20).flat_map(|at| [at % 5, 3, 0]).collect();
        Texture {
            repeat: [repeat; 2],
            interpolate,
            ..Texture::new(Arc::new(Image::new([5, 4], false, &bytes).unwrap()))
        }
    }

    /// What is seen at a coordinate, one by one.
    fn expected(coordinate: f32, repeat: bool, interpolate: bool) -> f32 {
        let within = match repeat {
            true => coordinate - coordinate.floor(),
            false => coordinate.clamp(0.0, 1.0),
        };
        if !interpolate {
            return (within * 5.0).floor().min(4.0) / 255.0;
        }
        let at = within * 5.0 - 0.5;
        let pixel = |at: i32| match repeat {
            true => at.rem_euclid(5) as f32 / 255.0,
            false => at.clamp(0, 4) as f32 / 255.0,
        };
        let (left, right) = (pixel(at.floor() as i32), pixel(at.floor() as i32 + 1));
        left + (right - left) * (at - at.floor())
    }

    #[test]
    fn images_are_sampled_at_eight_places_as_at_one() {
        for (repeat, interpolate) in [(true, true), (true, false), (false, true), (false, false)] {
            let texture = texture(repeat, interpolate);
            for eight in COORDINATES.as_chunks::<8>().0 {
                let samples = texture.sample([f32x8::new(*eight), f32x8::splat(0.4)]);
                let expected = eight.map(|u| expected(u, repeat, interpolate));
                assert_eq!(
                    samples.channel(0).to_array(),
                    expected,
                    "{repeat} {interpolate}"
                );
                assert_eq!(samples.channel(1).to_array(), [3.0 / 255.0; 8]);
            }
        }
    }
}
