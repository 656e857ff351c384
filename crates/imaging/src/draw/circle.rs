//! Circles and ellipses.

use super::mask::Mask;
use super::{LineType, Pen, PixelPosition, Stroke};
use crate::matrix::{Matrix, MatrixError, MatrixResult};

impl Matrix {
    /// Draws or fills a circle.
    ///
    /// # Errors
    /// When the radius is negative.
    pub fn draw_circle(
        &mut self,
        centre: PixelPosition,
        radius: f64,
        pen: &Pen,
        stroke: Stroke,
    ) -> MatrixResult<()> {
        if radius.is_nan() || radius < 0.0 {
            return Err(MatrixError::Range("the radius"));
        }
        let is_thin = matches!(stroke, Stroke::Fill | Stroke::Outline(1))
            && pen.line_type != LineType::Antialiased;
        let is_whole = radius.fract() == 0.0 && centre.iter().all(|x| x.fract() == 0.0);
        if is_thin && is_whole {
            self.draw_thin_circle(centre, radius, pen, stroke == Stroke::Fill);
            return Ok(());
        }
        let width = if let Stroke::Outline(thickness) = stroke {
            f64::from(thickness) / 2.0
        } else {
            0.0
        };
        let Some(mut mask) = Mask::around(self, &[centre], radius + width) else {
            return Ok(());
        };
        mask.add_circle(centre, radius, width, stroke == Stroke::Fill, pen.line_type);
        mask.paint(self, pen);
        Ok(())
    }

    /// The pixels nearest to a circle, one for each row where it is steep and one for each column where it is flat.
    fn draw_thin_circle(&mut self, [x, y]: PixelPosition, radius: f64, pen: &Pen, is_filled: bool) {
        let across = |along: f64| (radius * radius - along * along).sqrt().round();
        let [width, height] = self.size().map(numbers::real);
        let visible =
            |centre: f64, size: f64| ((-centre).max(-radius), (size - 1.0 - centre).min(radius));
        let (low, high) = visible(y, height);
        for along in whole_numbers(low, high) {
            let half = across(along);
            let row = numbers::truncated(y + along);
            if is_filled {
                self.paint_span(row, x - half, x + half, pen);
            }
            if half >= along.abs() {
                [-half, half]
                    .iter()
                    .for_each(|side| self.paint([numbers::truncated(x + side), row], pen, 1.0));
            }
        }
        let (low, high) = visible(x, width);
        for along in whole_numbers(low, high) {
            let half = across(along);
            if half >= along.abs() {
                [-half, half].iter().for_each(|side| {
                    self.paint(
                        [numbers::truncated(x + along), numbers::truncated(y + side)],
                        pen,
                        1.0,
                    );
                });
            }
        }
    }

    /// An ellipse, or a part of it: `angle` turns it, `arc` are the first and last angle in the ellipse; degrees, clockwise in the image.
    pub fn draw_ellipse(
        &mut self,
        centre: PixelPosition,
        radii: PixelPosition,
        angle: f64,
        arc: [f64; 2],
        pen: &Pen,
        stroke: Stroke,
    ) {
        let mut places = arc_places(centre, radii, angle, arc);
        let is_whole = (arc[1] - arc[0]).abs() >= 360.0;
        match stroke {
            Stroke::Outline(thickness) => self.draw_lines(&places, is_whole, pen, thickness),
            Stroke::Fill => {
                if !is_whole {
                    places.push(centre);
                }
                self.fill_polygons(&[places], pen);
            }
        }
    }
}

/// Whole numbers between two, which are whole themselves.
fn whole_numbers(low: f64, high: f64) -> impl Iterator<Item = f64> {
    let count = if low <= high {
        numbers::index(high - low) + 1
    } else {
        0
    };
    (0..count).map(move |n| low + numbers::real(n))
}

/// Places on an ellipse, a degree from each other.
fn arc_places(
    centre: PixelPosition,
    radii: PixelPosition,
    angle: f64,
    arc: [f64; 2],
) -> Vec<PixelPosition> {
    if !arc
        .iter()
        .chain([&angle])
        .all(|degrees| degrees.is_finite())
    {
        return Vec::new();
    }
    let (first, span) = (
        arc[0].min(arc[1]).rem_euclid(360.0),
        (arc[1] - arc[0]).abs().min(360.0),
    );
    let (sin, cos) = libm::sincos(angle.rem_euclid(360.0).to_radians());
    let steps = span.ceil().max(1.0);
    (0..=numbers::index(steps))
        .map(|n| {
            let (y, x) = libm::sincos((first + span * numbers::real(n) / steps).to_radians());
            let (x, y) = (x * radii[0], y * radii[1]);
            [centre[0] + x * cos - y * sin, centre[1] + x * sin + y * cos]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{WHITE, blank, shown};
    use super::*;

    #[test]
    fn circles() {
        let mut image = blank(7, 7);
        image
            .draw_circle([3.0, 3.0], 3.0, &WHITE, Stroke::Outline(1))
            .unwrap();
        assert_eq!(
            shown(&image),
            [
                "..###..", ".#...#.", "#.....#", "#.....#", "#.....#", ".#...#.", "..###.."
            ]
        );
        image
            .draw_circle([3.0, 3.0], 3.0, &WHITE, Stroke::Fill)
            .unwrap();
        assert_eq!(shown(&image)[1..4], [".#####.", "#######", "#######"]);
        let mut image = blank(3, 1);
        image
            .draw_circle([1.0, 0.0], 0.0, &WHITE, Stroke::Outline(1))
            .unwrap();
        assert_eq!(shown(&image), [".#."]);
        assert!(
            image
                .draw_circle([1.0, 0.0], -1.0, &WHITE, Stroke::Fill)
                .is_err()
        );
    }

    #[test]
    fn huge_circles_cost_little() {
        let mut image = blank(4, 2);
        image
            .draw_circle([1e12, 0.0], 1e12 - 2.0, &WHITE, Stroke::Outline(1))
            .unwrap();
        assert_eq!(shown(&image), ["..#.", "..#."]);
        image
            .draw_circle([1e12, 0.0], 1e12 + 9.0, &WHITE, Stroke::Fill)
            .unwrap();
        assert_eq!(shown(&image), ["####", "####"]);
    }

    #[test]
    fn thick_and_soft_rings() {
        let mut image = blank(9, 9);
        image
            .draw_circle([4.0, 4.0], 3.0, &WHITE, Stroke::Outline(3))
            .unwrap();
        assert_eq!(shown(&image)[4], "###...###");
        image
            .draw_circle(
                [4.0, 4.0],
                3.0,
                &Pen {
                    line_type: LineType::Antialiased,
                    ..WHITE
                },
                Stroke::Fill,
            )
            .unwrap();
        assert_eq!(shown(&image)[4], "#########");
    }

    #[test]
    fn ellipses() {
        let mut image = blank(9, 5);
        image.draw_ellipse(
            [4.0, 2.0],
            [4.0, 2.0],
            0.0,
            [0.0, 360.0],
            &WHITE,
            Stroke::Fill,
        );
        assert_eq!(shown(&image)[2], "#########");
        assert_eq!(shown(&image)[0], ".#######.");
        let mut image = blank(9, 5);
        image.draw_ellipse(
            [4.0, 2.0],
            [4.0, 2.0],
            180.0,
            [0.0, 90.0],
            &WHITE,
            Stroke::Outline(1),
        );
        assert_eq!(
            (image.value(2 * 9), image.value(4), image.value(2 * 9 + 8)),
            (Some(255.0), Some(255.0), Some(0.0))
        );
        image.draw_ellipse(
            [4.0, 2.0],
            [1e300, f64::MAX],
            f64::NAN,
            [0.0, 1e300],
            &WHITE,
            Stroke::Fill,
        );
        image.draw_ellipse(
            [4.0, 2.0],
            [4.0, 2.0],
            0.0,
            [-1e300, 1e300],
            &WHITE,
            Stroke::Outline(1),
        );
    }
}
