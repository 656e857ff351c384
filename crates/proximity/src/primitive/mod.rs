//! Distances and intersections of single triangles, segments, boxes and points. No trees.
//!
//! Everything is closed and exact up to rounding: no iteration.

mod boxes;
mod crossing;
mod segment;
mod triangle;

pub use boxes::SolidBox;
pub(crate) use boxes::clip;
pub use crossing::{segments_of_triangles, triangles_touch};
pub use segment::{closest_on_segment, closest_on_segments};
pub use triangle::{closest_on_triangle, closest_on_triangles};

use nalgebra::Vector3;

/// A point or a direction.
pub type Vector = Vector3<f64>;

/// The corners of a triangle, counter-clockwise seen from the side that its normal points to. Corners may coincide: such a triangle
/// is a segment or a point.
pub type Triangle = [Vector; 3];

/// Two points, the first on the first thing, and the square of their distance (m²).
pub type Pair = (Vector, Vector, f64);

/// The pair with the smaller distance; the first where they are equal.
#[inline]
pub(crate) fn nearer(best: Pair, other: Pair) -> Pair {
    if other.2 < best.2 { other } else { best }
}

#[inline]
pub(crate) fn pair(a: Vector, b: Vector) -> Pair {
    (a, b, (b - a).norm_squared())
}

#[inline]
pub(crate) fn swapped((a, b, squared): Pair) -> Pair {
    (b, a, squared)
}
