//! The things that a tree is over, and how pairs of them are compared.

use crate::mesh::TriangleMesh;
use crate::placed::Transform;
use crate::points::PointSet;
use crate::primitive::{
    Pair, SolidBox, Triangle, Vector, closest_on_triangle, closest_on_triangles, pair, triangles_touch,
};
use crate::tree::Tree;
use crate::voxels::VoxelGrid;

/// A tree and the things in its leaves, in the order of the tree.
pub(crate) trait Items {
    type Item;

    fn tree(&self) -> &Tree;
    fn item(&self, i: usize) -> Self::Item;
}

/// Things of one kind compared with things of another kind, `other` in a frame at `place`. Points are in the first one's frame.
pub(crate) trait Compare<Other> {
    fn closest(&self, other: &Other, place: &Transform) -> Pair;

    fn touches(&self, other: &Other, place: &Transform) -> bool {
        self.closest(other, place).2 == 0.0
    }
}

impl Items for TriangleMesh {
    type Item = Triangle;

    fn tree(&self) -> &Tree {
        &self.tree
    }

    fn item(&self, i: usize) -> Triangle {
        self.triangles[i]
    }
}

impl Items for VoxelGrid {
    type Item = SolidBox;

    fn tree(&self) -> &Tree {
        &self.tree
    }

    fn item(&self, i: usize) -> SolidBox {
        self.cell(i)
    }
}

impl Items for PointSet {
    type Item = Vector;

    fn tree(&self) -> &Tree {
        &self.tree
    }

    fn item(&self, i: usize) -> Vector {
        self.points[i]
    }
}

impl Compare<Triangle> for Triangle {
    fn closest(&self, other: &Triangle, place: &Transform) -> Pair {
        closest_on_triangles(self, &other.map(|p| place.point(&p)))
    }

    fn touches(&self, other: &Triangle, place: &Transform) -> bool {
        triangles_touch(self, &other.map(|p| place.point(&p)))
    }
}

impl Compare<SolidBox> for Triangle {
    fn closest(&self, other: &SolidBox, place: &Transform) -> Pair {
        let back = place.inverse();
        let (q, p, squared) = other.closest_to_triangle(&self.map(|p| back.point(&p)));
        (place.point(&p), place.point(&q), squared)
    }
}

impl Compare<Vector> for Triangle {
    fn closest(&self, other: &Vector, place: &Transform) -> Pair {
        let point = place.point(other);
        pair(closest_on_triangle(&point, self), point)
    }
}

impl Compare<SolidBox> for SolidBox {
    fn closest(&self, other: &SolidBox, place: &Transform) -> Pair {
        self.closest_to_placed(other, place)
    }
}

impl Compare<Vector> for SolidBox {
    fn closest(&self, other: &Vector, place: &Transform) -> Pair {
        let point = place.point(other);
        pair(self.closest_to_point(&point), point)
    }
}

impl Compare<Vector> for Vector {
    fn closest(&self, other: &Vector, place: &Transform) -> Pair {
        pair(*self, place.point(other))
    }
}
