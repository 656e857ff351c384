//! Quadrilaterals that may be markers.

use super::Quad;
use super::contours::{Pixel, dark_pixels, outlines};
use crate::matrix::Matrix;

/// Sides of the windows of the adaptive threshold.
const WINDOWS: [usize; 3] = [3, 13, 23];
/// The least and the largest perimeter, as parts of the larger side of the image.
const PERIMETER_LIMITS: [f64; 2] = [0.03, 4.0];
/// Largest distance of an outline from the sides of its quadrilateral, as a fraction of the perimeter.
const MAX_DEVIATION: f64 = 0.03;
/// Smallest distance between two corners, as a fraction of the perimeter.
const MIN_CORNER_DISTANCE: f64 = 0.05;
/// Largest distance between the corners of two quadrilaterals that are duplicates, as a fraction of the perimeter.
const MAX_DUPLICATE_DISTANCE: f64 = 0.05;
/// Fraction of a side at each end that is ignored, since the outline is rounded at the corners.
const CORNER_MARGIN: f64 = 0.15;

/// Quadrilaterals around dark regions, without those that occur twice.
pub(super) fn candidates(grey: &Matrix) -> Vec<Quad> {
    let [width, height] = grey.size();
    let limits = PERIMETER_LIMITS.map(|part| part * numbers::real(width.max(height)));
    let mut found: Vec<Quad> = Vec::new();
    for window in WINDOWS {
        let dark = dark_pixels(grey, window);
        for outline in outlines(&dark, width, numbers::index(limits[1])) {
            if numbers::real(outline.len()) < limits[0].max(16.0) {
                continue;
            }
            if let Some(quad) = quadrilateral(&outline) {
                add(&mut found, quad);
            }
        }
    }
    found
}

/// Adds a quadrilateral unless it is there; of two that are nearly the same the larger one stays.
fn add(found: &mut Vec<Quad>, quad: Quad) {
    let is_same = |other: &Quad| {
        let limit = MAX_DUPLICATE_DISTANCE * perimeter(&quad).min(perimeter(other));
        (0..4).any(|turns| (0..4).all(|i| distance(quad[i], other[(i + turns) % 4]) < limit))
    };
    match found.iter().position(is_same) {
        Some(at) if perimeter(&quad) > perimeter(&found[at]) => found[at] = quad,
        Some(_) => {}
        None => found.push(quad),
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

fn perimeter(quad: &Quad) -> f64 {
    (0..4).map(|i| distance(quad[i], quad[(i + 1) % 4])).sum()
}

/// The convex quadrilateral of an outline, its corners where the lines along its sides meet. None when it has another shape.
fn quadrilateral(outline: &[Pixel]) -> Option<Quad> {
    let length = numbers::real(outline.len());
    let corners: [usize; 4] = corners(outline, MAX_DEVIATION * length).try_into().ok()?;
    let rough = corners.map(|at| place(outline[at]));
    let is_wide =
        (0..4).all(|i| distance(rough[i], rough[(i + 1) % 4]) >= MIN_CORNER_DISTANCE * length);
    if !is_wide || !is_convex(&rough) {
        return None;
    }
    Some(
        refined(outline, corners)
            .filter(|quad| {
                (0..4).all(|i| distance(quad[i], rough[i]) < MAX_DUPLICATE_DISTANCE * length)
            })
            .unwrap_or(rough),
    )
}

fn place(pixel: Pixel) -> [f64; 2] {
    pixel.map(numbers::real_of)
}

/// Outlines are clockwise, so every corner turns to the right.
fn is_convex(quad: &Quad) -> bool {
    (0..4).all(|i| {
        let [a, b, c] = [quad[i], quad[(i + 1) % 4], quad[(i + 2) % 4]];
        (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) > 0.0
    })
}

/// Indices of the corners of an outline (Ramer, 1972; Douglas and Peucker, 1973), from the two places farthest from each other on.
fn corners(outline: &[Pixel], deviation: f64) -> Vec<usize> {
    let farthest_from = |at: usize| {
        let far = |n: &usize| distance(place(outline[at]), place(outline[*n]));
        (0..outline.len())
            .max_by(|a, b| far(a).total_cmp(&far(b)).then(b.cmp(a)))
            .unwrap_or(0)
    };
    let first = farthest_from(0);
    let second = farthest_from(first);
    let (low, high) = (first.min(second), first.max(second));
    let mut found = vec![low];
    split(outline, low, high, deviation, &mut found);
    found.push(high);
    split(outline, high, low + outline.len(), deviation, &mut found);
    found.iter().map(|at| at % outline.len()).collect()
}

/// Adds the corners between two places, whose indices may go past the end.
fn split(outline: &[Pixel], first: usize, last: usize, deviation: f64, found: &mut Vec<usize>) {
    let at = |n: usize| place(outline[n % outline.len()]);
    let (a, b) = (at(first), at(last));
    let length = distance(a, b).max(1e-9);
    let off = |n: usize| {
        ((b[0] - a[0]) * (at(n)[1] - a[1]) - (b[1] - a[1]) * (at(n)[0] - a[0])).abs() / length
    };
    let farthest = (first + 1..last).max_by(|m, n| off(*m).total_cmp(&off(*n)).then(n.cmp(m)));
    // More than four corners are no quadrilateral.
    let Some(middle) = farthest.filter(|n| off(*n) > deviation && found.len() <= 4) else {
        return;
    };
    split(outline, first, middle, deviation, found);
    found.push(middle);
    split(outline, middle, last, deviation, found);
}

/// Corners where the lines through the pixels of neighbouring sides meet.
fn refined(outline: &[Pixel], corners: [usize; 4]) -> Option<Quad> {
    let count = outline.len();
    let line = |i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % 4]);
        let length = (to + count - from) % count;
        let bent = numbers::index(numbers::real(length) * CORNER_MARGIN) + 1;
        let places: Vec<[f64; 2]> = (bent..length.saturating_sub(bent))
            .map(|n| place(outline[(from + n) % count]))
            .collect();
        fitted_line(&places)
    };
    let lines = [line(0)?, line(1)?, line(2)?, line(3)?];
    let mut quad = [[0.0; 2]; 4];
    for (i, corner) in quad.iter_mut().enumerate() {
        *corner = meeting(lines[(i + 3) % 4], lines[i])?;
    }
    is_convex(&quad).then_some(quad)
}

/// Middle and direction of the line that is nearest to places, by the axis of their moments.
fn fitted_line(places: &[[f64; 2]]) -> Option<[[f64; 2]; 2]> {
    if places.len() < 3 {
        return None;
    }
    let count = numbers::real(places.len());
    let middle = [0, 1].map(|i| places.iter().map(|place| place[i]).sum::<f64>() / count);
    let moment = |i: usize, j: usize| {
        places
            .iter()
            .map(|p| (p[i] - middle[i]) * (p[j] - middle[j]))
            .sum::<f64>()
    };
    let angle = libm::atan2(2.0 * moment(0, 1), moment(0, 0) - moment(1, 1)) / 2.0;
    Some([middle, [libm::cos(angle), libm::sin(angle)]])
}

fn meeting([a, u]: [[f64; 2]; 2], [b, v]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let across = u[0] * v[1] - u[1] * v[0];
    if across.abs() < 1e-6 {
        return None;
    }
    let part = ((b[0] - a[0]) * v[1] - (b[1] - a[1]) * v[0]) / across;
    Some([a[0] + part * u[0], a[1] + part * u[1]])
}
