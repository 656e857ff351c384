//! Outlines of dark regions, after an adaptive threshold.

use crate::matrix::Matrix;

/// How much darker than its surroundings a dark pixel is.
const THRESHOLD_OFFSET: f64 = 7.0;

/// A place in the image.
pub(super) type Pixel = [i64; 2];

/// Which pixels are darker than the mean of the `window` by `window` pixels around them.
pub(super) fn dark_pixels(grey: &Matrix, window: usize) -> Vec<bool> {
    let [width, height] = grey.size();
    let bytes = grey.bytes().unwrap_or_default();
    let stride = width + 1;
    let mut sums = vec![0u64; stride * (height + 1)];
    for row in 0..height {
        let mut sum = 0;
        for column in 0..width {
            sum += u64::from(bytes[row * width + column]);
            sums[(row + 1) * stride + column + 1] = sums[row * stride + column + 1] + sum;
        }
    }
    let reach = window / 2;
    let ends = |at: usize, size: usize| (at.saturating_sub(reach), (at + reach + 1).min(size));
    let is_dark = |at: usize| {
        let ((left, right), (top, bottom)) = (ends(at % width, width), ends(at / width, height));
        let inside = sums[bottom * stride + right] + sums[top * stride + left];
        let sum = inside - sums[top * stride + right] - sums[bottom * stride + left];
        let mean = sum as f64 / numbers::real((right - left) * (bottom - top));
        f64::from(bytes[at]) <= mean - THRESHOLD_OFFSET
    };
    (0..width * height).map(is_dark).collect()
}

/// The eight neighbours, clockwise in the image from the one to the right.
const AROUND: [Pixel; 8] = [
    [1, 0],
    [1, 1],
    [0, 1],
    [-1, 1],
    [-1, 0],
    [-1, -1],
    [0, -1],
    [1, -1],
];

/// The outer outlines of regions that are connected over sides or corners, clockwise, in the order of their first pixels. Those longer
/// than `longest` are left out.
pub(super) fn outlines(dark: &[bool], width: usize, longest: usize) -> Vec<Vec<Pixel>> {
    let mut seen = vec![false; dark.len()];
    let mut outlines = Vec::new();
    for first in 0..dark.len() {
        if !dark[first] || seen[first] {
            continue;
        }
        mark_region(dark, width, first, &mut seen);
        let start = [numbers::count(first % width), numbers::count(first / width)];
        outlines.extend(outline(dark, width, start, longest));
    }
    outlines
}

fn mark_region(dark: &[bool], width: usize, first: usize, seen: &mut [bool]) {
    let mut pending = vec![first];
    seen[first] = true;
    while let Some(at) = pending.pop() {
        let place = [numbers::count(at % width), numbers::count(at / width)];
        for step in AROUND {
            if let Some(next) =
                index(dark, width, place, step).filter(|next| dark[*next] && !seen[*next])
            {
                seen[next] = true;
                pending.push(next);
            }
        }
    }
}

/// The index of a neighbour, None outside of the image.
fn index(dark: &[bool], width: usize, [x, y]: Pixel, [dx, dy]: Pixel) -> Option<usize> {
    let (x, y) = (x + dx, y + dy);
    let height = numbers::count(dark.len() / width);
    let is_inside = (0..numbers::count(width)).contains(&x) && (0..height).contains(&y);
    is_inside.then(|| numbers::place_of(y) * width + numbers::place_of(x))
}

/// Moore's neighbour tracing from the first pixel of a region, until its first step would be made again.
fn outline(dark: &[bool], width: usize, start: Pixel, longest: usize) -> Option<Vec<Pixel>> {
    let step_from = |place: Pixel, back: usize| {
        (1..=8).map(|n| (back + n) % 8).find(|direction| {
            index(dark, width, place, AROUND[*direction]).is_some_and(|at| dark[at])
        })
    };
    // The pixel to the left of the first one is not dark.
    let Some(first) = step_from(start, 4) else {
        return Some(vec![start]);
    };
    let (mut place, mut direction) = (start, first);
    let mut outline = Vec::new();
    loop {
        outline.push(place);
        if outline.len() > longest {
            return None;
        }
        place = [
            place[0] + AROUND[direction][0],
            place[1] + AROUND[direction][1],
        ];
        // Begin behind where we came from: of a step along a side one further, since that pixel was looked at.
        let back = (direction + if direction % 2 == 0 { 6 } else { 5 }) % 8;
        direction = step_from(place, (back + 7) % 8)?;
        if place == start && direction == first {
            return Some(outline);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dark(rows: &[&str]) -> (Vec<bool>, usize) {
        (
            rows.concat().chars().map(|letter| letter == '#').collect(),
            rows[0].len(),
        )
    }

    #[test]
    fn outlines_go_around_once() {
        let (pixels, width) = dark(&["......", ".###..", ".#.#..", ".###..", "......"]);
        let found = outlines(&pixels, width, 100);
        assert_eq!(
            found,
            [vec![
                [1, 1],
                [2, 1],
                [3, 1],
                [3, 2],
                [3, 3],
                [2, 3],
                [1, 3],
                [1, 2]
            ]]
        );
        assert_eq!(outlines(&pixels, width, 7), Vec::<Vec<Pixel>>::new());
    }

    #[test]
    fn points_lines_and_crossings() {
        let (pixels, width) = dark(&["#....", ".....", "..###", "...#.", "#.#.."]);
        let found = outlines(&pixels, width, 100);
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>()[0], 1);
        assert_eq!(found.len(), 3);
        assert!(found.iter().all(|outline| outline.len() < 10));
    }

    #[test]
    fn dark_is_relative() {
        let mut image = Matrix::from_bytes([9, 9], 1, vec![100; 81]).unwrap();
        image.set_value(40, 50.0);
        let found = dark_pixels(&image, 3);
        assert_eq!(found.iter().filter(|dark| **dark).count(), 1);
        assert!(found[40]);
    }
}
