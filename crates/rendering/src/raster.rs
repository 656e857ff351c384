//! Which pixels triangles cover, and which triangle is in front.
//!
//! Corners lie on a grid of 1/256 pixel, so that coverage is exact in integers. A pixel belongs to a triangle when its centre is inside;
//! centres on an edge belong to the triangle on one side only (the top-left rule), so that neighbours leave no gap and share no pixel.
//! Two ways lead to the same pixels: small triangles evaluate edge functions in 32 bits for 8 pixels at a time (J. Pineda, *A parallel
//! algorithm for polygon rasterization*, 1988); for others, the ends of each row are found by exact division in 64 bits.

use wide::{f32x8, i32x8, u32x8};

/// Positions on the picture are multiples of 1 / `UNIT` pixel.
pub const UNIT: i32 = 256;

/// Largest distance of a corner from the centre of the picture, pixels.
pub const GUARD_BAND: f64 = 16384.0;

/// Side of the largest triangles whose edge functions fit into 32 bits, pixels.
const SMALL: i32 = 48;

/// The number where no triangle is.
pub const NO_FACE: u32 = u32::MAX;

/// A linear function on the picture: `a x + b y + c`, from the centre of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Plane {
    pub a: f64,
    pub b: f64,
    pub c: f64,
}

impl Plane {
    pub fn at(&self, ray: [f64; 2]) -> f64 {
        self.a * ray[0] + self.b * ray[1] + self.c
    }

    pub fn is_finite(&self) -> bool {
        [self.a, self.b, self.c].iter().all(|number| number.is_finite())
    }
}

/// A triangle on the picture.
#[derive(Debug, Clone, Copy)]
pub struct Face {
    /// Counter-clockwise, in units of 1 / `UNIT` pixel from the lower left corner of the picture.
    pub corners: [[i32; 2]; 3],
    /// The pixels that it may cover: first and last column, first and last row.
    pub bounds: [[u16; 2]; 2],
    /// How close it is; larger is closer.
    pub closeness: Plane,
    /// The least and the largest closeness of its corners.
    pub range: [f32; 2],
    /// What it belongs to.
    pub owner: u32,
    /// Which triangle of it, or its colour.
    pub detail: u32,
    /// Whether it is seen from behind.
    pub back: bool,
}

/// Rows of a picture: how close the closest face of each pixel is, and its number.
#[derive(Debug, Default)]
pub struct Band {
    pub first_row: usize,
    pub rows: usize,
    width: usize,
    /// Pixels of a row with room for writing 8 pixels anywhere.
    stride: usize,
    closeness: Vec<f32>,
    faces: Vec<u32>,
    /// Half of the resolution of the whole picture.
    centre: [f64; 2],
}

/// Pixels of a row that are written together: 8 from `x`, where `mask` says so.
struct Block {
    x: usize,
    y: usize,
    mask: f32x8,
}

impl Band {
    /// Empties it for rows of a picture; nothing is drawn that is not closer than `far`.
    pub fn clear(&mut self, resolution: [u32; 2], rows: std::ops::Range<usize>, far: f32) {
        self.width = resolution[0] as usize;
        self.stride = self.width + 8;
        (self.first_row, self.rows) = (rows.start, rows.len());
        self.centre = resolution.map(|side| f64::from(side) / 2.0);
        let pixels = self.stride * rows.len();
        self.closeness.clear();
        self.closeness.resize(pixels, far);
        self.faces.clear();
        self.faces.resize(pixels, NO_FACE);
    }

    /// The faces of one row of the band.
    pub fn row(&self, row: usize) -> &[u32] {
        &self.faces[row * self.stride..][..self.width]
    }

    /// Draws a face where it is closer than what is there.
    pub fn draw(&mut self, face: &Face, number: u32) {
        let [columns, rows] = face.bounds.map(|[first, last]| [usize::from(first), usize::from(last)]);
        let rows = rows[0].max(self.first_row)..(rows[1] + 1).min(self.first_row + self.rows);
        if rows.is_empty() {
            return;
        }
        if face.is_small() {
            self.draw_small(face, number, columns, rows)
        } else {
            self.draw_large(face, number, columns, rows)
        }
    }

    fn draw_small(&mut self, face: &Face, number: u32, [first, last]: [usize; 2], rows: std::ops::Range<usize>) {
        let edges = face.edges().map(|edge| SmallEdge::new(&edge, first as i32, rows.start as i32));
        let mut at_row = edges.map(|edge| edge.start);
        for y in rows {
            let mut at = at_row;
            for x in (first..=last).step_by(8) {
                let inside = (at[0] | at[1] | at[2]).simd_gt(i32x8::splat(-1));
                if inside.to_bitmask() != 0 {
                    self.write(face, number, Block { x, y, mask: bytemuck::cast(inside) });
                }
                (0..3).for_each(|i| at[i] += edges[i].block);
            }
            (0..3).for_each(|i| at_row[i] += edges[i].row);
        }
    }

    fn draw_large(&mut self, face: &Face, number: u32, columns: [usize; 2], rows: std::ops::Range<usize>) {
        let edges = face.edges();
        for y in rows {
            let (mut first, mut last) = (columns[0] as i64, columns[1] as i64);
            edges.iter().for_each(|edge| edge.clip_row(y as i64, &mut first, &mut last));
            for x in (first..=last).step_by(8) {
                let mask = LANES.simd_le(f32x8::splat((last - x) as f32));
                self.write(face, number, Block { x: x as usize, y, mask });
            }
        }
    }

    fn write(&mut self, face: &Face, number: u32, Block { x, y, mask }: Block) {
        let ray = [x as f64 + 0.5 - self.centre[0], y as f64 + 0.5 - self.centre[1]];
        let start = f32x8::splat(face.closeness.at(ray) as f32);
        let closeness = start + f32x8::splat(face.closeness.a as f32) * LANES;
        let closeness = closeness.fast_max(f32x8::splat(face.range[0])).fast_min(f32x8::splat(face.range[1]));

        let at = (y - self.first_row) * self.stride + x;
        let (old_closeness, old_faces) = (eight(&mut self.closeness, at), eight(&mut self.faces, at));
        let mask = closeness.simd_gt(f32x8::from(*old_closeness)) & mask;
        if mask.to_bitmask() != 0 {
            *old_closeness = mask.select(closeness, f32x8::from(*old_closeness)).to_array();
            let mask: u32x8 = bytemuck::cast(mask);
            *old_faces = mask.select(u32x8::splat(number), u32x8::from(*old_faces)).to_array();
        }
    }
}

const LANES: f32x8 = f32x8::new([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);

fn eight<T>(pixels: &mut [T], at: usize) -> &mut [T; 8] {
    pixels[at..].first_chunk_mut().expect("rows have room for 8 pixels more")
}

impl Face {
    /// Whether 32 bits are enough for its edge functions.
    fn is_small(&self) -> bool {
        let extent = |axis: usize| {
            let [a, b, c] = self.corners.map(|corner| corner[axis]);
            a.max(b).max(c) - a.min(b).min(c)
        };
        extent(0) <= SMALL * UNIT && extent(1) <= SMALL * UNIT
    }

    fn edges(&self) -> [Edge; 3] {
        let [a, b, c] = self.corners;
        [Edge::new(a, b), Edge::new(b, c), Edge::new(c, a)]
    }
}

/// An edge as a linear function of the pixel `[i, j]`: not negative where the pixel's centre is on the inner side.
#[derive(Debug, Clone, Copy)]
struct Edge {
    /// Change from one column to the next, and from one row to the next.
    step: [i64; 2],
    /// At pixel `[0, 0]`.
    start: i64,
}

impl Edge {
    fn new(from: [i32; 2], to: [i32; 2]) -> Self {
        let [dx, dy] = [0, 1].map(|axis| i64::from(to[axis]) - i64::from(from[axis]));
        let [x, y] = from.map(|at| i64::from(UNIT / 2 - at));
        // Centres on the edge belong to the triangle to the right of a left edge, or below a top edge.
        let belongs = dy < 0 || (dy == 0 && dx < 0);
        let step = [-dy, dx].map(|step| step * i64::from(UNIT));
        Self { step, start: dx * y - dy * x - i64::from(!belongs) }
    }

    fn at(&self, x: i64, y: i64) -> i64 {
        self.start + self.step[0] * x + self.step[1] * y
    }

    /// Cuts a row of pixels to those on the inner side.
    fn clip_row(&self, y: i64, first: &mut i64, last: &mut i64) {
        let (value, step) = (self.at(0, y), self.step[0]);
        match step.signum() {
            1 => *first = (*first).max(-value.div_euclid(step)),
            -1 => *last = (*last).min(value.div_euclid(-step)),
            _ if value < 0 => *last = *first - 1,
            _ => (),
        }
    }
}

/// An edge of a small triangle, for 8 pixels at a time.
#[derive(Clone, Copy)]
struct SmallEdge {
    /// The first 8 pixels of the first row.
    start: i32x8,
    /// Changes to the next 8 pixels, and to the next row.
    block: i32x8,
    row: i32x8,
}

impl SmallEdge {
    fn new(edge: &Edge, x: i32, y: i32) -> Self {
        // Within a small triangle's bounds nothing exceeds 2^30.
        let [column, row] = edge.step.map(|step| step as i32);
        let lanes = i32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
        let start = i32x8::splat(edge.at(i64::from(x), i64::from(y)) as i32) + lanes * i32x8::splat(column);
        Self { start, block: i32x8::splat(column * 8), row: i32x8::splat(row) }
    }
}
