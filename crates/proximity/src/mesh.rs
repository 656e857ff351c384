//! Triangle meshes: surfaces without an inside.

use std::sync::OnceLock;

use geometry::MAX_COORDINATE;

use crate::bounds::Bounds;
use crate::oriented::{OrientedBox, boxes_of};
use crate::primitive::{SolidBox, Triangle, Vector};
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
    /// What the surface encloses if it is that of a box along the axes, found when a query first asks.
    solid: OnceLock<Option<Box<SolidMesh>>>,
}

/// A box that a mesh encloses, as the only thing of a tree.
#[derive(Debug, Clone)]
pub(crate) struct SolidMesh {
    pub tree: Tree,
    pub solid: SolidBox,
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
        let kept: Vec<Triangle> = triangles
            .iter()
            .filter_map(corners)
            .filter(has_area)
            .collect();
        Self::of_triangles(&kept)
    }

    /// A mesh of line segments, given by their ends (m): for distances and intersections; rays miss them. Segments whose coordinates are
    /// not finite or beyond 1e30 are left out. `None` when no segment is left.
    pub fn of_segments(segments: &[[[f64; 3]; 2]]) -> Option<Self> {
        let flat = segments
            .iter()
            .map(|[a, b]| [Vector::from(*a), Vector::from(*b), Vector::from(*b)]);
        Self::of_triangles(&flat.filter(is_within_range).collect::<Vec<_>>())
    }

    fn of_triangles(triangles: &[Triangle]) -> Option<Self> {
        if triangles.is_empty() {
            return None;
        }
        let boxes: Vec<Bounds> = triangles.iter().map(bounds_of).collect();
        let (tree, order) = Tree::build(&boxes);
        let triangles = order.into_iter().map(|i| triangles[i as usize]).collect();
        Some(Self {
            triangles,
            tree,
            oriented: OnceLock::new(),
            solid: OnceLock::new(),
        })
    }

    /// The box around all triangles.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }

    #[inline]
    pub(crate) fn oriented_boxes(&self) -> &[OrientedBox] {
        self.oriented
            .get_or_init(|| boxes_of(&self.tree, &self.triangles))
    }

    /// The box whose surface this is; none for other meshes.
    #[inline]
    pub(crate) fn solid(&self) -> Option<&SolidMesh> {
        self.solid
            .get_or_init(|| self.find_solid().map(Box::new))
            .as_deref()
    }

    fn find_solid(&self) -> Option<SolidMesh> {
        let bounds = self.bounds();
        if !is_surface_of(&bounds, &self.triangles) {
            return None;
        }
        let solid = SolidBox {
            centre: bounds.centre().into(),
            half: bounds.half_size().into(),
        };
        Some(SolidMesh {
            tree: Tree::build(&[bounds]).0,
            solid,
        })
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
    let longest = (b - a)
        .norm_squared()
        .max((c - b).norm_squared())
        .max((a - c).norm_squared());
    is_within_range(triangle) && (b - a).cross(&(c - a)).norm() > FLAT * longest
}

fn is_within_range(triangle: &Triangle) -> bool {
    triangle.iter().flatten().all(|x| x.abs() <= MAX_COORDINATE)
}

fn bounds_of(triangle: &Triangle) -> Bounds {
    let [a, b, c] = triangle;
    Bounds {
        min: a.inf(&b.inf(c)).into(),
        max: a.sup(&b.sup(c)).into(),
    }
}

/// Whether triangles are the six sides of a box, two for each. Each triangle of a side leaves one of the side's corners out; both cover the
/// side where these are opposite.
fn is_surface_of(bounds: &Bounds, triangles: &[Triangle]) -> bool {
    if triangles.len() != 12 {
        return false;
    }
    // For each side the corners that its two triangles leave out.
    let mut sides = [[None; 2]; 6];
    for triangle in triangles {
        let Some(corners) = corner_numbers(bounds, triangle) else {
            return false;
        };
        let [shared, any] = [
            corners[0] & corners[1] & corners[2],
            corners[0] | corners[1] | corners[2],
        ];
        let Some(axis) = (0..3).find(|axis| (shared >> axis & 1) == (any >> axis & 1)) else {
            return false;
        };
        let side = &mut sides[2 * axis + (shared >> axis & 1)];
        let Some(place) = side.iter_mut().find(|place| place.is_none()) else {
            return false;
        };
        // The corner that is left out: on each of the other axes both ends occur twice among the four corners.
        *place = Some(corners[0] ^ corners[1] ^ corners[2]);
    }
    let opposite = |axis: usize| !(1 << axis) & 0b111;
    (0..6).all(|side| matches!(sides[side], [Some(a), Some(b)] if a ^ b == opposite(side / 2)))
}

/// Which corners of a box those of a triangle are: bit i says whether it is on the upper side of axis i. None where one is no corner or two
/// are the same.
fn corner_numbers(bounds: &Bounds, triangle: &Triangle) -> Option<[usize; 3]> {
    let mut numbers = [0; 3];
    for (number, corner) in numbers.iter_mut().zip(triangle) {
        for axis in 0..3 {
            match corner[axis] {
                x if x == bounds.max[axis] => *number |= 1 << axis,
                x if x == bounds.min[axis] => (),
                _ => return None,
            }
        }
    }
    let [a, b, c] = numbers;
    (a != b && b != c && c != a).then_some(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_known_by_their_sides() {
        let mesh = geometry::primitive::tessellate(
            geometry::PrimitiveKind::Cuboid,
            [0.1, 0.2, 0.3],
            false,
        )
        .unwrap();
        let solid = |triangles: &[[u32; 3]]| {
            TriangleMesh::new(&mesh.vertices, triangles)
                .unwrap()
                .solid()
                .is_some()
        };
        assert!(solid(&mesh.triangles));
        assert!(!solid(&mesh.triangles[1..]));
        for i in 0..12 {
            // One triangle twice instead of another one.
            let mut triangles = mesh.triangles.clone();
            triangles[i] = triangles[(i + 1) % 12];
            assert!(!solid(&triangles), "{i}");
        }
        let mut moved = mesh.vertices.clone();
        moved[0][0] *= 1.5;
        assert!(
            TriangleMesh::new(&moved, &mesh.triangles)
                .unwrap()
                .solid()
                .is_none()
        );
    }
}
