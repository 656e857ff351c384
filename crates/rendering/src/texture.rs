//! Images on surfaces.

use std::sync::Arc;

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

    /// The image's colour and opacity at a place.
    pub(crate) fn sample(&self, uv: [f32; 2]) -> [f32; 4] {
        let size = self.image.size;
        if !self.interpolate {
            return self
                .image
                .pixel([0, 1].map(|axis| nearest(uv[axis], size[axis], self.repeat[axis])));
        }
        let [(columns, right), (rows, up)] =
            [0, 1].map(|axis| neighbours(uv[axis], size[axis], self.repeat[axis]));
        let [low, high] = rows.map(|row| {
            let [left, other] = columns.map(|column| self.image.pixel([column, row]));
            mix(left, other, right)
        });
        mix(low, high, up)
    }

    /// Combines a lit colour with the colour and opacity of the image.
    pub(crate) fn combine(&self, lit: [f32; 3], [r, g, b, opacity]: [f32; 4]) -> [f32; 3] {
        let image = [r, g, b];
        [0, 1, 2].map(|i| match self.mode {
            TextureMode::Modulate => lit[i] * image[i],
            TextureMode::Decal => lit[i] + (image[i] - lit[i]) * opacity,
        })
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

    fn pixel(&self, [column, row]: [u32; 2]) -> [f32; 4] {
        let pixel = self.pixels
            [numbers::place(row) * numbers::place(self.size[0]) + numbers::place(column)];
        pixel.map(|part| f32::from(part) / 255.0)
    }
}

/// The two pixels around a coordinate along one axis, and how far it is from the first to the second.
#[expect(
    clippy::cast_possible_truncation,
    reason = "texture coordinates are clamped afterwards; this runs for every pixel"
)]
fn neighbours(coordinate: f32, size: u32, repeat: bool) -> ([u32; 2], f32) {
    let within = if repeat {
        coordinate - coordinate.floor()
    } else {
        coordinate.clamp(0.0, 1.0)
    };
    let at = within * size as f32 - 0.5;
    let first = at.floor();
    let pixel = |at: i64| {
        numbers::low_u32(if repeat {
            at.rem_euclid(i64::from(size))
        } else {
            at.clamp(0, i64::from(size) - 1)
        })
    };
    ([pixel(first as i64), pixel(first as i64 + 1)], at - first)
}

/// The pixel at a coordinate along one axis.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the place is limited to the image; this runs for every pixel"
)]
fn nearest(coordinate: f32, size: u32, repeat: bool) -> u32 {
    let within = if repeat {
        coordinate - coordinate.floor()
    } else {
        coordinate.clamp(0.0, 1.0)
    };
    ((within * size as f32) as u32).min(size - 1)
}

fn mix(a: [f32; 4], b: [f32; 4], part: f32) -> [f32; 4] {
    [0, 1, 2, 3].map(|i| a[i] + (b[i] - a[i]) * part)
}
