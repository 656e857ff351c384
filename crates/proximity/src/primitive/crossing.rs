//! Where two triangles meet.

use super::{Triangle, Vector, closest_on_segments, closest_on_triangle};

/// Heights over a plane are zero below this fraction of the coordinates: their rounding error.
const ROUNDING: f64 = 4e-15;

/// Whether two triangles have a point in common. What only touches may be either by rounding.
pub fn triangles_touch(a: &Triangle, b: &Triangle) -> bool {
    match cut(a, b) {
        Cut::Apart => false,
        Cut::Segment(_) => true,
        Cut::Coplanar(normal) => overlap_in_plane(a, b, &normal),
    }
}

/// The segment in which two triangles intersect, both ends; they are equal where the triangles only touch. `None` where they are
/// apart or in one plane.
pub fn segments_of_triangles(a: &Triangle, b: &Triangle) -> Option<[Vector; 2]> {
    match cut(a, b) {
        Cut::Segment(ends) => Some(ends),
        _ => None,
    }
}

enum Cut {
    Apart,
    Coplanar(Vector),
    Segment([Vector; 2]),
}

/// Cuts each triangle by the plane of the other one and compares the pieces on the common line (T. Möller, *A fast triangle-triangle
/// intersection test*, 1997).
fn cut(a: &Triangle, b: &Triangle) -> Cut {
    let normals = [a, b].map(|t| (t[1] - t[0]).cross(&(t[2] - t[0])));
    let rounding = ROUNDING
        * a.iter()
            .chain(b)
            .fold(0.0_f64, |most, p| most.max(p.amax()));
    let has_area = normals.map(|normal| normal.norm_squared() > 0.0);
    match has_area {
        [true, true] => cut_triangles(a, b, &normals, rounding),
        [false, true] => cut_by_segment(b, &normals[1], &ends(a), rounding),
        [true, false] => cut_by_segment(a, &normals[0], &ends(b), rounding),
        [false, false] => {
            let ([a0, a1], [b0, b1]) = (ends(a), ends(b));
            let (p, q, squared) = closest_on_segments([&a0, &a1], [&b0, &b1]);
            if squared <= rounding * rounding {
                Cut::Segment([p, q])
            } else {
                Cut::Apart
            }
        }
    }
}

fn cut_triangles(a: &Triangle, b: &Triangle, normals: &[Vector; 2], rounding: f64) -> Cut {
    let heights_b = heights(b, &a[0], &normals[0], rounding);
    if on_one_side(&heights_b) {
        return Cut::Apart;
    }
    let heights_a = heights(a, &b[0], &normals[1], rounding);
    if on_one_side(&heights_a) {
        return Cut::Apart;
    }
    if heights_a == [0.0; 3] {
        return Cut::Coplanar(normals[1]);
    }
    if heights_b == [0.0; 3] {
        return Cut::Coplanar(normals[0]);
    }
    match overlap(&piece(a, &heights_a), &piece(b, &heights_b), rounding) {
        Some(ends) => Cut::Segment(ends),
        None => Cut::Apart,
    }
}

/// A segment against a triangle that has an area.
fn cut_by_segment(
    triangle: &Triangle,
    normal: &Vector,
    segment: &[Vector; 2],
    rounding: f64,
) -> Cut {
    let heights = heights(
        &[segment[0], segment[1], segment[1]],
        &triangle[0],
        normal,
        rounding,
    );
    if on_one_side(&heights) {
        return Cut::Apart;
    }
    if heights == [0.0; 3] {
        return Cut::Coplanar(*normal);
    }
    let point = segment[0] + (segment[1] - segment[0]) * (heights[0] / (heights[0] - heights[1]));
    let over = closest_on_triangle(&point, triangle);
    if (over - point).norm() <= rounding {
        Cut::Segment([point, point])
    } else {
        Cut::Apart
    }
}

/// The ends of a triangle without area: those of its longest edge.
fn ends(flat: &Triangle) -> [Vector; 2] {
    let edges = [[flat[0], flat[1]], [flat[1], flat[2]], [flat[2], flat[0]]];
    let length = |edge: &[Vector; 2]| (edge[1] - edge[0]).norm_squared();
    edges.into_iter().fold(edges[0], |longest, edge| {
        if length(&edge) > length(&longest) {
            edge
        } else {
            longest
        }
    })
}

/// Heights of corners over a plane (m), exactly 0 within rounding.
#[inline]
fn heights(corners: &Triangle, on_plane: &Vector, normal: &Vector, rounding: f64) -> [f64; 3] {
    let limit = rounding * normal.norm();
    corners.map(|corner| {
        let height = (corner - on_plane).dot(normal);
        if height.abs() <= limit { 0.0 } else { height }
    })
}

#[inline]
fn on_one_side(heights: &[f64; 3]) -> bool {
    heights.iter().all(|h| *h > 0.0) || heights.iter().all(|h| *h < 0.0)
}

/// The part of a triangle that lies in a plane, by the heights of its corners over the plane, which are not all 0.
fn piece(triangle: &Triangle, heights: &[f64; 3]) -> [Vector; 2] {
    let mut found = [None; 2];
    let mut add = |point| {
        if found[0].is_none() {
            found[0] = Some(point);
        } else {
            found[1] = Some(point);
        }
    };
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        if heights[i] == 0.0 {
            add(triangle[i]);
        } else if heights[j] != 0.0 && (heights[i] < 0.0) != (heights[j] < 0.0) {
            add(triangle[i]
                + (triangle[j] - triangle[i]) * (heights[i] / (heights[i] - heights[j])));
        }
    }
    let first = found[0].unwrap_or(triangle[0]);
    [first, found[1].unwrap_or(first)]
}

/// The common part of two segments of one line.
fn overlap(a: &[Vector; 2], b: &[Vector; 2], rounding: f64) -> Option<[Vector; 2]> {
    let (along_a, along_b) = (a[1] - a[0], b[1] - b[0]);
    let along = if along_a.norm_squared() >= along_b.norm_squared() {
        along_a
    } else {
        along_b
    };
    let length = along.norm();
    if length <= rounding {
        return ((a[0] - b[0]).norm() <= 2.0 * rounding).then_some([a[0], a[0]]);
    }
    let place = |p: &Vector| (p - a[0]).dot(&along) / length;
    let sorted = |s: &[Vector; 2]| {
        let [p, q] = s.map(|p| (place(&p), p));
        if p.0 <= q.0 { [p, q] } else { [q, p] }
    };
    let (a, b) = (sorted(a), sorted(b));
    let from = if a[0].0 >= b[0].0 { a[0] } else { b[0] };
    let to = if a[1].0 <= b[1].0 { a[1] } else { b[1] };
    (from.0 <= to.0 + rounding).then_some([from.1, if from.0 <= to.0 { to.1 } else { from.1 }])
}

/// Whether no line in the plane separates two flat things.
fn overlap_in_plane(a: &Triangle, b: &Triangle, normal: &Vector) -> bool {
    let edges = |t: &Triangle| [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    edges(a).iter().chain(&edges(b)).all(|edge| {
        let axis = normal.cross(edge);
        let [a, b] = [a, b].map(|t| t.map(|p| p.dot(&axis)));
        let (low_a, high_a) = (a[0].min(a[1]).min(a[2]), a[0].max(a[1]).max(a[2]));
        let (low_b, high_b) = (b[0].min(b[1]).min(b[2]), b[0].max(b[1]).max(b[2]));
        let rounding = ROUNDING
            * (low_a
                .abs()
                .max(high_a.abs())
                .max(low_b.abs())
                .max(high_b.abs()));
        low_a <= high_b + rounding && low_b <= high_a + rounding
    })
}
