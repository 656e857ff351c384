//! From visible faces to colour, depth and ids.

use nalgebra::Vector3;

use crate::lighting::Lighting;
use crate::raster::Face;
use crate::surface::Surface;
use crate::view::View;
use crate::{Fog, Material, Picture};

/// What faces belong to.
#[derive(Debug, Clone, Copy)]
pub struct Owner<'a> {
    pub id: u32,
    pub surface: Surface<'a>,
    pub material: &'a Material,
}

/// Everything that shading needs to know.
pub struct Shading<'a> {
    pub view: &'a View,
    pub owners: &'a [Owner<'a>],
    pub lighting: Lighting,
    pub fog: Option<Fog>,
}

impl Shading<'_> {
    /// The id of a face.
    pub fn id(&self, face: Option<&Face>) -> u32 {
        face.map_or(Picture::NOTHING, |face| self.owners[face.owner as usize].id)
    }

    /// `(z - near) / (far - near)` of a face at a ray.
    pub fn depth(&self, face: Option<&Face>, ray: [f64; 2]) -> f32 {
        let Some(face) = face else { return 1.0 };
        let [least, most] = face.range.map(f64::from);
        let depth = self.view.depth(face.closeness.at(ray).clamp(least, most));
        ((depth - self.view.near) / (self.view.far - self.view.near)).clamp(0.0, 1.0) as f32
    }

    /// The colour of a face at a ray.
    pub fn colour(&self, face: &Face, ray: [f64; 2]) -> [f32; 3] {
        let owner = &self.owners[face.owner as usize];
        let (mesh, transform) = (owner.surface.mesh, &owner.surface.transform);
        let triangle = &mesh.triangles[face.detail as usize];
        let cluster = mesh.cluster_of(face.detail as usize);
        let corners =
            triangle.corners.map(|c| transform.apply(&mesh.vertices[cluster.vertices.start + usize::from(c)]));
        let weights = self.view.weights(&corners, ray);
        let normal: Vector3<f32> = (0..3).map(|i| Vector3::from(triangle.normals[i]) * weights[i] as f32).sum();
        let point: Vector3<f64> = (0..3).map(|i| corners[i] * weights[i]).sum();
        let turned = self.view.in_metres(transform.rotation * normal.cast::<f64>()).cast::<f32>();
        let turned = turned.try_normalize(0.0).unwrap_or_default();
        let normal = if face.back { -turned } else { turned };
        let lit = self.lighting.lit(owner.material, &self.view.in_metres(point).cast(), &normal);
        let textured = owner.material.texture.as_ref().map_or(lit, |texture| {
            let uv = [0, 1].map(|axis| (0..3).map(|i| triangle.uv[i][axis] * weights[i] as f32).sum());
            texture.combine(lit, texture.sample(uv))
        });
        self.fog.as_ref().map_or(textured, |fog| fog.cover(textured, point.z))
    }
}
