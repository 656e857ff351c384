//! Queries against closed forms and against plain loops.

mod bad_input;
mod bounds_tree;
mod brute_force;
mod closed_forms;
mod primitives;
mod random;
mod voxels;

use geometry::primitive::tessellate;
use geometry::{Pose, PrimitiveKind};

use crate::{Geometry, Placed, TriangleMesh};

pub fn primitive(kind: PrimitiveKind, size: f64) -> TriangleMesh {
    let mesh = tessellate(kind, [size; 3], false).expect("finite extents");
    TriangleMesh::new(&mesh.vertices, &mesh.triangles).expect("triangles with area")
}

pub fn cube(size: f64) -> TriangleMesh {
    primitive(PrimitiveKind::Cuboid, size)
}

pub fn at(mesh: &TriangleMesh, x: f64, y: f64, z: f64) -> Placed<'_> {
    Placed {
        geometry: Geometry::Mesh(mesh),
        pose: Pose::translation(x, y, z),
    }
}

pub fn point(x: f64, y: f64, z: f64) -> Placed<'static> {
    Placed {
        geometry: Geometry::Point,
        pose: Pose::translation(x, y, z),
    }
}

#[track_caller]
pub fn close(a: &[f64], b: &[f64], tolerance: f64) {
    let is_close = a.len() == b.len() && a.iter().zip(b).all(|(x, y)| (x - y).abs() <= tolerance);
    assert!(is_close, "{a:?} is not {b:?}");
}
