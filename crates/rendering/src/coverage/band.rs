//! Which face is in front in each pixel of some rows.

use std::ops::Range;

use wide::{f32x8, u32x8};

use crate::coverage::face::{Block, Face};

/// Faces that differ by a smaller part of their closeness lie in one plane: the one drawn first is seen. Their closeness is rounded, so
/// that a plain comparison would show parts of both.
pub const COPLANAR: f32 = 1.0 / (1 << 20) as f32;

/// The number where no face is.
pub const NO_FACE: u32 = u32::MAX;

/// Rows of a picture: how close the closest face of each pixel is, and its number.
#[derive(Debug, Default)]
pub struct Band {
    pub rows: Range<usize>,
    width: usize,
    /// Pixels of a row with room for writing eight pixels anywhere.
    stride: usize,
    closeness: Vec<f32>,
    faces: Vec<u32>,
    /// Half of the resolution of the whole picture.
    centre: [f64; 2],
}

/// A face in a pixel in front of the faces of the band. Ordered by pixel, then from back to front.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fragment {
    pub row: u32,
    pub column: u32,
    /// The bits of its closeness, which are ordered like the numbers; more for what is drawn over everything.
    order: u32,
    /// Faces drawn later lie behind at equal closeness, as among the faces of a band.
    face: std::cmp::Reverse<u32>,
}

impl Fragment {
    pub fn face(&self) -> u32 {
        self.face.0
    }
}

impl Band {
    /// Empties it for rows of a picture; nothing is drawn that is not closer than `far`.
    pub fn clear(&mut self, resolution: [u32; 2], rows: Range<usize>, far: f32) {
        self.width = numbers::place(resolution[0]);
        self.stride = self.width + 8;
        self.centre = resolution.map(|side| f64::from(side) / 2.0);
        let pixels = self.stride * rows.len();
        self.rows = rows;
        self.closeness.clear();
        self.closeness.resize(pixels, far);
        self.faces.clear();
        self.faces.resize(pixels, NO_FACE);
    }

    /// The faces of one of its rows.
    pub fn row(&self, row: usize) -> &[u32] {
        &self.faces[row * self.stride..][..self.width]
    }

    /// Draws a face where it is closer than what is there.
    pub fn draw(&mut self, face: &Face, number: u32) {
        face.cover(self.rows.clone(), |block| {
            let (at, closeness) = (self.place(block), face.closeness_of_eight(self.ray(block)));
            let (old_closeness, old_faces) =
                (eight(&mut self.closeness, at), eight(&mut self.faces, at));
            let mask = closeness.simd_gt(in_front_of(*old_closeness)) & block.mask;
            if mask.to_bitmask() != 0 {
                *old_closeness = mask
                    .select(closeness, f32x8::from(*old_closeness))
                    .to_array();
                let mask: u32x8 = bytemuck::cast(mask);
                *old_faces = mask
                    .select(u32x8::splat(number), u32x8::from(*old_faces))
                    .to_array();
            }
        });
    }

    /// Lists the pixels where a face is closer than what is there, or all of its pixels.
    pub fn collect(
        &mut self,
        face: &Face,
        number: u32,
        is_overlay: bool,
        fragments: &mut Vec<Fragment>,
    ) {
        face.cover(self.rows.clone(), |block| {
            let (at, closeness) = (self.place(block), face.closeness_of_eight(self.ray(block)));
            let limit = if is_overlay {
                f32x8::splat(-1.0)
            } else {
                in_front_of(*eight(&mut self.closeness, at))
            };
            let mask = (closeness.simd_gt(limit) & block.mask).to_bitmask();
            for lane in (0..8).filter(|lane| mask >> lane & 1 == 1 && block.x + lane < self.width) {
                let order = closeness.to_array()[lane].to_bits() | u32::from(is_overlay) << 31;
                let (row, column) = (
                    numbers::count_u32(block.y - self.rows.start),
                    numbers::count_u32(block.x + lane),
                );
                fragments.push(Fragment {
                    row,
                    column,
                    order,
                    face: std::cmp::Reverse(number),
                });
            }
        });
    }

    fn place(&self, block: Block) -> usize {
        (block.y - self.rows.start) * self.stride + block.x
    }

    fn ray(&self, block: Block) -> [f64; 2] {
        // From 32 bits, which is one instruction.
        let [x, y] = [numbers::count_u32(block.x), numbers::count_u32(block.y)].map(f64::from);
        [x + 0.5 - self.centre[0], y + 0.5 - self.centre[1]]
    }
}

/// The least closeness that is in front of what is there. Closeness is not negative.
fn in_front_of(closeness: [f32; 8]) -> f32x8 {
    f32x8::from(closeness) * f32x8::splat(1.0 + COPLANAR)
}

fn eight<T>(pixels: &mut [T], at: usize) -> &mut [T; 8] {
    pixels[at..]
        .first_chunk_mut()
        .expect("rows have room for eight pixels more")
}
