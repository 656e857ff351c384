//! From the geometry of a shape to rapier's colliders.
//!
//! Primitives become their analytic forms, convex meshes hulls, other meshes triangle meshes; a dynamic mesh that is not convex is
//! decomposed into convex pieces, because triangles have no inside.

#[cfg(test)]
mod tests;

use geometry::Mesh;
use geometry::PrimitiveKind;
use rapier3d_f64::math::{Pose as EnginePose, Rotation, Vector};
use rapier3d_f64::parry::shape::ConvexPolyhedron;
use rapier3d_f64::prelude::SharedShape;

use super::form_maker::Making;
use super::hull_shape::hull_shape;
use super::made_forms::Forms;
use crate::convert::{to_pose, to_vector};
use crate::plan::PartForm;
use scene::shape::Primitive;

/// Smallest thickness of a collider, metres.
const MIN_THICKNESS: f64 = 0.0001;
/// Largest number of convex forms of a shape that are colliders of their own.
const MAX_SEPARATE_FORMS: usize = 8;
/// Sizes of meshes that collide, metres; smaller and larger ones collide with nothing.
const MESH_SIZES: std::ops::Range<f64> = 1e-6..1e6;

/// Forms of one part, placed in the shape frame; those of meshes were made. Empty when the part has no volume and no surface.
pub(super) fn forms(
    part: &PartForm,
    dynamic: bool,
    made: &Forms,
) -> Vec<(EnginePose, SharedShape)> {
    let frame = to_pose(&part.pose);
    if let Some(form) = part.primitive.as_ref().and_then(analytic) {
        return vec![(frame * form.0, form.1)];
    }
    let made = made_of(part, dynamic)
        .iter()
        .find_map(|making| made.form_of(&part.mesh, *making));
    made.map(|form| vec![(frame, form)]).unwrap_or_default()
}

/// What may have been made of the mesh of a part: the first of it is its form. What [`making`] finds by the size of the mesh shows in what there is.
fn made_of(part: &PartForm, dynamic: bool) -> &'static [Making] {
    match (part.convex, dynamic && part.primitive.is_none()) {
        (true, _) => &[Making::Hull],
        (false, true) => &[Making::Pieces, Making::Surface],
        (false, false) => &[Making::Surface],
    }
}

/// The exact form of a primitive, where rapier has one.
fn analytic(primitive: &Primitive) -> Option<(EnginePose, SharedShape)> {
    let [x, y, z] = primitive.size.map(|extent| extent.max(MIN_THICKNESS) / 2.0);
    let round = (x + y) / 2.0;
    let upright = EnginePose::from_rotation(Rotation::from_rotation_x(std::f64::consts::FRAC_PI_2));
    Some(match primitive.kind {
        PrimitiveKind::Cuboid => (EnginePose::IDENTITY, SharedShape::cuboid(x, y, z)),
        PrimitiveKind::Plane => (
            EnginePose::IDENTITY,
            SharedShape::cuboid(x, y, MIN_THICKNESS / 2.0),
        ),
        PrimitiveKind::Disc => (upright, SharedShape::cylinder(MIN_THICKNESS / 2.0, round)),
        PrimitiveKind::Spheroid => (EnginePose::IDENTITY, SharedShape::ball(round)),
        PrimitiveKind::Cylinder => (upright, SharedShape::cylinder(z, round)),
        PrimitiveKind::Cone => (upright, SharedShape::cone(z, round)),
        PrimitiveKind::Capsule => (
            EnginePose::IDENTITY,
            SharedShape::capsule_z((z - round).max(0.0), round),
        ),
        PrimitiveKind::Heightfield => return None,
    })
}

/// What is to be made of the mesh of a part that collides; None where its form is analytic, or there is none.
pub(super) fn making(part: &PartForm, dynamic: bool) -> Option<Making> {
    if part.primitive.as_ref().and_then(analytic).is_some() || part.mesh.vertices.len() < 3 {
        return None;
    }
    let extents = extents(&part.mesh).filter(has_size)?;
    Some(if part.convex {
        Making::Hull
    } else if dynamic && part.primitive.is_none() && has_volume(&extents) {
        Making::Pieces
    } else {
        Making::Surface
    })
}

/// The convex hull of a mesh; None where it has no volume.
pub(super) fn hull(mesh: &Mesh) -> Option<SharedShape> {
    ConvexPolyhedron::from_convex_hull(&points(mesh)).map(hull_shape)
}

/// The triangles of a mesh.
pub(super) fn surface(mesh: &Mesh) -> Option<SharedShape> {
    SharedShape::trimesh(points(mesh), mesh.triangles.clone()).ok()
}

pub(super) fn points(mesh: &Mesh) -> Vec<Vector> {
    let vertices = mesh.vertices.iter();
    vertices.map(|&vertex| to_vector(vertex)).collect()
}

/// Of the box around a mesh, metres.
fn extents(mesh: &Mesh) -> Option<[f64; 3]> {
    let (low, high) = mesh.aabb()?;
    Some([0, 1, 2].map(|axis| high[axis] - low[axis]))
}

/// Whether the geometry of a mesh can be computed with.
fn has_size(extents: &[f64; 3]) -> bool {
    MESH_SIZES.contains(&extents.iter().copied().fold(0.0, f64::max))
}

/// Flat meshes cannot be decomposed.
fn has_volume(extents: &[f64; 3]) -> bool {
    extents.iter().all(|extent| *extent > MIN_THICKNESS)
}

/// The same forms, but the convex ones as one where several are turned, or where there are many: rapier tests each pair of colliders in each sub-step, and two
/// neighbours of a robot whose links have fifty parts each are 2500 pairs. A collider that is turned cannot be without mass to the last digit either (see
/// [`carrier`](super::mass::carrier)).
pub(super) fn with_few_colliders(
    forms: Vec<(EnginePose, SharedShape)>,
) -> Vec<(EnginePose, SharedShape)> {
    let is_turned = |pose: &EnginePose| pose.rotation != EnginePose::IDENTITY.rotation;
    let turned = forms.iter().filter(|(pose, _)| is_turned(pose)).count();
    if turned < 2 && forms.len() <= MAX_SEPARATE_FORMS {
        return forms;
    }
    let (mut parts, mut surfaces) = (Vec::new(), Vec::new());
    for (pose, form) in forms {
        match form.as_compound() {
            Some(group) => {
                let placed = group.shapes().iter();
                parts.extend(placed.map(|(place, part)| (pose * *place, part.clone())));
            }
            None if form.is_convex() => parts.push((pose, form)),
            None => surfaces.push((pose, form)),
        }
    }
    if !parts.is_empty() {
        surfaces.insert(0, (EnginePose::IDENTITY, SharedShape::compound(parts)));
    }
    surfaces
}
