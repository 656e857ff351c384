//! Nodes of two trees whose frames are turned against each other.

use nalgebra::Matrix3;

use crate::bounds::Bounds;
use crate::placed::Transform;
use crate::primitive::Vector;
use crate::tree::{Node, Tree};

/// The largest rounding error of a transformed point, as a fraction of the coordinates.
const ROUNDING: f64 = 4e-15;

/// Two trees, the second one in a frame at a place in the first one's frame.
pub(crate) struct NodePairs<'a> {
    trees: [&'a Tree; 2],
    /// From the frame of the second tree to the first one's, and back; then the rotations with positive entries.
    places: [Transform; 2],
    turns: [Matrix3<f64>; 2],
    /// Boxes touch below this square of a gap (m²), which rounding may make of nothing.
    rounding: f64,
}

/// The tree to descend in, with the children of its node.
pub(crate) enum Side {
    A([u32; 2]),
    B([u32; 2]),
}

impl<'a> NodePairs<'a> {
    pub fn new(a: &'a Tree, b: &'a Tree, place: &Transform) -> Self {
        let places = [*place, place.inverse()];
        let largest = |tree: &Tree| Vector::from(tree.bounds().min).amax().max(Vector::from(tree.bounds().max).amax());
        let rounding = ROUNDING * (largest(a) + largest(b) + place.translation.amax());
        Self { trees: [a, b], places, turns: places.map(|place| place.rotation.abs()), rounding: rounding * rounding }
    }

    fn nodes(&self, nodes: [u32; 2]) -> [&'a Node; 2] {
        [&self.trees[0].nodes[nodes[0] as usize], &self.trees[1].nodes[nodes[1] as usize]]
    }

    /// The children of the larger node, or of the one that has some; `None` for two leaves.
    pub fn larger(&self, nodes: [u32; 2]) -> Option<Side> {
        let [a, b] = self.nodes(nodes);
        match (a.is_leaf(), b.is_leaf()) {
            (true, true) => None,
            (false, true) => Some(Side::A(self.trees[0].children(a))),
            (true, false) => Some(Side::B(self.trees[1].children(b))),
            _ if a.bounds.half_area() >= b.bounds.half_area() => Some(Side::A(self.trees[0].children(a))),
            _ => Some(Side::B(self.trees[1].children(b))),
        }
    }

    /// Whether the boxes of two nodes may have a point in common.
    pub fn overlap(&self, nodes: [u32; 2]) -> bool {
        self.distance_squared(nodes) <= self.rounding
    }

    /// A lower bound of the square of the distance (m²): along the axes of both frames.
    pub fn distance_squared(&self, nodes: [u32; 2]) -> f64 {
        let [a, b] = self.nodes(nodes);
        let in_a = gap(&a.bounds, &b.bounds, &self.places[0], &self.turns[0]);
        let in_b = gap(&b.bounds, &a.bounds, &self.places[1], &self.turns[1]);
        in_a.norm_squared().max(in_b.norm_squared())
    }
}

/// The gap along each axis between a box and another one, which is turned and moved before.
fn gap(fixed: &Bounds, moved: &Bounds, place: &Transform, turn: &Matrix3<f64>) -> Vector {
    let centre = place.point(&moved.centre().into());
    let reach = turn * Vector::from(moved.half_size()) + Vector::from(fixed.half_size());
    let apart = (centre - Vector::from(fixed.centre())).abs() - reach;
    apart.map(|x| if x > 0.0 { x } else { 0.0 })
}
