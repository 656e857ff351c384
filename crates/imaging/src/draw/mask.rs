//! How much of each pixel a thick or antialiased figure covers. Overlapping parts of it count once.

use super::{LineType, Pen, PixelPosition};
use crate::matrix::Matrix;

/// Coverage, 0 to 1, of the pixels of a part of an image.
pub(super) struct Mask {
    corner: [i64; 2],
    width: usize,
    height: usize,
    coverage: Vec<f32>,
}

impl Mask {
    /// Nothing is covered yet. None when the region between two places is outside of the image.
    pub(super) fn new(image: &Matrix, low: PixelPosition, high: PixelPosition) -> Option<Self> {
        let size = image.size();
        let first = [0, 1].map(|i| (low[i].floor() - 1.0).max(0.0));
        let last = [0, 1].map(|i| (high[i].ceil() + 1.0).min(numbers::real(size[i]) - 1.0));
        if !(first[0] <= last[0] && first[1] <= last[1]) {
            return None;
        }
        let [width, height] = [0, 1].map(|i| numbers::index(last[i] - first[i]) + 1);
        Some(Self {
            corner: first.map(numbers::truncated),
            width,
            height,
            coverage: vec![0.0; width * height],
        })
    }

    /// The region around places, with a margin.
    pub(super) fn around(image: &Matrix, places: &[PixelPosition], margin: f64) -> Option<Self> {
        let low = [0, 1].map(|i| {
            places
                .iter()
                .map(|place| place[i])
                .fold(f64::INFINITY, f64::min)
                - margin
        });
        let high = [0, 1].map(|i| {
            places
                .iter()
                .map(|place| place[i])
                .fold(f64::NEG_INFINITY, f64::max)
                + margin
        });
        Self::new(image, low, high)
    }

    /// Covers what is at most `radius` from the line between two places.
    pub(super) fn add_line(
        &mut self,
        from: PixelPosition,
        to: PixelPosition,
        radius: f64,
        line_type: LineType,
    ) {
        let reach = radius + 1.0;
        let direction = [to[0] - from[0], to[1] - from[1]];
        let squared = direction[0] * direction[0] + direction[1] * direction[1];
        let first = (from[1].min(to[1]) - reach - numbers::real_of(self.corner[1])).max(0.0);
        let last = (from[1].max(to[1]) + reach - numbers::real_of(self.corner[1]))
            .min(numbers::real(self.height) - 1.0);
        for row in numbers::index(first)..=numbers::index(last.max(-1.0)) {
            let y = numbers::real_of(numbers::count(row) + self.corner[1]);
            let [left, right] = columns_near(from, direction, y, reach);
            self.add_row(row, left, right, |x| {
                let [dx, dy] = [x - from[0], y - from[1]];
                let part = if squared > 0.0 {
                    ((dx * direction[0] + dy * direction[1]) / squared).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let distance = libm::hypot(dx - part * direction[0], dy - part * direction[1]);
                coverage(radius - distance, line_type)
            });
        }
    }

    /// Covers what is at most `radius` from a ring, or within it for a disc.
    pub(super) fn add_circle(
        &mut self,
        centre: PixelPosition,
        ring: f64,
        radius: f64,
        is_disc: bool,
        line_type: LineType,
    ) {
        for row in 0..self.height {
            let y = numbers::real_of(numbers::count(row) + self.corner[1]);
            self.add_row(row, f64::NEG_INFINITY, f64::INFINITY, |x| {
                let outside = libm::hypot(x - centre[0], y - centre[1]) - ring;
                coverage(
                    radius - if is_disc { outside } else { outside.abs() },
                    line_type,
                )
            });
        }
    }

    /// Covers a pixel of the image.
    pub(super) fn add_pixel(&mut self, [x, y]: [i64; 2], coverage: f64) {
        let [column, row] = [x - self.corner[0], y - self.corner[1]];
        if column >= 0
            && row >= 0
            && column < numbers::count(self.width)
            && row < numbers::count(self.height)
        {
            let covered =
                &mut self.coverage[numbers::place_of(row) * self.width + numbers::place_of(column)];
            *covered = covered.max(numbers::single(coverage));
        }
    }

    fn add_row(&mut self, row: usize, left: f64, right: f64, coverage: impl Fn(f64) -> f64) {
        let first = (left - numbers::real_of(self.corner[0])).floor().max(0.0);
        let last = (right - numbers::real_of(self.corner[0]))
            .ceil()
            .min(numbers::real(self.width) - 1.0);
        if first.is_nan() || last.is_nan() || first > last {
            return;
        }
        let pixels = &mut self.coverage[row * self.width..][..self.width];
        for (column, covered) in pixels
            .iter_mut()
            .enumerate()
            .take(numbers::index(last) + 1)
            .skip(numbers::index(first))
        {
            *covered = covered.max(numbers::single(coverage(numbers::real_of(
                numbers::count(column) + self.corner[0],
            ))));
        }
    }

    /// Paints what is covered.
    pub(super) fn paint(&self, image: &mut Matrix, pen: &Pen) {
        for (at, coverage) in self
            .coverage
            .iter()
            .enumerate()
            .filter(|(_, coverage)| **coverage > 0.0)
        {
            let place = [
                self.corner[0] + numbers::count(at % self.width),
                self.corner[1] + numbers::count(at / self.width),
            ];
            image.paint(place, pen, f64::from(*coverage));
        }
    }

    pub(super) fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    pub(super) fn coverage_mut(&mut self) -> &mut [f32] {
        &mut self.coverage
    }
}

/// How much of a pixel is inside, whose centre is `depth` below the surface.
pub(super) fn coverage(depth: f64, line_type: LineType) -> f64 {
    match line_type {
        LineType::Antialiased => (depth + 0.5).clamp(0.0, 1.0),
        _ if depth >= 0.0 => 1.0,
        _ => 0.0,
    }
}

/// The columns of a row that may be nearer to a line than `reach`.
fn columns_near(from: PixelPosition, direction: PixelPosition, y: f64, reach: f64) -> [f64; 2] {
    let parts = match direction[1] {
        0.0 => [0.0, 1.0],
        dy => [y - reach, y + reach].map(|y| ((y - from[1]) / dy).clamp(0.0, 1.0)),
    };
    let [a, b] = parts.map(|part| from[0] + part * direction[0]);
    [a.min(b) - reach, a.max(b) + reach]
}
