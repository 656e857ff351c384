//! Properties of the meshes shapes consist of. Textures are not kept: their properties tell of none.

use super::access::{Accessor, Subject, finite, subject_properties};
use super::{Target, Text};
use crate::scene::mesh::Mesh;
use crate::scene::shape::Part;
use crate::scene::{Field, Object, Uid};
use crate::script::error::{ApiError, ApiResult};
use crate::script::sim::Sim;

impl Sim {
    /// What `read` tells about a mesh and the shape it belongs to.
    pub(super) fn with_mesh<R>(&self, uid: Uid, read: impl FnOnce(&Object, &Part) -> R) -> ApiResult<R> {
        let scene = self.scene.borrow();
        let (handle, index) = scene.mesh(uid).ok_or(ApiError::NoSuchTarget)?;
        let object = scene.object(handle)?;
        Ok(read(object, &object.shape()?.parts[index]))
    }
}

impl Subject<'_> {
    fn with_mesh<R>(&self, read: impl FnOnce(&Object, &Part) -> R) -> ApiResult<R> {
        let Target::Mesh(uid) = *self.target else { return Err(ApiError::NoSuchTarget) };
        self.sim.with_mesh(uid, read)
    }

    fn change_mesh(&self, change: impl FnOnce(&mut Part)) -> ApiResult<()> {
        let Target::Mesh(uid) = *self.target else { return Err(ApiError::NoSuchTarget) };
        let changed = self.sim.scene.borrow_mut().modify_mesh(uid, Field::Appearance, change);
        changed.ok_or(ApiError::NoSuchTarget)
    }

    /// What `of` tells about the mesh in the frame of its shape.
    fn geometry<R>(&self, of: impl FnOnce(&Mesh) -> R) -> ApiResult<R> {
        self.with_mesh(|_, part| {
            let mut mesh = Mesh::default();
            mesh.append(&part.mesh, &part.pose);
            of(&mesh)
        })
    }
}

pub(super) const MESH: &[Accessor] = subject_properties! {
    "vertices": Vec<f64>, |s| s.geometry(Mesh::flat_vertices)?;
    "indices": Vec<i64>, |s| s.geometry(Mesh::flat_indices)?;
    "normals": Vec<f64>, |s| s.geometry(Mesh::flat_normals)?;
    "shadingAngle": f64, |s| s.with_mesh(|_, part| part.appearance.shading_angle)?, |s, angle| {
        let angle = finite(angle)?;
        s.change_mesh(|part| part.appearance.shading_angle = angle)?
    };
    "showEdges": bool, |s| s.with_mesh(|_, part| part.appearance.edges)?,
        |s, on| s.change_mesh(|part| part.appearance.edges = on)?;
    "culling": bool, |s| s.with_mesh(|_, part| part.appearance.culling)?,
        |s, on| s.change_mesh(|part| part.appearance.culling = on)?;
    "shapeUid": i64, |s| s.with_mesh(|shape, _| shape.uid())?;
    "convex": bool, |s| s.with_mesh(|_, part| part.convex)?;
    "colorName": Text, |s| s.with_mesh(|_, part| Text(part.appearance.colour_name.clone().into_bytes()))?,
        |s, name| {
            let name = String::from_utf8_lossy(&name.0).into_owned();
            s.change_mesh(|part| part.appearance.colour_name = name)?
        };
};
