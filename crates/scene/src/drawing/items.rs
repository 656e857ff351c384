//! The items of a drawing object: a ring of equally long rows of numbers.

use super::options::{DrawingFlags, DrawingKind};

/// Rows of numbers, of which the oldest can be replaced.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Items {
    layout: Layout,
    numbers: Vec<f64>,
    /// The oldest item, where they are in a ring.
    first: usize,
}

/// Where the parts of an item are: counts of numbers, in this order.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Layout {
    points: usize,
    normal: usize,
    colours: usize,
    size: usize,
    transparency: usize,
}

/// One item.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawingItem<'a> {
    layout: Layout,
    numbers: &'a [f64],
}

impl Layout {
    fn new(kind: DrawingKind, flags: DrawingFlags) -> Self {
        let when = |flag: DrawingFlags, count: usize| if flags.contains(flag) { count } else { 0 };
        Self {
            points: 3 * kind.points(),
            normal: if kind.has_normal(flags) { 3 } else { 0 },
            colours: when(DrawingFlags::ITEM_COLOURS, 3)
                + when(DrawingFlags::VERTEX_COLOURS, 3 * kind.points()),
            size: when(DrawingFlags::ITEM_SIZES, 1),
            transparency: when(DrawingFlags::ITEM_TRANSPARENCY, 1),
        }
    }

    fn len(self) -> usize {
        self.points + self.normal + self.colours + self.size + self.transparency
    }
}

impl Items {
    pub(super) fn new(kind: DrawingKind, flags: DrawingFlags) -> Self {
        Self {
            layout: Layout::new(kind, flags),
            numbers: Vec::new(),
            first: 0,
        }
    }

    pub(super) fn item_len(&self) -> usize {
        self.layout.len()
    }

    pub(super) fn has_normal(&self) -> bool {
        self.layout.normal > 0
    }

    /// The items, the oldest first.
    pub(super) fn iter(&self) -> impl Iterator<Item = DrawingItem<'_>> {
        let (newer, older) = self.numbers.split_at(self.first * self.item_len());
        let rows = older
            .chunks_exact(self.item_len())
            .chain(newer.chunks_exact(self.item_len()));
        rows.map(|numbers| DrawingItem {
            layout: self.layout,
            numbers,
        })
    }

    /// Whether an item has all its points within `tolerance` of those of `item`.
    pub(super) fn has_near(&self, item: &[f64], tolerance: f64) -> bool {
        let points =
            |row: &[f64]| -> Vec<[f64; 3]> { row[..self.layout.points].as_chunks().0.to_vec() };
        let near = |a: [f64; 3], b: [f64; 3]| {
            (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>() < tolerance.powi(2)
        };
        let new = points(item);
        tolerance > 0.0
            && self
                .numbers
                .chunks_exact(self.item_len())
                .any(|row| points(row).into_iter().zip(&new).all(|(a, b)| near(a, *b)))
    }

    /// Adds an item, in place of the oldest where `cyclic` and there are `most`. False when there is no room.
    pub(super) fn push(&mut self, item: &[f64], most: usize, cyclic: bool) -> bool {
        let len = self.item_len();
        if self.numbers.len() < most * len {
            self.numbers.extend_from_slice(item);
            return true;
        }
        if cyclic {
            self.numbers[self.first * len..][..len].copy_from_slice(item);
            self.first = (self.first + 1) % most;
        }
        cyclic
    }

    pub(super) fn clear(&mut self) {
        self.numbers.clear();
        self.first = 0;
    }
}

impl<'a> DrawingItem<'a> {
    /// The numbers after the first `skipped` ones.
    fn part(self, skipped: usize, count: usize) -> &'a [f64] {
        &self.numbers[skipped..skipped + count]
    }

    /// Its points in the frame of the parent, metres.
    pub fn points(self) -> &'a [[f64; 3]] {
        self.part(0, self.layout.points).as_chunks().0
    }

    /// Where a small body faces, if it has a direction.
    pub fn normal(self) -> Option<[f64; 3]> {
        self.part(self.layout.points, self.layout.normal)
            .first_chunk()
            .copied()
    }

    /// Its own colours: none, one, one for each point, or both.
    pub fn colours(self) -> &'a [[f64; 3]] {
        self.part(self.layout.points + self.layout.normal, self.layout.colours)
            .as_chunks()
            .0
    }

    /// Its own size, as that of the drawing object.
    pub fn size(self) -> Option<f64> {
        let before = self.layout.points + self.layout.normal + self.layout.colours;
        self.part(before, self.layout.size).first().copied()
    }

    /// How much light passes through it, 0 to 1, where items have their own.
    pub fn transparency(self) -> Option<f64> {
        let before = self.layout.len() - self.layout.transparency;
        self.part(before, self.layout.transparency).first().copied()
    }
}
