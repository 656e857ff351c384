//! Points and segments.

use super::{Pair, Vector, nearer, pair};

/// Below this sine squared between two segments, their ends are compared too, since rounding decides where the lines are closest.
const NEARLY_PARALLEL: f64 = 1e-20;

/// The point of the segment from `a` to `b` that is closest to `p`.
#[inline]
pub fn closest_on_segment(p: &Vector, a: &Vector, b: &Vector) -> Vector {
    let along = b - a;
    let [offset, length] = [(p - a).dot(&along), along.norm_squared()];
    if offset <= 0.0 {
        *a
    } else if offset >= length {
        *b
    } else {
        a + along * (offset / length)
    }
}

/// The closest points of two segments, given by their ends. Segments may have no length.
///
/// The minimum of a quadratic function over a square (V. Lumelsky, *On fast computation of distance between line segments*, 1985).
#[inline]
pub fn closest_on_segments(a: [&Vector; 2], b: [&Vector; 2]) -> Pair {
    let (u, v, w) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let [uu, uv, vv, uw, vw] = [
        u.norm_squared(),
        u.dot(&v),
        v.norm_squared(),
        u.dot(&w),
        v.dot(&w),
    ];
    if uu == 0.0 || vv == 0.0 {
        return closest_of_ends(a, b);
    }
    // Products of vectors lose less than differences of products of numbers.
    let across = u.cross(&v);
    let sine = across.norm_squared();
    let free = if sine > 0.0 {
        (v.cross(&w).dot(&across) / sine).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let t = (uv * free + vw) / vv;
    let (s, t) = if t < 0.0 {
        ((-uw / uu).clamp(0.0, 1.0), 0.0)
    } else if t > 1.0 {
        (((uv - uw) / uu).clamp(0.0, 1.0), 1.0)
    } else {
        (free, t)
    };
    let inner = pair(a[0] + u * s, b[0] + v * t);
    if sine > NEARLY_PARALLEL * uu * vv {
        inner
    } else {
        nearer(inner, closest_of_ends(a, b))
    }
}

/// The closest pair that has an end of one of the segments.
fn closest_of_ends(a: [&Vector; 2], b: [&Vector; 2]) -> Pair {
    let of_a = a.map(|end| pair(*end, closest_on_segment(end, b[0], b[1])));
    let of_b = b.map(|end| pair(closest_on_segment(end, a[0], a[1]), *end));
    nearer(nearer(of_a[0], of_a[1]), nearer(of_b[0], of_b[1]))
}
