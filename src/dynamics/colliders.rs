//! From the geometry of a shape to rapier's colliders.
//!
//! Primitives become their analytic forms, convex meshes hulls, other meshes triangle meshes; a dynamic mesh that is not convex is
//! decomposed into convex pieces, because triangles have no inside.

use rapier3d_f64::math::{Pose as EnginePose, Rotation, Vector};
use rapier3d_f64::prelude::SharedShape;

use super::convert::{to_pose, to_vector};
use super::plan::PartForm;
use crate::scene::mesh::Mesh;
use crate::scene::primitive::PrimitiveKind;
use crate::scene::shape::Primitive;

/// The smallest thickness of anything, metres.
const THIN: f64 = 0.0001;

/// Forms of one part, placed in the shape frame. Empty when the part has no volume and no surface.
pub(super) fn forms(part: &PartForm, dynamic: bool) -> Vec<(EnginePose, SharedShape)> {
    let frame = to_pose(&part.pose);
    if let Some(form) = part.primitive.as_ref().and_then(analytic) {
        return vec![(frame * form.0, form.1)];
    }
    mesh_form(part, dynamic).map(|form| vec![(frame, form)]).unwrap_or_default()
}

/// The exact form of a primitive, where rapier has one.
fn analytic(primitive: &Primitive) -> Option<(EnginePose, SharedShape)> {
    let [x, y, z] = primitive.size.map(|extent| extent.max(THIN) / 2.0);
    let round = (x + y) / 2.0;
    let upright = EnginePose::from_rotation(Rotation::from_rotation_x(std::f64::consts::FRAC_PI_2));
    Some(match primitive.kind {
        PrimitiveKind::Cuboid => (EnginePose::IDENTITY, SharedShape::cuboid(x, y, z)),
        PrimitiveKind::Plane => (EnginePose::IDENTITY, SharedShape::cuboid(x, y, THIN / 2.0)),
        PrimitiveKind::Disc => (upright, SharedShape::cylinder(THIN / 2.0, round)),
        PrimitiveKind::Spheroid => (EnginePose::IDENTITY, SharedShape::ball(round)),
        PrimitiveKind::Cylinder => (upright, SharedShape::cylinder(z, round)),
        PrimitiveKind::Cone => (upright, SharedShape::cone(z, round)),
        PrimitiveKind::Capsule => (EnginePose::IDENTITY, SharedShape::capsule_z((z - round).max(0.0), round)),
        PrimitiveKind::Heightfield => return None,
    })
}

fn mesh_form(part: &PartForm, dynamic: bool) -> Option<SharedShape> {
    let points: Vec<Vector> = part.mesh.vertices.iter().map(|&vertex| to_vector(vertex)).collect();
    if points.len() < 3 {
        return None;
    }
    if part.convex {
        return SharedShape::convex_hull(&points).or_else(|| surface(points, &part.mesh));
    }
    if dynamic && part.primitive.is_none() && has_volume(&part.mesh) {
        return Some(SharedShape::convex_decomposition(&points, &part.mesh.triangles));
    }
    surface(points, &part.mesh)
}

fn surface(points: Vec<Vector>, mesh: &Mesh) -> Option<SharedShape> {
    SharedShape::trimesh(points, mesh.triangles.clone()).ok()
}

/// Flat meshes cannot be decomposed.
fn has_volume(mesh: &Mesh) -> bool {
    mesh.aabb().is_some_and(|(low, high)| (0..3).all(|axis| high[axis] - low[axis] > THIN))
}
