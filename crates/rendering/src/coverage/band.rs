//! Which face is in front in each pixel of some rows.

use std::ops::{Range, RangeInclusive};

use wide::{f32x4, f32x8, u32x4, u32x8};

use crate::coverage::face::{Cover, Face, LANES};

/// Faces that differ by a smaller part of their closeness lie in one plane: the one drawn first is seen. Their closeness is rounded, so
/// that a plain comparison would show parts of both.
pub const COPLANAR: f32 = 1.0 / (1 << 20) as f32;

/// What is more than this many times as close lies in front. Closeness is not negative.
const IN_FRONT: f32 = 1.0 + COPLANAR;

const HAS_ROOM: &str = "rows have room for eight pixels more";

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
        let rows = self.rows.clone();
        face.cover(
            rows,
            &mut Drawing {
                band: self,
                face,
                number,
            },
        );
    }

    /// Lists the pixels where a face is closer than what is there, or all of its pixels.
    pub fn collect(
        &mut self,
        face: &Face,
        number: u32,
        is_overlay: bool,
        fragments: &mut Vec<Fragment>,
    ) {
        let rows = self.rows.clone();
        let mut collecting = Collecting {
            band: self,
            face,
            number,
            is_overlay,
            fragments,
        };
        face.cover(rows, &mut collecting);
    }

    fn place(&self, x: usize, y: usize) -> usize {
        (y - self.rows.start) * self.stride + x
    }

    fn ray(&self, x: usize, y: usize) -> [f64; 2] {
        // From 32 bits, which is one instruction.
        let [x, y] = [numbers::count_u32(x), numbers::count_u32(y)].map(f64::from);
        [x + 0.5 - self.centre[0], y + 0.5 - self.centre[1]]
    }
}

/// A face that is drawn where it is closer than what is there.
struct Drawing<'a> {
    band: &'a mut Band,
    face: &'a Face,
    number: u32,
}

impl Cover for Drawing<'_> {
    #[inline(always)]
    fn span(&mut self, y: usize, columns: RangeInclusive<usize>) {
        let (first, count) = (*columns.start(), columns.end() + 1 - columns.start());
        let (at, rest) = (self.band.place(first, y), count % 8);
        let length = count - rest;
        let mut ray = self.band.ray(first, y);
        let (closeness, _) = self.band.closeness[at..][..length].as_chunks_mut();
        let (faces, _) = self.band.faces[at..][..length].as_chunks_mut();
        for (closeness, faces) in closeness.iter_mut().zip(faces) {
            let closer = self.face.closeness_of_eight(ray);
            if is_in_front(closer, closeness).all() {
                *closeness = closer.to_array();
                *faces = [self.number; 8];
            } else {
                draw_eight(closeness, faces, closer, None, self.number);
            }
            ray[0] += 8.0;
        }
        if rest > 0 {
            let mask = LANES.simd_lt(f32x8::splat(rest as f32));
            self.eight(first + length, y, mask);
        }
    }

    #[inline(always)]
    fn eight(&mut self, x: usize, y: usize, mask: f32x8) {
        let at = self.band.place(x, y);
        let closeness = self.face.closeness_of_eight(self.band.ray(x, y));
        draw_eight(
            chunk_mut(&mut self.band.closeness, at),
            chunk_mut(&mut self.band.faces, at),
            closeness,
            Some(mask),
            self.number,
        );
    }

    #[inline(always)]
    fn four(&mut self, x: usize, y: usize, mask: f32x4) {
        let at = self.band.place(x, y);
        let closeness = self.face.closeness_of_four(self.band.ray(x, y));
        let old_closeness = chunk_mut(&mut self.band.closeness, at);
        let old = f32x4::from(*old_closeness);
        let mask = closeness.simd_gt(old * IN_FRONT) & mask;
        if mask.to_bitmask() != 0 {
            let faces = chunk_mut(&mut self.band.faces, at);
            *old_closeness = mask.select(closeness, old).to_array();
            let mask: u32x4 = bytemuck::cast(mask);
            *faces = mask
                .select(u32x4::splat(self.number), u32x4::from(*faces))
                .to_array();
        }
    }
}

#[inline(always)]
fn is_in_front(closeness: f32x8, old: &[f32; 8]) -> f32x8 {
    closeness.simd_gt(f32x8::from(*old) * IN_FRONT)
}

/// Draws a face in those of eight pixels where the mask says so, if there is one, and where it is closer.
#[inline(always)]
fn draw_eight(
    old_closeness: &mut [f32; 8],
    faces: &mut [u32; 8],
    closeness: f32x8,
    mask: Option<f32x8>,
    number: u32,
) {
    let old = f32x8::from(*old_closeness);
    let closer = is_in_front(closeness, old_closeness);
    let mask = mask.map_or(closer, |mask| closer & mask);
    if mask.to_bitmask() == 0 {
        return;
    }
    *old_closeness = mask.select(closeness, old).to_array();
    let mask: u32x8 = bytemuck::cast(mask);
    *faces = mask
        .select(u32x8::splat(number), u32x8::from(*faces))
        .to_array();
}

/// A face whose pixels are listed where it is closer than what is there, or all of them.
struct Collecting<'a> {
    band: &'a Band,
    face: &'a Face,
    number: u32,
    is_overlay: bool,
    fragments: &'a mut Vec<Fragment>,
}

impl Cover for Collecting<'_> {
    fn span(&mut self, y: usize, columns: RangeInclusive<usize>) {
        let last = *columns.end();
        for x in columns.step_by(8) {
            let mask = LANES.simd_le(f32x8::splat((last - x) as f32));
            self.eight(x, y, mask);
        }
    }

    fn eight(&mut self, x: usize, y: usize, mask: f32x8) {
        let band = self.band;
        let closeness = self.face.closeness_of_eight(band.ray(x, y));
        let limit = match self.is_overlay {
            true => f32x8::splat(-1.0),
            false => f32x8::from(*chunk(&band.closeness, band.place(x, y))) * IN_FRONT,
        };
        let mask = (closeness.simd_gt(limit) & mask).to_bitmask();
        for lane in (0..8).filter(|lane| mask >> lane & 1 == 1 && x + lane < band.width) {
            let order = closeness.to_array()[lane].to_bits() | u32::from(self.is_overlay) << 31;
            self.fragments.push(Fragment {
                row: numbers::count_u32(y - band.rows.start),
                column: numbers::count_u32(x + lane),
                order,
                face: std::cmp::Reverse(self.number),
            });
        }
    }

    fn four(&mut self, x: usize, y: usize, mask: f32x4) {
        self.eight(x, y, bytemuck::cast([mask, f32x4::ZERO]));
    }
}

/// The pixels from a place on.
#[inline(always)]
fn chunk<T, const N: usize>(pixels: &[T], at: usize) -> &[T; N] {
    pixels[at..].first_chunk().expect(HAS_ROOM)
}

#[inline(always)]
fn chunk_mut<T, const N: usize>(pixels: &mut [T], at: usize) -> &mut [T; N] {
    pixels[at..].first_chunk_mut().expect(HAS_ROOM)
}
