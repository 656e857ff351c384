//! Nodes of two trees whose frames are turned against each other.

use std::ops::Range;

use nalgebra::Matrix3;

use crate::items::Items;
use crate::oriented::OrientedBox;
use crate::placed::Transform;
use crate::primitive::Vector;
use crate::tree::{Node, Tree};

/// The largest rounding error of a transformed point, as a fraction of the coordinates.
const ROUNDING: f64 = 4e-15;

/// Two trees, the second one in a frame at a place in the first one's frame.
pub(crate) struct NodePairs<'a, A, B> {
    pub a: &'a A,
    pub b: &'a B,
    pub place: Transform,
    /// Boxes touch below this square of a gap (m²), which rounding may make of nothing.
    rounding: f64,
}

/// The tree to descend in, with the children of its node.
pub(crate) enum Side {
    A([u32; 2]),
    B([u32; 2]),
}

impl<'a, A: Items, B: Items> NodePairs<'a, A, B> {
    pub fn new(a: &'a A, b: &'a B, place: &Transform) -> Self {
        let largest = |tree: &Tree| {
            Vector::from(tree.bounds().min)
                .amax()
                .max(Vector::from(tree.bounds().max).amax())
        };
        let rounding =
            ROUNDING * (largest(a.tree()) + largest(b.tree()) + place.translation.amax());
        Self {
            a,
            b,
            place: *place,
            rounding: rounding * rounding,
        }
    }

    /// The places of the things in two leaves.
    pub fn items(&self, leaves: [u32; 2]) -> [Range<usize>; 2] {
        self.nodes(leaves).map(Node::items)
    }

    fn nodes(&self, nodes: [u32; 2]) -> [&'a Node; 2] {
        [
            &self.a.tree().nodes[nodes[0] as usize],
            &self.b.tree().nodes[nodes[1] as usize],
        ]
    }

    /// The children of the larger node, or of the one that has some; `None` for two leaves.
    pub fn larger(&self, nodes: [u32; 2]) -> Option<Side> {
        let [a, b] = self.nodes(nodes);
        match (a.is_leaf(), b.is_leaf()) {
            (true, true) => None,
            (false, true) => Some(Side::A(self.a.tree().children(a))),
            (true, false) => Some(Side::B(self.b.tree().children(b))),
            _ if a.bounds.half_area() >= b.bounds.half_area() => {
                Some(Side::A(self.a.tree().children(a)))
            }
            _ => Some(Side::B(self.b.tree().children(b))),
        }
    }

    /// Whether the boxes of two nodes may have a point in common.
    pub fn overlap(&self, nodes: [u32; 2]) -> bool {
        self.distance_squared(nodes) <= self.rounding
    }

    /// A lower bound of the square of the distance (m²).
    pub fn distance_squared(&self, nodes: [u32; 2]) -> f64 {
        gap_squared(&self.a.oriented_box(nodes[0]), &self.placed_box(nodes[1]))
    }

    /// The same for two nodes of the first tree.
    pub fn distances_squared(&self, nodes: [u32; 2], other: u32) -> [f64; 2] {
        let other = self.placed_box(other);
        nodes.map(|node| gap_squared(&self.a.oriented_box(node), &other))
    }

    /// The box of a node of the second tree, in the first one's frame.
    #[inline]
    fn placed_box(&self, node: u32) -> OrientedBox {
        let own = self.b.oriented_box(node);
        OrientedBox {
            centre: self.place.point(&own.centre),
            axes: self.place.rotation * own.axes,
            half: own.half,
        }
    }
}

/// A lower bound of the square of the distance of two boxes (m²), the largest of four: from the gaps along the axes of either box, and from the
/// gap along the line that leads from either box to the centre of the other one, which is larger where a corner or an edge is closest.
#[inline]
fn gap_squared(a: &OrientedBox, b: &OrientedBox) -> f64 {
    // The axes of `b` in those of `a`: an entry is the cosine between two.
    let turn: Matrix3<f64> = a.axes.tr_mul(&b.axes);
    let reach = turn.abs();
    let in_a = a.axes.tr_mul(&(b.centre - a.centre));
    let in_b = turn.tr_mul(&in_a);
    let along_axes_of_a = positive_squared(&(in_a.abs() - a.half - reach * b.half));
    let along_axes_of_b = positive_squared(&(in_b.abs() - b.half - reach.tr_mul(&a.half)));
    let (from_a, from_b) = (outside(&in_a, &a.half), outside(&in_b, &b.half));
    let along_lines = gap_along(&from_a, &turn.tr_mul(&from_a), b)
        .max(gap_along(&from_b, &(turn * from_b), a))
        .max(0.0);
    along_axes_of_a
        .max(along_axes_of_b)
        .max(along_lines * along_lines)
}

/// The line from the point of a box that is closest to `p` to `p`, both in the axes of the box.
#[inline]
fn outside(p: &Vector, half: &Vector) -> Vector {
    p.zip_map(half, |x, half| x - x.max(-half).min(half))
}

/// The gap between a point and a box along the line to the box's centre. `turned` is the line in the axes of the box. Not a number
/// for a line without length.
#[inline]
fn gap_along(line: &Vector, turned: &Vector, to: &OrientedBox) -> f64 {
    let length = line.norm();
    length - turned.abs().dot(&to.half) / length
}

#[inline]
fn positive_squared(gaps: &Vector) -> f64 {
    gaps.iter()
        .map(|x| if *x > 0.0 { x * x } else { 0.0 })
        .sum()
}
