//! The distance between two geometries.
//!
//! Both trees are descended together, the pair of nodes with the smallest lower bound first (S. Quinlan, *Efficient distance computation
//! between non-convex objects*, 1994).

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use nalgebra::Point3;

use crate::items::{Compare, Items};
use crate::mesh::TriangleMesh;
use crate::node_pair::{NodePairs, Side};
use crate::placed::{Geometry, Placed, Transform};
use crate::points::ORIGIN;
use crate::primitive::{Pair, Vector};

/// From so many triangles on, a box that they are compared with is taken for a solid one.
const MIN_TRIANGLES_FOR_SOLID: usize = 64;

/// The closest points of two geometries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// On the first and on the second geometry, in the world.
    pub points: [[f64; 3]; 2],
    /// Between the points (m); 0 where the geometries intersect, and the points are one then.
    pub distance: f64,
}

/// The distance between two geometries where it is smaller than `below` (m, may be infinite).
///
/// Meshes are surfaces: what is inside of a closed one has a distance to it. Voxels are solid. `None` where nothing is that close, and
/// where a pose or `below` is not a number.
pub fn distance(a: Placed, b: Placed, below: f64) -> Option<Closest> {
    if rank(&a.geometry) > rank(&b.geometry) {
        let Closest {
            points: [of_b, of_a],
            distance,
        } = distance(b, a, below)?;
        return Some(Closest {
            points: [of_a, of_b],
            distance,
        });
    }
    let place = a.relative(&b.pose)?;
    let (p, q, squared) = closest(a.geometry, b.geometry, &place, below)?;
    let world = |p| a.pose.transform_point(&Point3::from(p)).coords.into();
    Some(Closest {
        points: [world(p), world(q)],
        distance: squared.sqrt(),
    })
}

/// Pairs of kinds are compared in one order only.
fn rank(geometry: &Geometry) -> usize {
    match geometry {
        Geometry::Mesh(mesh) if mesh.solid().is_none() => 0,
        Geometry::Mesh(_) => 1,
        Geometry::Voxels(_) => 2,
        Geometry::Points(_) | Geometry::Point => 3,
    }
}

fn closest(a: Geometry, b: Geometry, place: &Transform, below: f64) -> Option<Pair> {
    match (a, b) {
        (Geometry::Point, b) => closest(Geometry::Points(&ORIGIN), b, place, below),
        (a, Geometry::Point) => closest(a, Geometry::Points(&ORIGIN), place, below),
        (Geometry::Mesh(a), Geometry::Mesh(b)) => closest_meshes(a, b, place, below),
        (Geometry::Mesh(a), Geometry::Voxels(b)) => closest_items(a, b, place, below),
        (Geometry::Mesh(a), Geometry::Points(b)) => closest_items(a, b, place, below),
        (Geometry::Voxels(a), Geometry::Voxels(b)) => closest_items(a, b, place, below),
        (Geometry::Voxels(a), Geometry::Points(b)) => closest_items(a, b, place, below),
        (Geometry::Points(a), Geometry::Points(b)) => closest_items(a, b, place, below),
        _ => None,
    }
}

/// Meshes that are surfaces of boxes are compared with as solid ones, as long as nothing is inside.
fn closest_meshes(
    a: &TriangleMesh,
    b: &TriangleMesh,
    place: &Transform,
    below: f64,
) -> Option<Pair> {
    if let Some(solid) = b.solid().filter(|_| a.len() >= MIN_TRIANGLES_FOR_SOLID) {
        match closest_items(a, solid, place, below) {
            Some((.., squared)) if squared <= 0.0 => (),
            found => return found,
        }
    }
    closest_items(a, b, place, below)
}

/// Two nodes and the square of a lower bound of their distance.
struct Candidate {
    bound: f64,
    nodes: [u32; 2],
}

impl Ord for Candidate {
    /// The smallest bound is the greatest candidate; equal ones are in the order of the nodes.
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .bound
            .total_cmp(&self.bound)
            .then_with(|| other.nodes.cmp(&self.nodes))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Candidate {}

fn closest_items<A, B>(a: &A, b: &B, place: &Transform, below: f64) -> Option<Pair>
where
    A: Items,
    B: Items,
    A::Item: Compare<B::Item>,
{
    let limit = if below > 0.0 {
        below * below
    } else {
        return None;
    };
    let pairs = NodePairs::new(a, b, place);
    let mut search = Search {
        pairs,
        waiting: BinaryHeap::new(),
        limit,
        best: None,
        across: Vector::zeros(),
    };
    search.put([0, 0], search.pairs.distance_squared([0, 0]));
    while let Some(Candidate { bound, nodes }) = search.waiting.pop() {
        if bound >= search.limit {
            break;
        }
        search.open(nodes);
    }
    search.best
}

/// The state of a descent.
struct Search<'a, A, B> {
    pairs: NodePairs<'a, A, B>,
    waiting: BinaryHeap<Candidate>,
    /// Square of the distance that a pair must be nearer than.
    limit: f64,
    best: Option<Pair>,
    /// The direction from the best pair's first point to the second one: nearly that of the gap between other close pairs.
    across: Vector,
}

impl<A, B> Search<'_, A, B>
where
    A: Items,
    B: Items,
    A::Item: Compare<B::Item>,
{
    /// Puts the children of one node in the place of a pair, or compares what is in two leaves.
    fn open(&mut self, nodes: [u32; 2]) {
        let [a, b] = nodes;
        match self.pairs.larger(nodes) {
            Some(Side::A([first, second])) => {
                let bounds = self.pairs.distances_squared([first, second], b);
                self.put([first, b], bounds[0]);
                self.put([second, b], bounds[1]);
            }
            Some(Side::B(children)) => {
                children.into_iter().for_each(|child| {
                    self.put([a, child], self.pairs.distance_squared([a, child]));
                });
            }
            None => self.compare_leaves(nodes),
        }
    }

    fn put(&mut self, nodes: [u32; 2], bound: f64) {
        if bound < self.limit {
            self.waiting.push(Candidate { bound, nodes });
        }
    }

    /// Looks at all pairs of the things in two leaves.
    fn compare_leaves(&mut self, leaves: [u32; 2]) {
        let NodePairs { a, b, place, .. } = self.pairs;
        let [items_a, items_b] = self.pairs.items(leaves);
        let across = self.across;
        for j in items_b {
            let other = A::Item::moved(&b.item(j), &place);
            for i in items_a.clone() {
                let item = a.item(i);
                let gap = item.lower_bound(&other, &across);
                if gap <= 0.0 || gap * gap < self.limit {
                    self.offer(item.closest(&other));
                }
            }
        }
    }

    fn offer(&mut self, pair: Pair) {
        if pair.2 < self.limit {
            (self.limit, self.best) = (pair.2, Some(pair));
            self.across = (pair.1 - pair.0).try_normalize(0.0).unwrap_or_default();
        }
    }
}
