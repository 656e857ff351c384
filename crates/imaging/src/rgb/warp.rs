//! Mirrored, shifted, scaled and turned images. Pixels are not mixed: each takes the one it lies on.

use super::{BLACK, RgbImage};

impl RgbImage {
    /// Mirrors columns.
    pub fn flip_horizontally(&mut self) {
        self.pixels
            .chunks_exact_mut(self.width.max(1))
            .for_each(<[_]>::reverse);
    }

    /// Mirrors rows.
    pub fn flip_vertically(&mut self) {
        self.pixels.reverse();
        self.flip_horizontally();
    }

    /// Moves the content to higher columns and rows, by parts of the sides; what it leaves is black unless it wraps around.
    pub fn shift(&mut self, parts: [f64; 2], wrap: bool) {
        let [x, y] = [offset(parts[0], self.width), offset(parts[1], self.height)];
        let source = |at: usize, offset: i64, size: usize| {
            let from = numbers::count(at) - offset;
            let from = if wrap {
                from.rem_euclid(numbers::count(size))
            } else {
                from
            };
            usize::try_from(from).ok()
        };
        *self = self.map_places(|column, row| {
            let from = source(column, x, self.width).zip(source(row, y, self.height));
            from.and_then(|(column, row)| self.get(column, row))
                .unwrap_or(BLACK)
        });
    }

    /// Magnifies the content about the centre.
    pub fn resize(&mut self, scale: [f64; 2]) {
        self.sample(|x, y| [x / scale[0], y / scale[1]]);
    }

    /// Turns the content about the centre, counter-clockwise with row 0 at the bottom; the angle is in radians.
    pub fn rotate(&mut self, angle: f64) {
        let (sin, cos) = libm::sincos(angle);
        self.sample(|x, y| [cos * x + sin * y, cos * y - sin * x]);
    }

    /// Takes each pixel from a place that depends on its own; places are relative to the centre. Coordinates lose their fraction, so
    /// that those between -1 and 0 are inside.
    fn sample(&mut self, source: impl Fn(f64, f64) -> [f64; 2]) {
        let middle = [
            numbers::real(self.width) / 2.0,
            numbers::real(self.height) / 2.0,
        ];
        let coordinate = |value: f64| (value > -1.0).then_some(numbers::index(value));
        *self = self.map_places(|column, row| {
            let [x, y] = source(
                numbers::real(column) + 0.5 - middle[0],
                numbers::real(row) + 0.5 - middle[1],
            );
            let from = coordinate(middle[0] + x).zip(coordinate(middle[1] + y));
            from.and_then(|(column, row)| self.get(column, row))
                .unwrap_or(BLACK)
        });
    }
}

/// Whole pixels, at most the size; halves are rounded away from 0.
fn offset(part: f64, size: usize) -> i64 {
    let size = numbers::real(size);
    numbers::truncated((part * size).round().clamp(-size, size))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{white, white_at};
    use super::*;

    fn after(places: &[(usize, usize)], change: impl Fn(&mut RgbImage)) -> Vec<(usize, usize)> {
        let mut image = white_at([4, 4], places);
        change(&mut image);
        white(&image)
    }

    #[test]
    fn content_moves_right_and_up() {
        assert_eq!(
            after(&[(0, 0)], |image| image.shift([0.25, 0.0], false)),
            [(1, 0)]
        );
        assert_eq!(
            after(&[(3, 0)], |image| image.shift([0.25, 0.0], false)),
            []
        );
        assert_eq!(
            after(&[(3, 0)], |image| image.shift([0.25, 0.0], true)),
            [(0, 0)]
        );
        assert_eq!(
            after(&[(1, 1)], |image| image.shift([-0.25, 0.375], false)),
            [(0, 3)]
        );
        assert_eq!(
            after(&[(1, 1)], |image| image.shift([9.0, 0.0], true)),
            [(1, 1)]
        );
        assert_eq!(
            after(&[(1, 1)], |image| image
                .shift([f64::NAN, f64::NEG_INFINITY], false)),
            []
        );
    }

    #[test]
    fn a_quarter_turn() {
        assert_eq!(
            after(&[(0, 3)], |image| image.rotate(std::f64::consts::FRAC_PI_2)),
            [(0, 0)]
        );
        assert_eq!(after(&[(0, 3)], |image| image.rotate(f64::NAN)), []);
    }

    #[test]
    fn content_is_magnified() {
        let inner = [(0, 0), (1, 0), (0, 1), (1, 1)];
        assert_eq!(after(&[(1, 1)], |image| image.resize([2.0, 2.0])), inner);
        assert_eq!(after(&[(1, 1)], |image| image.resize([0.0, f64::NAN])), []);
    }

    #[test]
    fn mirrors() {
        assert_eq!(after(&[(0, 1)], RgbImage::flip_horizontally), [(3, 1)]);
        assert_eq!(after(&[(0, 1)], RgbImage::flip_vertically), [(0, 2)]);
    }
}
