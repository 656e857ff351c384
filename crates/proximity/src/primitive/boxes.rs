//! Solid boxes: what is inside has the distance 0.

use geometry::Pose;

use super::{Pair, Triangle, Vector, closest_on_triangle, nearer, pair, swapped};
use crate::placed::Transform;

/// A solid box whose sides are along the axes of its frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidBox {
    /// The middle.
    pub centre: Vector,
    /// Half of the extents (m).
    pub half: Vector,
}

/// The edges of a box, by the signs of their ends.
const EDGES: [[[f64; 3]; 2]; 12] = [
    [[-1., -1., -1.], [1., -1., -1.]],
    [[-1., -1., 1.], [1., -1., 1.]],
    [[-1., 1., -1.], [1., 1., -1.]],
    [[-1., 1., 1.], [1., 1., 1.]],
    [[-1., -1., -1.], [-1., 1., -1.]],
    [[-1., -1., 1.], [-1., 1., 1.]],
    [[1., -1., -1.], [1., 1., -1.]],
    [[1., -1., 1.], [1., 1., 1.]],
    [[-1., -1., -1.], [-1., -1., 1.]],
    [[-1., 1., -1.], [-1., 1., 1.]],
    [[1., -1., -1.], [1., -1., 1.]],
    [[1., 1., -1.], [1., 1., 1.]],
];

impl SolidBox {
    /// The point of the box that is closest to `p`: `p` itself inside.
    #[inline]
    pub fn closest_to_point(&self, p: &Vector) -> Vector {
        self.centre + (p - self.centre).zip_map(&self.half, |x, half| x.max(-half).min(half))
    }

    /// The closest points of the box and a segment, given by its ends.
    pub fn closest_to_segment(&self, from: &Vector, to: &Vector) -> Pair {
        let (start, along) = (from - self.centre, to - from);
        if let Some([enter, leave]) = inside(&start, &along, &self.half) {
            let common = from + along * (0.5 * (enter + leave));
            return (common, common, 0.0);
        }
        let point = from + along * closest_place(&start, &along, &self.half);
        pair(self.closest_to_point(&point), point)
    }

    /// The closest points of the box and a triangle. Where they intersect it is one common point, and the distance is exactly 0.
    pub fn closest_to_triangle(&self, triangle: &Triangle) -> Pair {
        if let Some(common) = self.common_point(triangle) {
            return (common, common, 0.0);
        }
        let edges = [(0, 1), (1, 2), (2, 0)]
            .map(|(i, j)| self.closest_to_segment(&triangle[i], &triangle[j]));
        let on_edges = nearer(nearer(edges[0], edges[1]), edges[2]);
        let corner = self.corner_towards(triangle);
        nearer(
            on_edges,
            pair(corner, closest_on_triangle(&corner, triangle)),
        )
    }

    /// The closest points of two boxes, the other one in a frame at `pose`; both points in the frame of this box.
    pub fn closest_to_box(&self, other: &Self, pose: &Pose) -> Pair {
        self.closest_to_placed(other, &Transform::of(pose))
    }

    pub(crate) fn closest_to_placed(&self, other: &Self, place: &Transform) -> Pair {
        let back = place.inverse();
        let place = |p: Vector| place.point(&p);
        let mut best = pair(self.centre, place(other.centre));
        for ends in other.edges() {
            let [from, to] = ends.map(place);
            best = nearer(best, self.closest_to_segment(&from, &to));
        }
        for ends in self.edges() {
            let [from, to] = ends.map(|p| back.point(&p));
            let (p, q, squared) = swapped(other.closest_to_segment(&from, &to));
            best = nearer(best, (place(p), place(q), squared));
        }
        best
    }

    fn edges(&self) -> [[Vector; 2]; 12] {
        EDGES.map(|ends| {
            ends.map(|signs| self.centre + Vector::from(signs).component_mul(&self.half))
        })
    }

    /// The corner that is nearest to the plane of a triangle.
    fn corner_towards(&self, [a, b, c]: &Triangle) -> Vector {
        let normal = (b - a).cross(&(c - a));
        let above = (self.centre - a).dot(&normal) > 0.0;
        let reach = normal.zip_map(
            &self.half,
            |n, half| if (n > 0.0) == above { -half } else { half },
        );
        self.centre + reach
    }

    /// Whether a side of the box separates it from a triangle.
    #[inline]
    fn is_beside(&self, [a, b, c]: &Triangle) -> bool {
        let (low, high) = (a.inf(b).inf(c) - self.centre, a.sup(b).sup(c) - self.centre);
        (0..3).any(|axis| low[axis] > self.half[axis] || high[axis] < -self.half[axis])
    }

    /// A point of the triangle inside the box.
    fn common_point(&self, triangle: &Triangle) -> Option<Vector> {
        if self.is_beside(triangle) {
            return None;
        }
        let mut polygon = triangle.to_vec();
        let mut clipped = Vec::with_capacity(9);
        for axis in 0..3 {
            for side in [1.0, -1.0] {
                let reach = side * self.centre[axis] + self.half[axis];
                clip(&polygon, |p| side * p[axis] - reach, &mut clipped);
                std::mem::swap(&mut polygon, &mut clipped);
            }
        }
        let sum: Vector = polygon.iter().sum();
        (!polygon.is_empty()).then(|| sum / polygon.len() as f64)
    }
}

/// The part of a polygon where `height` is not positive.
pub(crate) fn clip(polygon: &[Vector], height: impl Fn(&Vector) -> f64, clipped: &mut Vec<Vector>) {
    clipped.clear();
    let Some(last) = polygon.last() else { return };
    let (mut from, mut height_from) = (*last, height(last));
    for to in polygon {
        let height_to = height(to);
        if (height_from <= 0.0) != (height_to <= 0.0) {
            clipped.push(from + (to - from) * (height_from / (height_from - height_to)));
        }
        if height_to <= 0.0 {
            clipped.push(*to);
        }
        (from, height_from) = (*to, height_to);
    }
}

/// Where a segment is inside a box around the origin: from and to which fraction of its length.
fn inside(start: &Vector, along: &Vector, half: &Vector) -> Option<[f64; 2]> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        if along[axis] == 0.0 {
            if start[axis].abs() > half[axis] {
                return None;
            }
            continue;
        }
        let [a, b] = [-half[axis], half[axis]].map(|side| (side - start[axis]) / along[axis]);
        (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    }
    (enter <= leave).then_some([enter, leave])
}

/// Where a segment is closest to a box around the origin that it does not meet, as a fraction of its length: the zero of the derivative of
/// the distance squared, which is monotonous and linear between the planes of the box's faces.
fn closest_place(start: &Vector, along: &Vector, half: &Vector) -> f64 {
    let slope = |t: f64| {
        let excess = (start + along * t).zip_map(half, |x, half| x - x.max(-half).min(half));
        excess.dot(along)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for axis in 0..3 {
        for side in [-half[axis], half[axis]] {
            let t = (side - start[axis]) / along[axis];
            if low < t && t < high {
                *if slope(t) < 0.0 { &mut low } else { &mut high } = t;
            }
        }
    }
    let (at_low, at_high) = (slope(low), slope(high));
    if at_low >= 0.0 {
        low
    } else if at_high <= 0.0 {
        high
    } else {
        low + (high - low) * (at_low / (at_low - at_high))
    }
}
