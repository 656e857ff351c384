//! Lines, arrows, polylines and rectangles.

use super::mask::Mask;
use super::{LineType, Pen, PixelPosition, Stroke};
use crate::matrix::Matrix;

impl Matrix {
    /// Draws a line of `thickness` pixels.
    pub fn draw_line(&mut self, from: PixelPosition, to: PixelPosition, pen: &Pen, thickness: u32) {
        self.draw_lines(&[from, to], false, pen, thickness);
    }

    /// A line with a tip of two lines at its end, `tip_length` of the line's length.
    pub fn draw_arrow(
        &mut self,
        from: PixelPosition,
        to: PixelPosition,
        pen: &Pen,
        thickness: u32,
        tip_length: f64,
    ) {
        let back = [from[0] - to[0], from[1] - to[1]];
        let length = libm::hypot(back[0], back[1]) * tip_length;
        let angle = libm::atan2(back[1], back[0]);
        self.draw_line(from, to, pen, thickness);
        for side in [1.0, -1.0] {
            let (sin, cos) = libm::sincos(angle + side * std::f64::consts::FRAC_PI_4);
            let end = [to[0] + length * cos, to[1] + length * sin];
            self.draw_line(end.map(f64::round), to, pen, thickness);
        }
    }

    /// Lines from place to place, and back to the first if `is_closed`.
    pub fn draw_lines(
        &mut self,
        places: &[PixelPosition],
        is_closed: bool,
        pen: &Pen,
        thickness: u32,
    ) {
        let Some((&first, &last)) = places.first().zip(places.last()) else {
            return;
        };
        let closing = (is_closed || places.len() == 1).then_some([last, first]);
        let lines = places
            .windows(2)
            .map(|pair| [pair[0], pair[1]])
            .chain(closing);
        if thickness == 1 && pen.line_type != LineType::Antialiased {
            lines.for_each(|[from, to]| self.draw_thin_line(from, to, pen));
            return;
        }
        let radius = f64::from(thickness) / 2.0;
        let Some(mut mask) = Mask::around(self, places, radius) else {
            return;
        };
        lines.for_each(|[from, to]| mask.add_line(from, to, radius, pen.line_type));
        mask.paint(self, pen);
    }

    /// Draws or fills the rectangle between two opposite corners.
    pub fn draw_rectangle(
        &mut self,
        from: PixelPosition,
        to: PixelPosition,
        pen: &Pen,
        stroke: Stroke,
    ) {
        let corners = [from, [to[0], from[1]], to, [from[0], to[1]]];
        match stroke {
            Stroke::Fill => self.fill_polygons(&[corners.to_vec()], pen),
            Stroke::Outline(thickness) => self.draw_lines(&corners, true, pen, thickness),
        }
    }

    /// Bresenham's line between the nearest pixels, of what is inside.
    pub(super) fn draw_thin_line(&mut self, from: PixelPosition, to: PixelPosition, pen: &Pen) {
        let Some([from, to]) = clip_line(self.size(), from.map(f64::round), to.map(f64::round))
        else {
            return;
        };
        let [from, to] = [from, to].map(|place| place.map(|x| numbers::truncated(x.round())));
        let step = [0, 1].map(|i| (to[i] - from[i]).signum());
        let [dx, dy] = [(to[0] - from[0]).abs(), (to[1] - from[1]).abs()];
        let mut at = from;
        let mut error = dx - dy;
        loop {
            self.paint(at, pen, 1.0);
            if at == to {
                return;
            }
            let twice = 2 * error;
            let goes_along = twice > -dy;
            if goes_along {
                error -= dy;
                at[0] += step[0];
            }
            if twice < dx {
                if goes_along && pen.line_type == LineType::FourConnected {
                    self.paint(at, pen, 1.0);
                }
                error += dx;
                at[1] += step[1];
            }
        }
    }
}

/// The part of a line that is inside of an image (Liang and Barsky, 1984); None without one. Ends that are inside stay as they are.
pub fn clip_line(
    [width, height]: [usize; 2],
    from: PixelPosition,
    to: PixelPosition,
) -> Option<[PixelPosition; 2]> {
    let last = [numbers::real(width) - 1.0, numbers::real(height) - 1.0];
    let direction = [to[0] - from[0], to[1] - from[1]];
    let (mut begin, mut end) = (0f64, 1f64);
    for i in 0..2 {
        if direction[i] == 0.0 {
            if !(0.0..=last[i]).contains(&from[i]) {
                return None;
            }
            continue;
        }
        let [a, b] = [-from[i] / direction[i], (last[i] - from[i]) / direction[i]];
        begin = begin.max(a.min(b));
        end = end.min(a.max(b));
    }
    let at = |part: f64| [0, 1].map(|i| (from[i] + part * direction[i]).clamp(0.0, last[i]));
    let first = if begin == 0.0 { from } else { at(begin) };
    let second = if end == 1.0 { to } else { at(end) };
    (begin <= end).then_some([first, second])
}

#[cfg(test)]
mod tests {
    use super::super::tests::{WHITE, blank, shown};
    use super::*;

    #[test]
    fn thin_lines() {
        let mut image = blank(6, 3);
        image.draw_line([0.0, 0.0], [5.0, 2.0], &WHITE, 1);
        assert_eq!(shown(&image), ["##....", "..##..", "....##"]);
        let mut image = blank(3, 3);
        image.draw_line(
            [0.0, 2.0],
            [2.0, 0.0],
            &Pen {
                line_type: LineType::FourConnected,
                ..WHITE
            },
            1,
        );
        assert_eq!(
            image
                .bytes()
                .unwrap()
                .iter()
                .filter(|byte| **byte > 0)
                .count(),
            5
        );
    }

    #[test]
    fn lines_outside_and_far_away() {
        let mut image = blank(4, 2);
        image.draw_line([-5.0, 1.0], [1e15, 1.0], &WHITE, 1);
        assert_eq!(shown(&image), ["....", "####"]);
        let mut image = blank(4, 2);
        image.draw_line([-5.0, -1.0], [9.0, -1.0], &WHITE, 1);
        image.draw_line([1e18, 1e18], [2e18, 1e18], &WHITE, 30_000);
        assert_eq!(shown(&image), ["....", "...."]);
    }

    #[test]
    fn thick_lines_have_round_ends() {
        let mut image = blank(8, 5);
        image.draw_line([2.0, 2.0], [5.0, 2.0], &WHITE, 3);
        assert_eq!(
            shown(&image),
            ["........", ".######.", ".######.", ".######.", "........"]
        );
        let mut image = blank(5, 3);
        image.draw_line(
            [1.0, 1.0],
            [3.0, 1.0],
            &Pen {
                line_type: LineType::Antialiased,
                ..WHITE
            },
            1,
        );
        assert_eq!(shown(&image), [".....", ".###.", "....."]);
    }

    #[test]
    fn antialiased_lines_are_soft() {
        let mut image = blank(6, 3);
        image.draw_line(
            [0.0, 0.0],
            [5.0, 2.0],
            &Pen {
                line_type: LineType::Antialiased,
                ..WHITE
            },
            1,
        );
        assert!(shown(&image).concat().contains('+'));
    }

    #[test]
    fn polylines_rectangles_and_arrows() {
        let mut image = blank(5, 4);
        image.draw_rectangle([1.0, 0.0], [3.0, 2.0], &WHITE, Stroke::Outline(1));
        assert_eq!(shown(&image), [".###.", ".#.#.", ".###.", "....."]);
        image.draw_rectangle([3.0, 2.0], [1.0, 0.0], &WHITE, Stroke::Fill);
        assert_eq!(shown(&image), [".###.", ".###.", ".###.", "....."]);
        let mut image = blank(11, 5);
        image.draw_arrow([0.0, 2.0], [10.0, 2.0], &WHITE, 1, 0.25);
        assert_eq!(
            shown(&image),
            [
                "........#..",
                ".........#.",
                "###########",
                ".........#.",
                "........#.."
            ]
        );
        let mut image = blank(3, 1);
        image.draw_lines(&[[1.0, 0.0]], false, &WHITE, 1);
        image.draw_lines(&[], true, &WHITE, 1);
        assert_eq!(shown(&image), [".#."]);
    }

    #[test]
    fn lines_are_clipped() {
        assert_eq!(
            clip_line([10, 10], [-5.0, 5.0], [5.0, 5.0]),
            Some([[0.0, 5.0], [5.0, 5.0]])
        );
        assert_eq!(clip_line([10, 10], [-5.0, 5.0], [5.0, -9.0]), None);
        assert_eq!(
            clip_line([10, 10], [1.0, 2.0], [3.0, 4.0]),
            Some([[1.0, 2.0], [3.0, 4.0]])
        );
    }
}
