//! Triangle meshes: surfaces without an inside.

use std::sync::OnceLock;

use geometry::LARGEST_COORDINATE;

use crate::bounds::Bounds;
use crate::oriented::{OrientedBox, boxes_of};
use crate::primitive::{Triangle, Vector};
use crate::tree::Tree;

/// A triangle is flat where its area is below this fraction of its longest edge squared: its normal would be noise.
const FLAT: f64 = 1e-12;

/// A set of triangles with a tree over it. Only the surface counts; nothing is inside.
#[derive(Debug, Clone)]
pub struct TriangleMesh {
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) tree: Tree,
    /// A box per node, made when a query first asks for one: rays need none.
    oriented: OnceLock<Vec<OrientedBox>>,
}

impl TriangleMesh {
    /// A mesh of triangles, each three indices of vertices from 0 (m). The front of a triangle is where it winds counter-clockwise.
    ///
    /// Triangles without area, with indices that do not exist, or with coordinates that are not finite or beyond 1e30 are left out.
    /// `None` when no triangle is left.
    pub fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Option<Self> {
        let corners = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| vertices.get(i as usize).copied().map(Vector::from));
            Some([a?, b?, c?])
        };
        let kept: Vec<Triangle> = triangles.iter().filter_map(corners).filter(has_area).collect();
        Self::of_triangles(&kept)
    }

    /// A mesh of line segments, given by their ends (m): for distances and intersections; rays miss them. Segments whose coordinates are
    /// not finite or beyond 1e30 are left out. `None` when no segment is left.
    pub fn of_segments(segments: &[[[f64; 3]; 2]]) -> Option<Self> {
        let flat = segments.iter().map(|[a, b]| [Vector::from(*a), Vector::from(*b), Vector::from(*b)]);
        Self::of_triangles(&flat.filter(is_within_range).collect::<Vec<_>>())
    }

    fn of_triangles(triangles: &[Triangle]) -> Option<Self> {
        if triangles.is_empty() {
            return None;
        }
        let boxes: Vec<Bounds> = triangles.iter().map(bounds_of).collect();
        let (tree, order) = Tree::build(&boxes);
        let triangles = order.into_iter().map(|i| triangles[i as usize]).collect();
        Some(Self { triangles, tree, oriented: OnceLock::new() })
    }

    /// The box around all triangles.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }

    #[inline]
    pub(crate) fn oriented_boxes(&self) -> &[OrientedBox] {
        self.oriented.get_or_init(|| boxes_of(&self.tree, &self.triangles))
    }

    /// How many triangles there are.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Never: a mesh without triangles cannot be made.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }
}

fn has_area(triangle: &Triangle) -> bool {
    let [a, b, c] = triangle;
    let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
    is_within_range(triangle) && (b - a).cross(&(c - a)).norm() > FLAT * longest
}

fn is_within_range(triangle: &Triangle) -> bool {
    triangle.iter().flatten().all(|x| x.abs() <= LARGEST_COORDINATE)
}

fn bounds_of(triangle: &Triangle) -> Bounds {
    let [a, b, c] = triangle;
    Bounds { min: a.inf(&b.inf(c)).into(), max: a.sup(&b.sup(c)).into() }
}
