//! Polygons as triangles.

/// Polygons with more corners are cut as a fan: the search for ears takes the square of their number.
const MAX_EARS: usize = 256;

/// Divides a polygon into triangles, by cutting ears (Meisters 1975) in the plane it lies in nearly; as a fan if it crosses itself.
/// Triangles are indices of its corners, with its sense of rotation.
pub(crate) fn triangulate(corners: &[[f64; 3]], mut triangle: impl FnMut([usize; 3])) {
    let mut left: Vec<usize> = (0..corners.len()).collect();
    if corners.len() > 3 && corners.len() <= MAX_EARS {
        cut_ears(&flatten(corners), &mut left, &mut triangle);
    }
    for pair in left.windows(2).skip(1) {
        triangle([left[0], pair[0], pair[1]]);
    }
}

fn cut_ears(points: &[[f64; 2]], left: &mut Vec<usize>, triangle: &mut impl FnMut([usize; 3])) {
    // A convex polygon needs no search; its fan is what other programs make as well.
    let (mut at, mut misses) = (1, 0);
    if (0..left.len()).all(|corner| area(points, around(left, corner)) > 0.0) {
        return;
    }
    while left.len() > 3 && misses < left.len() {
        let corner = at % left.len();
        let ear = around(left, corner);
        if is_ear(points, ear, left) {
            triangle(ear);
            left.remove(corner);
            misses = 0;
        } else {
            at += 1;
            misses += 1;
        }
    }
}

/// A corner between its neighbours.
fn around(left: &[usize], corner: usize) -> [usize; 3] {
    [
        left[(corner + left.len() - 1) % left.len()],
        left[corner],
        left[(corner + 1) % left.len()],
    ]
}

fn is_ear(points: &[[f64; 2]], ear: [usize; 3], left: &[usize]) -> bool {
    area(points, ear) > 0.0
        && !left
            .iter()
            .any(|corner| !ear.contains(corner) && is_inside(points, ear, *corner))
}

fn is_inside(points: &[[f64; 2]], [a, b, c]: [usize; 3], point: usize) -> bool {
    // A corner that is there twice, where a hole was joined to the outline, is in nobody's way.
    if [a, b, c]
        .iter()
        .any(|&corner| points[corner] == points[point])
    {
        return false;
    }
    [[a, b, point], [b, c, point], [c, a, point]]
        .iter()
        .all(|triangle| area(points, *triangle) >= 0.0)
}

/// Twice the area; positive if counterclockwise.
fn area(points: &[[f64; 2]], [a, b, c]: [usize; 3]) -> f64 {
    let [a, b, c] = [points[a], points[b], points[c]];
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The polygon seen along the axis along which its area is largest, counterclockwise.
fn flatten(corners: &[[f64; 3]]) -> Vec<[f64; 2]> {
    let areas = [0, 1, 2].map(|axis| signed_area(corners, (axis + 1) % 3, (axis + 2) % 3));
    let axis = (0..3)
        .max_by(|&a, &b| areas[a].abs().total_cmp(&areas[b].abs()))
        .unwrap_or(2);
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    corners
        .iter()
        .map(|p| {
            if areas[axis] < 0.0 {
                [p[v], p[u]]
            } else {
                [p[u], p[v]]
            }
        })
        .collect()
}

/// Twice the area of the projection onto a plane of two axes (the shoelace formula).
fn signed_area(corners: &[[f64; 3]], u: usize, v: usize) -> f64 {
    corners
        .iter()
        .zip(corners.iter().cycle().skip(1))
        .map(|(a, b)| a[u] * b[v] - a[v] * b[u])
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(corners: &[[f64; 3]]) -> Vec<[usize; 3]> {
        let mut triangles = Vec::new();
        triangulate(corners, |triangle| triangles.push(triangle));
        triangles
    }

    fn total_area(corners: &[[f64; 3]], triangles: &[[usize; 3]]) -> f64 {
        triangles
            .iter()
            .map(|t| signed_area(&t.map(|corner| corners[corner]), 0, 1))
            .sum()
    }

    #[test]
    fn a_convex_polygon_is_a_fan() {
        assert_eq!(
            triangles(&[
                [0.0, 0.0, 5.0],
                [1.0, 0.0, 5.0],
                [1.0, 1.0, 5.0],
                [0.0, 1.0, 5.0]
            ]),
            [[0, 1, 2], [0, 2, 3]]
        );
    }

    #[test]
    fn triangles_of_a_concave_polygon_do_not_overlap_in_either_sense() {
        let mut arrow = vec![
            [0.0, 0.0, 0.0],
            [4.0, -3.0, 1.0],
            [1.0, 0.0, 0.0],
            [4.0, 3.0, 1.0],
        ];
        for sense in [1.0, -1.0] {
            let triangles = triangles(&arrow);
            assert_eq!(triangles.len(), 2);
            assert!(
                triangles
                    .iter()
                    .all(|t| sense * signed_area(&t.map(|corner| arrow[corner]), 0, 1) > 0.0)
            );
            assert_eq!(total_area(&arrow, &triangles), signed_area(&arrow, 0, 1));
            arrow.reverse();
        }
    }

    #[test]
    fn a_spiral_of_many_corners_keeps_its_area() {
        let mut spiral: Vec<[f64; 3]> = Vec::new();
        let arm = |k: usize, width: f64| {
            let angle = k as f64 * 0.3;
            [
                (1.0 + angle + width) * angle.cos(),
                (1.0 + angle + width) * angle.sin(),
                0.0,
            ]
        };
        spiral.extend((0..60).map(|k| arm(k, 1.0)));
        spiral.extend((0..60).rev().map(|k| arm(k, 0.0)));
        let triangles = triangles(&spiral);
        assert_eq!(triangles.len(), 118);
        assert!((total_area(&spiral, &triangles) - signed_area(&spiral, 0, 1)).abs() < 1e-9);
    }

    #[test]
    fn polygons_without_area_and_very_many_corners_end_as_fans() {
        assert_eq!(triangles(&[[1.0; 3]; 5]).len(), 3);
        assert_eq!(triangles(&vec![[0.0; 3]; 5000]).len(), 4998);
        assert!(triangles(&[[0.0; 3]; 2]).is_empty());
    }
}
