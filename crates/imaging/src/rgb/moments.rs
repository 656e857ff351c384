//! Binary images and their moments: share, centre, orientation and roundness of what is white.

use super::{BLACK, Rgb, RgbImage, mean};

/// Moments of the white pixels of a binary image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    /// Share of the pixels that are white.
    pub proportion: f64,
    /// Mean of the indices of white pixels, by the resolution.
    pub centre: [f64; 2],
    /// Angle of the long axis, rad.
    pub orientation: f64,
    /// 0 for a line, 1 for a disc.
    pub roundness: f64,
}

/// Expected moments. A tolerance is the first difference that is too large.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// The moments; the roundness is the largest one allowed.
    pub moments: Moments,
    /// Of the proportion.
    pub proportion_tolerance: f64,
    /// Of the centre's two coordinates.
    pub centre_tolerance: [f64; 2],
    /// Of the orientation, rad.
    pub orientation_tolerance: f64,
}

impl Expected {
    /// Whether moments are as expected; their roundness is at most the expected one.
    pub fn matches(&self, found: &Moments) -> bool {
        let is_near = |a: f64, b: f64, tolerance: f64| (a - b).abs() < tolerance;
        let turned = self.moments.orientation - found.orientation;
        let wrapped = turned - (turned / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        is_near(
            self.moments.proportion,
            found.proportion,
            self.proportion_tolerance,
        ) && (0..2).all(|i| {
            is_near(
                self.moments.centre[i],
                found.centre[i],
                self.centre_tolerance[i],
            )
        }) && wrapped.abs() < self.orientation_tolerance
            && found.roundness <= self.moments.roundness
    }
}

impl RgbImage {
    /// Makes pixels white where their mean reaches `threshold`, others black.
    pub fn make_binary(&mut self, threshold: f64) -> Moments {
        self.pixels.iter_mut().for_each(|pixel| {
            *pixel = if mean(*pixel) >= threshold {
                [1.0; 3]
            } else {
                BLACK
            }
        });
        self.moments_of_white()
    }

    fn moments_of_white(&self) -> Moments {
        let width = self.width;
        let white = || {
            let is_white = |(_, pixel): &(usize, &Rgb)| pixel[0] == 1.0;
            self.pixels
                .iter()
                .enumerate()
                .filter(is_white)
                .map(move |(at, _)| [numbers::real(at % width), numbers::real(at / width)])
        };
        let [count, x, y] = white().fold([0.0; 3], |[n, sx, sy], [x, y]| [n + 1.0, sx + x, sy + y]);
        let size = [numbers::real(self.width), numbers::real(self.height)];
        if count == 0.0 {
            return Moments {
                proportion: 0.0,
                centre: size.map(|pixels| 0.5 / pixels),
                orientation: 0.0,
                roundness: 1.0,
            };
        }
        let middle = [x / count, y / count];
        let second = white().fold([0.0; 3], |[xx, xy, yy], [x, y]| {
            let (dx, dy) = (x - middle[0], y - middle[1]);
            [xx + dx * dx, xy + dx * dy, yy + dy * dy]
        });
        let (orientation, roundness) = axis(second);
        let centre = [middle[0] / size[0], middle[1] / size[1]];
        Moments {
            proportion: count / (size[0] * size[1]),
            centre,
            orientation,
            roundness,
        }
    }

    /// Draws the axis of what is white, from the centre to both sides.
    pub fn draw_axis(&mut self, moments: &Moments, colour: Rgb) {
        let (sin, cos) = libm::sincos(moments.orientation);
        let size = [numbers::real(self.width), numbers::real(self.height)];
        let reach = 0.25 * size[0].min(size[1]);
        let middle = [moments.centre[0] * size[0], moments.centre[1] * size[1]];
        let end = |side: f64| {
            [
                middle[0] + side * reach * cos,
                middle[1] + side * reach * sin,
            ]
        };
        self.draw_line(end(-1.0), end(1.0), colour);
    }

    /// Draws a line between pixels, as far as it is inside.
    pub fn draw_line(&mut self, from: [f64; 2], to: [f64; 2], colour: Rgb) {
        let span = (to[0] - from[0]).abs().max((to[1] - from[1]).abs());
        let is_near = span <= numbers::real(self.width + self.height) * 2.0;
        if !is_near {
            return;
        }
        let steps = span.round().max(1.0);
        for step in 0..=numbers::index(steps) {
            let part = numbers::real(step) / steps;
            let [x, y] = [0, 1].map(|i| (from[i] + (to[i] - from[i]) * part).round());
            if x >= 0.0
                && y >= 0.0
                && let Some(at) = self.index(numbers::index(x), numbers::index(y))
            {
                self.pixels[at] = colour;
            }
        }
    }
}

/// Angle of the axis of least inertia, and the ratio of the smallest to the largest moment, of the sums of dx dx, dx dy and dy dy.
fn axis([a, half_b, c]: [f64; 3]) -> (f64, f64) {
    let b = 2.0 * half_b;
    if b == 0.0 && a == c {
        return (0.0, 1.0);
    }
    let q = (b * b + (a - c) * (a - c)).sqrt();
    let angle = 0.5 * libm::acos(((a - c) / q).clamp(-1.0, 1.0));
    let roundness = (a + c - q) / (a + c + q);
    (if b < 0.0 { -angle } else { angle }, roundness)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    use super::super::tests::{white, white_at};
    use super::*;

    fn moments(places: &[(usize, usize)]) -> Moments {
        white_at([8, 8], places).make_binary(0.5)
    }

    fn is_near(found: Moments, expected: Moments) -> bool {
        let numbers = |m: Moments| {
            [
                m.proportion,
                m.centre[0],
                m.centre[1],
                m.orientation,
                m.roundness,
            ]
        };
        numbers(found)
            .iter()
            .zip(numbers(expected))
            .all(|(a, b)| (a - b).abs() < 1e-12)
    }

    #[test]
    fn a_rectangle_and_lines() {
        let rectangle = moments(&[(2, 3), (3, 3), (4, 3), (2, 4), (3, 4), (4, 4)]);
        let expected = Moments {
            proportion: 0.09375,
            centre: [0.375, 0.4375],
            orientation: 0.0,
            roundness: 0.375,
        };
        assert!(is_near(rectangle, expected), "{rectangle:?}");
        let line = Moments {
            proportion: 0.0625,
            centre: [0.1875; 2],
            orientation: FRAC_PI_4,
            roundness: 0.0,
        };
        assert!(is_near(moments(&[(0, 0), (1, 1), (2, 2), (3, 3)]), line));
        let line = Moments {
            orientation: -FRAC_PI_4,
            ..line
        };
        assert!(is_near(moments(&[(0, 3), (1, 2), (2, 1), (3, 0)]), line));
        let upright = moments(&[(2, 0), (2, 1), (2, 2)]);
        assert!((upright.orientation - FRAC_PI_2).abs() < 1e-12 && upright.roundness == 0.0);
    }

    #[test]
    fn nothing_and_a_point_are_round() {
        let nothing = Moments {
            proportion: 0.0,
            centre: [0.0625; 2],
            orientation: 0.0,
            roundness: 1.0,
        };
        assert_eq!(moments(&[]), nothing);
        assert_eq!(moments(&[(7, 0)]).roundness, 1.0);
    }

    #[test]
    fn expectations_have_tolerances() {
        let found = Moments {
            proportion: 0.5,
            centre: [0.5; 2],
            orientation: 3.0,
            roundness: 0.5,
        };
        let expected = Expected {
            moments: Moments {
                orientation: -3.0,
                ..found
            },
            proportion_tolerance: 0.1,
            centre_tolerance: [0.1; 2],
            orientation_tolerance: 0.3,
        };
        assert!(expected.matches(&found));
        assert!(
            !Expected {
                proportion_tolerance: 0.0,
                ..expected
            }
            .matches(&found)
        );
        assert!(!expected.matches(&Moments {
            roundness: 0.6,
            ..found
        }));
        assert!(!expected.matches(&Moments {
            orientation: 2.0,
            ..found
        }));
    }

    #[test]
    fn lines_end_at_the_border() {
        let mut image = white_at([4, 4], &[]);
        image.draw_line([-2.0, 1.0], [9.0, 1.0], [1.0; 3]);
        assert_eq!(white(&image), [(0, 1), (1, 1), (2, 1), (3, 1)]);
        image.draw_line([f64::NAN, 0.0], [1e300, 0.0], [1.0; 3]);
        assert_eq!(white(&image).len(), 4);
    }
}
