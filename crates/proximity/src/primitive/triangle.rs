//! Distance of triangles to points and to each other.

use super::{
    Pair, Triangle, Vector, closest_on_segment, closest_on_segments, nearer, pair,
    segments_of_triangles,
};

/// The edges of a triangle, each with the corner opposite of it.
const EDGES: [(usize, usize, usize); 3] = [(0, 1, 2), (1, 2, 0), (2, 0, 1)];

/// The point of a triangle, its inside included, that is closest to `p`.
///
/// Finds the feature whose Voronoi region contains the point (C. Ericson, *Real-Time Collision Detection*, 2004, section 5.1.5).
pub fn closest_on_triangle(p: &Vector, triangle: &Triangle) -> Vector {
    let [a, b, c] = triangle;
    let normal = (b - a).cross(&(c - a));
    let inside = |from: &Vector, to: &Vector| (to - from).cross(&(p - from)).dot(&normal) >= 0.0;
    let squared = normal.norm_squared();
    if squared > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return p - normal * ((p - a).dot(&normal) / squared);
    }
    let on_edges = EDGES.map(|(i, j, _)| closest_on_segment(p, &triangle[i], &triangle[j]));
    let closer = |best: Vector, q: Vector| {
        if (q - p).norm_squared() < (best - p).norm_squared() {
            q
        } else {
            best
        }
    };
    closer(closer(on_edges[0], on_edges[1]), on_edges[2])
}

/// The closest points of two triangles. Intersecting ones have one point in common, and the distance is exactly 0.
pub fn closest_on_triangles(a: &Triangle, b: &Triangle) -> Pair {
    let mut best = (a[0], b[0], f64::INFINITY);
    for (i, j, opposite) in EDGES {
        for (k, l, other) in EDGES {
            let found = closest_on_segments([&a[i], &a[j]], [&b[k], &b[l]]);
            if found.2 >= best.2 {
                continue;
            }
            best = found;
            // Both triangles lie behind the planes through the points, across the line between them: there is nothing closer.
            let across = found.1 - found.0;
            if (a[opposite] - found.0).dot(&across) <= 0.0
                && (b[other] - found.1).dot(&across) >= 0.0
            {
                return best;
            }
        }
    }
    for (p, q) in corners_over_faces(a, b) {
        best = nearer(best, pair(p, q));
    }
    for (q, p) in corners_over_faces(b, a) {
        best = nearer(best, pair(p, q));
    }
    match segments_of_triangles(a, b) {
        Some([p, q]) if best.2 > 0.0 => {
            let common = (p + q) * 0.5;
            (common, common, 0.0)
        }
        _ => best,
    }
}

/// The corners of the first triangle that are above or below the inside of the second one, with the points below them.
fn corners_over_faces(
    corners: &Triangle,
    face: &Triangle,
) -> impl Iterator<Item = (Vector, Vector)> {
    let [a, b, c] = *face;
    let normal = (b - a).cross(&(c - a));
    let squared = normal.norm_squared();
    let inside = move |p: &Vector, from: Vector, to: Vector| {
        (to - from).cross(&(p - from)).dot(&normal) >= 0.0
    };
    corners.iter().filter_map(move |p| {
        let is_over = squared > 0.0 && inside(p, a, b) && inside(p, b, c) && inside(p, c, a);
        is_over.then(|| (*p, p - normal * ((p - a).dot(&normal) / squared)))
    })
}
