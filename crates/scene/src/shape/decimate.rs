//! Shapes and meshes with fewer triangles.

use geometry::Mesh;
use mesh_processing::{Target, decimate};

use super::Shape;
use crate::{SceneError, SceneResult};

/// A mesh with fewer triangles, and flat normals. None if its triangles have no area.
pub fn decimated_mesh(mut mesh: Mesh, target: Target) -> Option<Mesh> {
    mesh.merge_duplicates(0.0);
    let (vertices, triangles) = decimate(&mesh.vertices, &mesh.triangles, target);
    Mesh::new(vertices, triangles).ok()
}

impl Shape {
    /// A shape with fewer triangles, of the same mass and appearance, but without textures and with the frame of this one. The triangles are
    /// distributed among the meshes in proportion to what they had.
    ///
    /// # Errors
    /// When a mesh has no area.
    pub fn decimated(&self, target: Target) -> SceneResult<Shape> {
        let (all_triangles, all_vertices) =
            self.parts
                .iter()
                .fold((0, 0), |(triangles, vertices), part| {
                    (
                        triangles + part.mesh.triangles.len(),
                        vertices + part.mesh.vertices.len(),
                    )
                });
        let mut shapes = Vec::new();
        for part in &self.parts {
            let share = |all: usize, own: usize, target: usize| {
                if target >= all {
                    usize::MAX
                } else {
                    (target as f64 * own as f64 / all as f64).ceil() as usize
                }
            };
            let target = Target {
                triangles: share(all_triangles, part.mesh.triangles.len(), target.triangles),
                vertices: share(all_vertices, part.mesh.vertices.len(), target.vertices),
                ..target
            };
            let mut mesh = Mesh::default();
            mesh.append(&part.mesh, &part.pose);
            let refused = || SceneError::Refused("the mesh has no area.".into());
            let mut mesh = decimated_mesh(mesh, target).ok_or_else(refused)?;
            mesh.compute_normals(part.appearance.shading_angle);
            shapes.push(Shape::from_mesh(mesh, part.appearance.clone())?);
        }
        let mut shape = Shape::compound(shapes)?;
        (shape.mass, shape.dynamics, shape.material) =
            (self.mass, self.dynamics.clone(), self.material.clone());
        Ok(shape)
    }
}
