//! Whether two geometries intersect, and where.

use nalgebra::Point3;

use crate::items::{Compare, Items};
use crate::mesh::TriangleMesh;
use crate::node_pair::{NodePairs, Side};
use crate::placed::{Geometry, Placed, Transform};
use crate::points::ORIGIN;
use crate::primitive::segments_of_triangles;

/// Whether two geometries have a point in common.
///
/// Surfaces with surfaces and with voxels; voxels with everything. Other pairs, and poses that are not finite: `false`. What only touches
/// may be either by rounding.
pub fn intersects(a: Placed, b: Placed) -> bool {
    match (a.geometry, b.geometry) {
        (Geometry::Points(_) | Geometry::Point, Geometry::Voxels(_)) => intersects(b, a),
        (Geometry::Voxels(_), Geometry::Mesh(_)) => intersects(b, a),
        _ => a
            .relative(&b.pose)
            .is_some_and(|place| touch(a.geometry, b.geometry, &place)),
    }
}

fn touch(a: Geometry, b: Geometry, place: &Transform) -> bool {
    match (a, b) {
        (Geometry::Mesh(a), Geometry::Mesh(b)) => items_touch(a, b, place),
        (Geometry::Mesh(a), Geometry::Voxels(b)) => items_touch(a, b, place),
        (Geometry::Voxels(a), Geometry::Voxels(b)) => items_touch(a, b, place),
        (Geometry::Voxels(a), Geometry::Points(b)) => items_touch(a, b, place),
        (Geometry::Voxels(a), Geometry::Point) => items_touch(a, &*ORIGIN, place),
        _ => false,
    }
}

/// The segments in which two meshes intersect, in the world (m). Their union is the whole curve; adjacent triangles contribute a segment each,
/// and a shared edge one per triangle. Places where the meshes only touch, or lie in one plane, have none.
pub fn intersection_segments(a: Placed, b: Placed) -> Vec<[[f64; 3]; 2]> {
    let (Geometry::Mesh(mesh), Geometry::Mesh(other)) = (a.geometry, b.geometry) else {
        return Vec::new();
    };
    let Some(place) = a.relative(&b.pose) else {
        return Vec::new();
    };
    let world = |p| a.pose.transform_point(&Point3::from(p)).coords.into();
    let mut segments = Vec::new();
    overlapping_leaves(mesh, other, &place, |i, j| {
        let moved = other.triangles[j].map(|p| place.point(&p));
        let ends = segments_of_triangles(&mesh.triangles[i], &moved);
        segments.extend(
            ends.filter(|[p, q]| p != q || is_segment(mesh, i) || is_segment(other, j))
                .map(|ends| ends.map(world)),
        );
        false
    });
    segments
}

/// Whether the thing is no triangle but a segment, which meets triangles in points.
fn is_segment(mesh: &TriangleMesh, i: usize) -> bool {
    mesh.triangles[i][1] == mesh.triangles[i][2]
}

fn items_touch<A, B>(a: &A, b: &B, place: &Transform) -> bool
where
    A: Items,
    B: Items,
    A::Item: Compare<B::Item>,
{
    overlapping_leaves(a, b, place, |i, j| {
        a.item(i).touches(&A::Item::moved(&b.item(j), place))
    })
}

/// Visits pairs of things in leaves that overlap, until `visit` returns true. Whether it did.
fn overlapping_leaves<A: Items, B: Items>(
    a: &A,
    b: &B,
    place: &Transform,
    mut visit: impl FnMut(usize, usize) -> bool,
) -> bool {
    let pairs = NodePairs::new(a, b, place);
    let mut open = vec![[0, 0]];
    while let Some(nodes) = open.pop() {
        if !pairs.overlap(nodes) {
            continue;
        }
        match pairs.larger(nodes) {
            Some(Side::A(children)) => open.extend(children.map(|child| [child, nodes[1]])),
            Some(Side::B(children)) => open.extend(children.map(|child| [nodes[0], child])),
            None => {
                let [mut items_a, items_b] = pairs.items(nodes);
                if items_a.any(|i| items_b.clone().any(|j| visit(i, j))) {
                    return true;
                }
            }
        }
    }
    false
}
