//! Properties of the meshes of shapes. Texture properties apply while there is a texture.

use geometry::{Finite, Mesh};

use super::access::{Accessor, Subject, refused, subject_properties};
use super::{IntPair, PropertyTarget, Text};
use crate::binding::args::Bytes;
use crate::error::{ApiError, ApiResult};
use crate::host::Sim;
use scene::appearance::texture::Texture;
use scene::appearance::texture_mapping::{ApplyMode, TextureMapping};
use scene::shape::Part;
use scene::{Field, Object, Uid};

impl Sim {
    /// The result of `read` for a mesh and its shape.
    pub(in crate::property) fn with_mesh<R>(
        &self,
        uid: Uid,
        read: impl FnOnce(&Object, &Part) -> R,
    ) -> ApiResult<R> {
        let scene = self.scene.borrow();
        let (handle, index) = scene.mesh(uid).ok_or(ApiError::NoSuchTarget)?;
        let object = scene.object(handle)?;
        Ok(read(object, &object.shape()?.parts[index]))
    }
}

impl Subject<'_> {
    fn with_mesh<R>(&self, read: impl FnOnce(&Object, &Part) -> R) -> ApiResult<R> {
        let PropertyTarget::Mesh(uid) = *self.target else {
            return Err(ApiError::NoSuchTarget);
        };
        self.sim.with_mesh(uid, read)
    }

    fn change_mesh(&self, change: impl FnOnce(&mut Part)) -> ApiResult<()> {
        let PropertyTarget::Mesh(uid) = *self.target else {
            return Err(ApiError::NoSuchTarget);
        };
        let changed = self
            .sim
            .scene
            .borrow_mut()
            .modify_mesh(uid, Field::Appearance, change);
        changed.ok_or(ApiError::NoSuchTarget)
    }

    /// The result of `of` for the mesh in the frame of its shape.
    fn geometry<R>(&self, of: impl FnOnce(&Mesh) -> R) -> ApiResult<R> {
        self.with_mesh(|_, part| {
            let mut mesh = Mesh::default();
            mesh.append(&part.mesh, &part.pose);
            of(&mesh)
        })
    }
}

impl Subject<'_> {
    /// The result of `of` for the texture of the mesh; `none` without a texture.
    fn texture<R>(&self, none: R, of: impl FnOnce(&TextureMapping) -> R) -> ApiResult<R> {
        self.with_mesh(|_, part| part.texture.as_deref().map_or(none, of))
    }

    /// Changes the texture mapping of the mesh, if it has a texture.
    fn change_texture(&self, change: impl FnOnce(&mut TextureMapping)) -> ApiResult<()> {
        self.change_mesh(|part| {
            part.texture.as_deref_mut().map(change);
        })
    }

    /// The result of `of` for the image; `none` without an image, or if it is that of a sensor.
    fn image<R>(&self, none: R, of: impl FnOnce(&Texture) -> R) -> ApiResult<R> {
        let id = self.texture(-1, |texture| texture.source.raw())?;
        Ok(self.sim.scene.borrow().textures().get(id).map_or(none, of))
    }
}

pub(in crate::property) const TEXTURE: &[Accessor] = subject_properties! {
    "textureResolution": IntPair, |s| IntPair(s.image([0; 2], |image| image.size().map(i64::from))?);
    "textureCoordinates": Vec<f64>,
        |s| s.texture(Vec::new(), |texture| texture.coordinates.iter().copied().map(f64::from).collect())?;
    "textureApplyMode": i64, |s| s.texture(0, |texture| texture.apply_mode.0)?,
        |s, mode| s.change_texture(|texture| texture.apply_mode = ApplyMode(mode))?;
    "textureRepeatU": bool, |s| s.texture(true, |texture| texture.repeat[0])?,
        |s, on| s.change_texture(|texture| texture.repeat[0] = on)?;
    "textureRepeatV": bool, |s| s.texture(true, |texture| texture.repeat[1])?,
        |s, on| s.change_texture(|texture| texture.repeat[1] = on)?;
    "textureInterpolate": bool, |s| s.texture(true, |texture| texture.interpolate)?,
        |s, on| s.change_texture(|texture| texture.interpolate = on)?;
    "rawTexture": Bytes, |s| Bytes(s.image(Vec::new(), Texture::rgba)?);
    "textureID": i64, |s| s.texture(-1, |texture| texture.source.raw())?;
};

pub(in crate::property) const MESH: &[Accessor] = subject_properties! {
    "vertices": Vec<f64>, |s| s.geometry(Mesh::flat_vertices)?;
    "indices": Vec<i64>, |s| s.geometry(Mesh::flat_indices)?;
    "normals": Vec<f64>, |s| s.geometry(Mesh::flat_normals)?;
    "shadingAngle": f64, |s| s.with_mesh(|_, part| part.appearance.shading_angle)?, |s, angle| {
        let angle = angle.finite().ok_or_else(refused)?;
        s.change_mesh(|part| part.appearance.shading_angle = angle)?;
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
            s.change_mesh(|part| part.appearance.colour_name = name)?;
        };
};
