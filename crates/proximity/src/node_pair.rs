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
        let largest = |tree: &Tree| Vector::from(tree.bounds().min).amax().max(Vector::from(tree.bounds().max).amax());
        let rounding = ROUNDING * (largest(a.tree()) + largest(b.tree()) + place.translation.amax());
        Self { a, b, place: *place, rounding: rounding * rounding }
    }

    /// The places of the things in two leaves.
    pub fn items(&self, leaves: [u32; 2]) -> [Range<usize>; 2] {
        self.nodes(leaves).map(Node::items)
    }

    fn nodes(&self, nodes: [u32; 2]) -> [&'a Node; 2] {
        [&self.a.tree().nodes[nodes[0] as usize], &self.b.tree().nodes[nodes[1] as usize]]
    }

    /// The children of the larger node, or of the one that has some; `None` for two leaves.
    pub fn larger(&self, nodes: [u32; 2]) -> Option<Side> {
        let [a, b] = self.nodes(nodes);
        match (a.is_leaf(), b.is_leaf()) {
            (true, true) => None,
            (false, true) => Some(Side::A(self.a.tree().children(a))),
            (true, false) => Some(Side::B(self.b.tree().children(b))),
            _ if a.bounds.half_area() >= b.bounds.half_area() => Some(Side::A(self.a.tree().children(a))),
            _ => Some(Side::B(self.b.tree().children(b))),
        }
    }

    /// Whether the boxes of two nodes may have a point in common.
    pub fn overlap(&self, nodes: [u32; 2]) -> bool {
        self.distance_squared(nodes) <= self.rounding
    }

    /// A lower bound of the square of the distance (m²): the gaps along the axes of one box, or along those of the other one.
    pub fn distance_squared(&self, nodes: [u32; 2]) -> f64 {
        let (a, b) = (self.a.oriented_box(nodes[0]), self.b.oriented_box(nodes[1]));
        gap_squared(&a, &b, &self.place)
    }
}

#[inline]
fn gap_squared(a: &OrientedBox, b: &OrientedBox, place: &Transform) -> f64 {
    // The axes of `b` in those of `a`: an entry is the cosine between two.
    let turn: Matrix3<f64> = a.axes.tr_mul(&(place.rotation * b.axes));
    let apart = a.axes.tr_mul(&(place.point(&b.centre) - a.centre));
    let reach = turn.abs();
    let in_a = apart.abs() - a.half - reach * b.half;
    let in_b = turn.tr_mul(&apart).abs() - b.half - reach.tr_mul(&a.half);
    positive_squared(&in_a).max(positive_squared(&in_b))
}

#[inline]
fn positive_squared(gaps: &Vector) -> f64 {
    gaps.iter().map(|x| if *x > 0.0 { x * x } else { 0.0 }).sum()
}
