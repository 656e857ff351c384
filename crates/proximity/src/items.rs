//! The things that a tree is over, and how pairs of them are compared.

use crate::mesh::{SolidMesh, TriangleMesh};
use crate::oriented::OrientedBox;
use crate::placed::Transform;
use crate::points::PointSet;
use crate::primitive::{
    Pair, SolidBox, Triangle, Vector, closest_on_triangle, closest_on_triangles, pair,
    triangles_touch,
};
use crate::tree::Tree;
use crate::voxels::VoxelGrid;

/// A tree and the things in its leaves, in the order of the tree.
pub(crate) trait Items {
    type Item;

    fn tree(&self) -> &Tree;
    fn item(&self, i: usize) -> Self::Item;

    /// A box around a node.
    fn oriented_box(&self, node: u32) -> OrientedBox {
        OrientedBox::upright(&self.tree().nodes[node as usize].bounds)
    }
}

/// Things of one kind compared with things of another kind in a frame that is somewhere else. Points are in the first one's frame.
pub(crate) trait Compare<Other> {
    /// A thing of the other kind with what is computed once for many comparisons.
    type Moved;

    fn moved(other: &Other, place: &Transform) -> Self::Moved;

    fn closest(&self, other: &Self::Moved) -> Pair;

    fn touches(&self, other: &Self::Moved) -> bool {
        self.closest(other).2 == 0.0
    }

    /// A quick lower bound of the distance: the gap along a direction of unit length that leads from the first to the other thing, or along
    /// another one.
    fn lower_bound(&self, _other: &Self::Moved, _direction: &Vector) -> f64 {
        f64::NEG_INFINITY
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

    #[inline]
    fn oriented_box(&self, node: u32) -> OrientedBox {
        self.oriented_boxes()[node as usize]
    }
}

impl Items for SolidMesh {
    type Item = SolidBox;

    fn tree(&self) -> &Tree {
        &self.tree
    }

    fn item(&self, _: usize) -> SolidBox {
        self.solid
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
    type Moved = Triangle;

    #[inline]
    fn moved(other: &Triangle, place: &Transform) -> Triangle {
        other.map(|p| place.point(&p))
    }

    fn closest(&self, other: &Triangle) -> Pair {
        closest_on_triangles(self, other)
    }

    fn touches(&self, other: &Triangle) -> bool {
        triangles_touch(self, other)
    }

    #[inline]
    fn lower_bound(&self, other: &Triangle, direction: &Vector) -> f64 {
        let [own, others] = [self, other].map(|triangle| triangle.map(|p| p.dot(direction)));
        others[0].min(others[1]).min(others[2]) - own[0].max(own[1]).max(own[2])
    }
}

impl Compare<SolidBox> for Triangle {
    /// From the frame of the box to the triangle's and back.
    type Moved = (SolidBox, [Transform; 2]);

    fn moved(other: &SolidBox, place: &Transform) -> Self::Moved {
        (*other, [*place, place.inverse()])
    }

    fn closest(&self, (other, [forth, back]): &Self::Moved) -> Pair {
        let (q, p, squared) = other.closest_to_triangle(&self.map(|p| back.point(&p)));
        (forth.point(&p), forth.point(&q), squared)
    }

    /// The other direction leads from the middle of the triangle to the box.
    #[inline]
    fn lower_bound(&self, (other, [forth, back]): &Self::Moved, direction: &Vector) -> f64 {
        let centre = forth.point(&other.centre);
        let gap = |direction: &Vector| {
            let reach = forth.rotation.tr_mul(direction).abs().dot(&other.half);
            let own = self.map(|p| p.dot(direction));
            centre.dot(direction) - reach - own[0].max(own[1]).max(own[2])
        };
        let middle = (self[0] + self[1] + self[2]) / 3.0;
        let to_box = forth.point(&other.closest_to_point(&back.point(&middle))) - middle;
        gap(direction).max(
            to_box
                .try_normalize(0.0)
                .map_or(f64::NEG_INFINITY, |direction| gap(&direction)),
        )
    }
}

impl Compare<Vector> for Triangle {
    type Moved = Vector;

    fn moved(other: &Vector, place: &Transform) -> Vector {
        place.point(other)
    }

    fn closest(&self, other: &Vector) -> Pair {
        pair(closest_on_triangle(other, self), *other)
    }
}

impl Compare<SolidBox> for SolidBox {
    type Moved = (SolidBox, Transform);

    fn moved(other: &SolidBox, place: &Transform) -> Self::Moved {
        (*other, *place)
    }

    fn closest(&self, (other, place): &Self::Moved) -> Pair {
        self.closest_to_placed(other, place)
    }
}

impl Compare<Vector> for SolidBox {
    type Moved = Vector;

    fn moved(other: &Vector, place: &Transform) -> Vector {
        place.point(other)
    }

    fn closest(&self, other: &Vector) -> Pair {
        pair(self.closest_to_point(other), *other)
    }
}

impl Compare<Vector> for Vector {
    type Moved = Vector;

    fn moved(other: &Vector, place: &Transform) -> Vector {
        place.point(other)
    }

    fn closest(&self, other: &Vector) -> Pair {
        pair(*self, *other)
    }
}
