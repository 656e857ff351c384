//! Which pixels triangles cover, and which triangle is in front.
//!
//! Corners lie on a grid of 1/256 pixel, so that coverage is exact in integers. A pixel belongs to a triangle when its centre is inside;
//! centres on an edge belong to the triangle on one side only (the top-left rule), so that neighbours leave no gap and share no pixel.
//! Two ways lead to the same pixels: small triangles evaluate edge functions in 32 bits for 8 pixels at a time (J. Pineda, *A parallel
//! algorithm for polygon rasterization*, 1988); for others, the ends of each row are found by exact division in 64 bits.

use std::ops::{Range, RangeInclusive};

use wide::{f32x4, f32x8, i32x4, i32x8};

/// Positions on the picture are multiples of 1 / `UNIT` pixel.
pub const UNIT: i32 = 1 << UNIT_BITS;
pub const UNIT_BITS: u32 = 8;

/// Largest distance of a corner from the centre of the picture, pixels.
pub const GUARD_BAND: f64 = 16384.0;

/// Side of the largest triangles whose edge functions fit into 32 bits.
pub const SMALL: i32 = 48 * UNIT;

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
        [self.a, self.b, self.c]
            .iter()
            .all(|number| number.is_finite())
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
    /// Index of its owner.
    pub owner: u32,
    /// Which triangle of it, or its colour.
    pub detail: u32,
    /// Whether it is seen from behind.
    pub back: bool,
    /// Whether 32 bits are enough for its edge functions: no side exceeds [`SMALL`].
    pub is_small: bool,
    /// Whether it is so thin, or so small, that it is shaded like the middle of its triangle.
    pub is_uniform: bool,
}

/// What is done with the pixels of a face, from the bottom up, in each row from the left to the right.
pub trait Cover {
    /// All pixels of a row from the first to the last column.
    fn span(&mut self, y: usize, columns: RangeInclusive<usize>);
    /// Those of the eight pixels from column `x` on where `mask` says so: some are covered.
    fn eight(&mut self, x: usize, y: usize, mask: f32x8);
    /// The same of four pixels.
    fn four(&mut self, x: usize, y: usize, mask: f32x4);
}

/// The numbers of eight pixels.
pub const LANES: f32x8 = f32x8::new([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);

impl Face {
    /// How close it is at a ray and at the seven pixels to the right.
    pub fn closeness_of_eight(&self, ray: [f64; 2]) -> f32x8 {
        let start = f32x8::splat(numbers::single(self.closeness.at(ray)));
        let closeness = start + f32x8::splat(numbers::single(self.closeness.a)) * LANES;
        closeness
            .fast_max(f32x8::splat(self.range[0]))
            .fast_min(f32x8::splat(self.range[1]))
    }

    /// The same of four pixels.
    pub fn closeness_of_four(&self, ray: [f64; 2]) -> f32x4 {
        let start = f32x4::splat(numbers::single(self.closeness.at(ray)));
        let lanes = f32x4::new([0.0, 1.0, 2.0, 3.0]);
        let closeness = start + f32x4::splat(numbers::single(self.closeness.a)) * lanes;
        closeness
            .fast_max(f32x4::splat(self.range[0]))
            .fast_min(f32x4::splat(self.range[1]))
    }

    /// Passes on the pixels that the face covers in some rows.
    #[inline(always)]
    pub fn cover(&self, rows: Range<usize>, cover: &mut impl Cover) {
        let [columns, own_rows] = self
            .bounds
            .map(|[first, last]| [usize::from(first), usize::from(last)]);
        let rows = own_rows[0].max(rows.start)..(own_rows[1] + 1).min(rows.end);
        if rows.is_empty() {
            return;
        }
        match self.is_small {
            true if columns[1] - columns[0] < 4 => self.cover_narrow(columns[0], rows, cover),
            true => self.cover_small(columns, rows, cover),
            false => self.cover_large(columns, rows, cover),
        }
    }

    /// Up to four columns: most triangles of a fine mesh are so narrow.
    #[inline(always)]
    fn cover_narrow(&self, x: usize, rows: Range<usize>, cover: &mut impl Cover) {
        let edges = self.small_edges(x, rows.start);
        let [mut a, mut b, mut c] = edges.map(|edge| {
            let column = |at: i32| edge.start + at * edge.column;
            i32x4::new([edge.start, column(1), column(2), column(3)])
        });
        let steps = edges.map(|edge| i32x4::splat(edge.row));
        for y in rows {
            let inside = (a | b | c).simd_gt(i32x4::splat(-1));
            if inside.to_bitmask() != 0 {
                cover.four(x, y, bytemuck::cast(inside));
            }
            (a, b, c) = (a + steps[0], b + steps[1], c + steps[2]);
        }
    }

    #[inline(always)]
    fn cover_small(&self, [first, last]: [usize; 2], rows: Range<usize>, cover: &mut impl Cover) {
        let edges = self.small_edges(first, rows.start);
        let lanes = i32x8::new([0, 1, 2, 3, 4, 5, 6, 7]);
        let mut at_row = edges.map(|edge| lanes * edge.column + edge.start);
        for y in rows {
            let mut at = at_row;
            for x in (first..=last).step_by(8) {
                let inside = (at[0] | at[1] | at[2]).simd_gt(i32x8::splat(-1));
                if inside.to_bitmask() != 0 {
                    cover.eight(x, y, bytemuck::cast(inside));
                }
                (0..3).for_each(|i| at[i] += edges[i].column * 8);
            }
            (0..3).for_each(|i| at_row[i] += edges[i].row);
        }
    }

    #[inline(always)]
    fn cover_large(&self, columns: [usize; 2], rows: Range<usize>, cover: &mut impl Cover) {
        let edges = self.edges();
        for y in rows {
            let (mut first, mut last) = (numbers::count(columns[0]), numbers::count(columns[1]));
            edges
                .iter()
                .for_each(|edge| edge.clip_row(numbers::count(y), &mut first, &mut last));
            if first <= last {
                cover.span(y, numbers::place_of(first)..=numbers::place_of(last));
            }
        }
    }

    /// The edges from a pixel on.
    #[inline(always)]
    fn small_edges(&self, column: usize, row: usize) -> [SmallEdge; 3] {
        let [a, b, c] = self.corners;
        let pixel = [column, row].map(|at| numbers::count_i32(at) * UNIT + UNIT / 2);
        [
            SmallEdge::new(a, b, pixel),
            SmallEdge::new(b, c, pixel),
            SmallEdge::new(c, a, pixel),
        ]
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
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let exclusive = i64::from(!owns_border(dx, dy));
        let (dx, dy) = (i64::from(dx), i64::from(dy));
        let [x, y] = from.map(|at| i64::from(UNIT / 2 - at));
        let step = [-dy, dx].map(|step| step * i64::from(UNIT));
        Self {
            step,
            start: dx * y - dy * x - exclusive,
        }
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

/// An edge of a small triangle, from a pixel on.
#[derive(Clone, Copy)]
struct SmallEdge {
    start: i32,
    /// Changes to the next column, and to the next row.
    column: i32,
    row: i32,
}

impl SmallEdge {
    /// Within the bounds of a small triangle nothing exceeds 2^30.
    fn new(from: [i32; 2], to: [i32; 2], pixel: [i32; 2]) -> Self {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let start =
            dx * (pixel[1] - from[1]) - dy * (pixel[0] - from[0]) - i32::from(!owns_border(dx, dy));
        Self {
            start,
            column: -dy * UNIT,
            row: dx * UNIT,
        }
    }
}

/// Whether centres on an edge belong to the triangle: that to the right of a left edge, or below a top edge.
fn owns_border(dx: i32, dy: i32) -> bool {
    dy < 0 || (dy == 0 && dx < 0)
}
