//! The bits of a marker: samples of each cell of a quadrilateral, bright or dark.

use nalgebra::{SMatrix, SVector};

use super::Quad;
use crate::matrix::Matrix;

/// Samples of a cell along each side.
const SAMPLES: usize = 4;
/// The part of a cell that is left out along its edges.
const MARGIN: f64 = 0.15;
/// The least difference between bright and dark.
const MIN_CONTRAST: f64 = 10.0;

/// A projective map of the plane.
pub(super) struct Homography([f64; 9]);

impl Homography {
    /// The map of the unit square's corners, clockwise from (0, 0), to those of a quadrilateral. None when that has no area.
    pub(super) fn from_unit_square(corners: &Quad) -> Option<Self> {
        Self::between(&UNIT, corners)
    }

    /// The inverse.
    #[cfg(test)]
    pub(super) fn onto_unit_square(corners: &Quad) -> Option<Self> {
        Self::between(corners, &UNIT)
    }

    /// Eight equations for the eight coefficients.
    fn between(from: &Quad, to: &Quad) -> Option<Self> {
        let mut equations = SMatrix::<f64, 8, 8>::zeros();
        let mut sides = SVector::<f64, 8>::zeros();
        for (n, ([x, y], place)) in from.iter().zip(to).enumerate() {
            for (i, at) in place.iter().enumerate() {
                let row = 2 * n + i;
                for (j, value) in [*x, *y, 1.0].into_iter().enumerate() {
                    equations[(row, 3 * i + j)] = value;
                }
                equations[(row, 6)] = -x * at;
                equations[(row, 7)] = -y * at;
                sides[row] = *at;
            }
        }
        let solution = equations.lu().solve(&sides)?;
        let mut map = [1.0; 9];
        map[..8].copy_from_slice(solution.as_slice());
        map.iter()
            .all(|value| value.is_finite())
            .then_some(Self(map))
    }

    pub(super) fn apply(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d, e, f, g, h, i] = self.0;
        let scale = g * x + h * y + i;
        [(a * x + b * y + c) / scale, (d * x + e * y + f) / scale]
    }
}

const UNIT: Quad = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

/// The bits inside of the border, row by row from the first corner. None unless there is a dark border of one cell.
pub(super) fn read(grey: &Matrix, quad: &Quad, side: usize) -> Option<Vec<bool>> {
    let map = Homography::from_unit_square(quad)?;
    let cells = side + 2;
    let means: Vec<f64> = (0..cells * cells)
        .map(|at| mean(grey, &map, at % cells, at / cells, cells))
        .collect();
    let threshold = threshold(&means)?;
    let is_border = |at: usize| {
        [at % cells, at / cells]
            .iter()
            .any(|place| *place == 0 || *place == cells - 1)
    };
    let bright: Vec<bool> = means.iter().map(|mean| *mean > threshold).collect();
    let is_dark = (0..cells * cells)
        .filter(|at| is_border(*at))
        .all(|at| !bright[at]);
    is_dark.then(|| {
        (0..cells * cells)
            .filter(|at| !is_border(*at))
            .map(|at| bright[at])
            .collect()
    })
}

fn mean(grey: &Matrix, map: &Homography, column: usize, row: usize, cells: usize) -> f64 {
    let [width, height] = grey.size();
    let place = |cell: usize, sample: usize| {
        let part =
            MARGIN + (1.0 - 2.0 * MARGIN) * (numbers::real(sample) + 0.5) / numbers::real(SAMPLES);
        (numbers::real(cell) + part) / numbers::real(cells)
    };
    let sample = |n: usize| {
        let [x, y] = map.apply([place(column, n % SAMPLES), place(row, n / SAMPLES)]);
        let index = |at: f64, size: usize| numbers::index(at.round().max(0.0)).min(size - 1);
        grey.value(index(y, height) * width + index(x, width))
            .unwrap_or_default()
    };
    (0..SAMPLES * SAMPLES).map(sample).sum::<f64>() / numbers::real(SAMPLES * SAMPLES)
}

/// The threshold that separates values best (Otsu, 1979). None when they are nearly the same.
fn threshold(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mean = |part: &[f64]| part.iter().sum::<f64>() / numbers::real(part.len());
    let spread = |at: usize| {
        let (dark, bright) = sorted.split_at(at);
        let difference = mean(bright) - mean(dark);
        numbers::real(dark.len()) * numbers::real(bright.len()) * difference * difference
    };
    let best = (1..sorted.len()).max_by(|a, b| spread(*a).total_cmp(&spread(*b)))?;
    let (dark, bright) = sorted.split_at(best);
    let has_contrast = mean(bright) - mean(dark) >= MIN_CONTRAST;
    has_contrast.then(|| (mean(bright) + mean(dark)) / 2.0)
}
