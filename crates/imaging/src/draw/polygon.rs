//! Filled polygons. A place is inside when a ray from it crosses the outlines an odd number of times.

use super::{LineType, Pen, PixelPosition};
use crate::matrix::Matrix;

/// Rows and columns of a pixel that are looked at when it is antialiased.
const FINE: usize = 4;

impl Matrix {
    /// Fills what polygons enclose; where two overlap, nothing. Without antialiasing their outlines belong to it.
    pub fn fill_polygons(&mut self, polygons: &[Vec<PixelPosition>], pen: &Pen) {
        if pen.line_type == LineType::Antialiased {
            return self.fill_softly(polygons, pen);
        }
        for (row, crossings) in self.crossings(polygons, 1).into_iter().enumerate() {
            for pair in crossings.chunks_exact(2) {
                self.paint_span(numbers::count(row), pair[0].ceil(), pair[1].floor(), pen);
            }
        }
        polygons
            .iter()
            .for_each(|polygon| self.draw_lines(polygon, true, pen, 1));
    }

    fn fill_softly(&mut self, polygons: &[Vec<PixelPosition>], pen: &Pen) {
        let width = self.size()[0];
        let fine_rows = self.crossings(polygons, FINE);
        let mut covered = vec![0.0; width];
        for (row, fine) in fine_rows.chunks_exact(FINE).enumerate() {
            covered.fill(0.0);
            for pair in fine.iter().flat_map(|crossings| crossings.chunks_exact(2)) {
                let [from, to] =
                    [pair[0] + 0.5, pair[1] + 0.5].map(|x| x.clamp(0.0, numbers::real(width)));
                for (column, part) in covered
                    .iter_mut()
                    .enumerate()
                    .take(numbers::index(to.ceil()))
                    .skip(numbers::index(from))
                {
                    *part += (to.min(numbers::real(column + 1)) - from.max(numbers::real(column)))
                        .max(0.0)
                        / numbers::real(FINE);
                }
            }
            for (column, part) in covered.iter().enumerate().filter(|(_, part)| **part > 0.0) {
                self.paint(
                    [numbers::count(column), numbers::count(row)],
                    pen,
                    part.min(1.0),
                );
            }
        }
    }

    /// Where the outlines cross the rows, in order; with `fine` several times per row.
    fn crossings(&self, polygons: &[Vec<PixelPosition>], fine: usize) -> Vec<Vec<f64>> {
        let height = self.size()[1];
        let mut rows = vec![Vec::new(); height * fine];
        // The place of a fine row, and the first one from a place on.
        let place = |row: usize| (numbers::real(row) + 0.5) / numbers::real(fine) - 0.5;
        let row_from = |y: f64| {
            numbers::index(((y + 0.5) * numbers::real(fine) - 0.5).ceil().max(0.0))
                .min(height * fine)
        };
        for polygon in polygons {
            for (at, from) in polygon.iter().enumerate() {
                let to = polygon[(at + 1) % polygon.len()];
                let (low, high) = if from[1] <= to[1] {
                    (*from, to)
                } else {
                    (to, *from)
                };
                let (first, end) = (row_from(low[1]), row_from(high[1]));
                for (row, crossings) in rows.iter_mut().enumerate().take(end).skip(first) {
                    let part = (place(row) - low[1]) / (high[1] - low[1]);
                    crossings.push(low[0] + part * (high[0] - low[0]));
                }
            }
        }
        rows.iter_mut()
            .for_each(|crossings| crossings.sort_by(f64::total_cmp));
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{WHITE, blank, shown};
    use super::*;

    #[test]
    fn a_triangle_with_its_outline() {
        let mut image = blank(7, 4);
        image.fill_polygons(&[vec![[0.0, 0.0], [6.0, 0.0], [3.0, 3.0]]], &WHITE);
        assert_eq!(shown(&image), ["#######", ".#####.", "..###..", "...#..."]);
    }

    #[test]
    fn a_hole_is_left_out() {
        let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high]];
        let mut image = blank(7, 7);
        image.fill_polygons(&[square(0.0, 6.0), square(2.0, 4.0)], &WHITE);
        assert_eq!(image.value(3 * 7 + 3), Some(0.0));
        assert_eq!(
            (image.value(3 * 7 + 1), image.value(2 * 7 + 2)),
            (Some(255.0), Some(255.0))
        );
    }

    #[test]
    fn soft_edges_cover_parts_of_pixels() {
        let mut image = blank(4, 3);
        let pen = Pen {
            line_type: LineType::Antialiased,
            ..WHITE
        };
        image.fill_polygons(
            &[vec![[0.5, -0.5], [2.0, -0.5], [2.0, 1.0], [0.5, 1.0]]],
            &pen,
        );
        assert_eq!(
            image.bytes().unwrap(),
            [0, 255, 128, 0, 0, 128, 64, 0, 0, 0, 0, 0]
        );
    }

    #[test]
    fn what_is_far_away_costs_nothing() {
        let mut image = blank(4, 4);
        image.fill_polygons(
            &[
                vec![[-1e18, -1e18], [1e18, -1e18], [1e18, 1e18], [-1e18, 1e18]],
                vec![],
                vec![[9.0, 9.0]],
            ],
            &WHITE,
        );
        assert_eq!(shown(&image), ["####"; 4]);
    }
}
