//! Creation of shapes: primitives, meshes, height fields.

use std::rc::Rc;

use geometry::BoundingBox;
use geometry::MassProperties;
use geometry::Mesh;
use geometry::primitive::{PrimitiveKind, heightfield};

use super::options::PrimitiveOptions;
use super::primitives::PrimitiveForm;
use super::{Appearance, HeightField, Material, Part, Primitive, Shape, ShapeDynamics, Velocity};
use crate::Pose;
use crate::{SceneError, SceneResult};

const GREY: [f32; 3] = [0.9; 3];
const SAND: [f32; 3] = [0.68, 0.56, 0.36];

impl Shape {
    /// A simple shape of one part that lies in the shape frame.
    pub fn simple(part: Part, bounding_box: BoundingBox) -> Self {
        let mass = part.mass;
        Self {
            parts: vec![part],
            bounding_box,
            mass,
            dynamics: ShapeDynamics::default(),
            material: Material::default(),
            velocity: Velocity::default(),
            force: [0.0; 3],
            torque: [0.0; 3],
            soft_form: None,
        }
    }

    /// A primitive of the given full extents (m), centred on its frame. [`Scene::primitive`](crate::Scene::primitive) shares the meshes of equal ones.
    ///
    /// # Errors
    /// For height fields, which need heights.
    pub fn primitive(
        kind: PrimitiveKind,
        size: [f64; 3],
        options: PrimitiveOptions,
    ) -> SceneResult<Self> {
        let form = PrimitiveForm::new(kind, size, options);
        Ok(form.shape(Rc::new(form.mesh()?), options))
    }

    /// A mesh whose vertices lie in the shape frame; its bounding box is turned to be the tightest.
    ///
    /// # Errors
    /// When the mesh is empty.
    pub fn from_mesh(mut mesh: Mesh, appearance: Appearance) -> SceneResult<Self> {
        let bounding_box = mesh.oriented_box().ok_or(SceneError::InvalidData)?;
        if mesh.normals.is_empty() {
            mesh.compute_normals(appearance.shading_angle);
        }
        Ok(Self::simple(mesh_part(mesh, appearance), bounding_box))
    }

    /// Grey, as `sim.createShape` colours meshes.
    pub fn mesh_appearance() -> Appearance {
        Appearance::new(GREY)
    }

    /// Terrain, see [`heightfield`]: respondable, centred on x and y, heights as they are. With `plain_mesh`, physics sees triangles
    /// only.
    ///
    /// # Errors
    /// When counts, width and heights do not fit each other.
    pub fn terrain(
        columns: usize,
        rows: usize,
        width: f64,
        heights: &[f64],
        appearance: Appearance,
        plain_mesh: bool,
    ) -> SceneResult<Self> {
        let refused = || SceneError::Refused("invalid arguments.".into());
        let mut mesh = heightfield(columns, rows, width, heights).ok_or_else(refused)?;
        mesh.compute_normals(appearance.shading_angle);
        let bounding_box = mesh
            .bounding_box(&nalgebra::UnitQuaternion::identity())
            .ok_or_else(refused)?;
        let mut part = mesh_part(mesh, appearance);
        part.convex = false;
        if !plain_mesh {
            // Kept with y growing by the row; scripts give the row at +y first.
            let rising = heights
                .chunks(columns)
                .take(rows)
                .rev()
                .flatten()
                .copied()
                .collect();
            let heights = Some(Rc::new(HeightField {
                columns,
                rows,
                heights: rising,
            }));
            part.primitive = Some(Primitive {
                kind: PrimitiveKind::Heightfield,
                size: bounding_box.size,
                heights,
            });
        }
        let mut shape = Self::simple(part, bounding_box);
        shape.dynamics.respondable = true;
        Ok(shape)
    }

    /// The colour of new terrain.
    pub fn terrain_appearance() -> Appearance {
        Appearance::new(SAND)
    }
}

fn mesh_part(mesh: Mesh, appearance: Appearance) -> Part {
    Part {
        uid: 0,
        convex: mesh.is_convex(),
        mesh: Rc::new(mesh),
        pose: Pose::identity(),
        primitive: None,
        mass: MassProperties::default(),
        alias: String::new(),
        group: Vec::new(),
        appearance,
        texture: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_round_solids_are_pure() {
        let make = |size| {
            Shape::primitive(PrimitiveKind::Cylinder, size, PrimitiveOptions::default()).unwrap()
        };
        assert!(make([0.2, 0.2, 0.4]).is_pure());
        assert!(!make([0.1, 0.2, 0.4]).is_pure() && make([0.1, 0.2, 0.4]).is_convex());
    }

    #[test]
    fn terrain_rises_with_its_rows() {
        let heights = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        let shape =
            Shape::terrain(3, 2, 2.0, &heights, Shape::terrain_appearance(), false).unwrap();
        assert_eq!(shape.bounding_box.size, [2.0, 1.0, 1.0]);
        let field = shape.parts[0]
            .primitive
            .as_ref()
            .unwrap()
            .heights
            .clone()
            .unwrap();
        assert_eq!(field.heights, [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
    }
}
