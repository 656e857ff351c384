//! Geometry of queries, and its pose.

use geometry::{Finite, MAX_COORDINATE, Pose};
use nalgebra::Matrix3;

use crate::bounds::Bounds;
use crate::mesh::TriangleMesh;
use crate::points::{ORIGIN, PointSet};
use crate::primitive::Vector;
use crate::voxels::VoxelGrid;

/// Geometry of a query.
#[derive(Debug, Clone, Copy)]
pub enum Geometry<'a> {
    /// A surface.
    Mesh(&'a TriangleMesh),
    /// Solid cells.
    Voxels(&'a VoxelGrid),
    /// Points without extent.
    Points(&'a PointSet),
    /// One point, the origin of its frame.
    Point,
}

/// A geometry and the pose of its frame in the world.
#[derive(Debug, Clone, Copy)]
pub struct Placed<'a> {
    /// Its geometry.
    pub geometry: Geometry<'a>,
    /// From its frame to the world.
    pub pose: Pose,
}

impl Placed<'_> {
    /// The box around it in the world.
    pub fn bounds(&self) -> Bounds {
        let own = match self.geometry {
            Geometry::Mesh(mesh) => mesh.bounds(),
            Geometry::Voxels(grid) => grid.bounds(),
            Geometry::Points(points) => points.bounds(),
            Geometry::Point => ORIGIN.bounds(),
        };
        own.transformed(&self.pose)
    }

    /// The world's pose of another frame, seen from this one; `None` where one cannot compute with a pose.
    pub(crate) fn relative(&self, other: &Pose) -> Option<Transform> {
        let is_usable =
            |pose: &Pose| pose.is_finite() && pose.translation.vector.amax() <= MAX_COORDINATE;
        (is_usable(&self.pose) && is_usable(other))
            .then(|| Transform::of(&self.pose.inv_mul(other)))
    }
}

/// A pose as a matrix: faster for many points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Transform {
    pub rotation: Matrix3<f64>,
    pub translation: Vector,
}

impl Transform {
    pub fn of(pose: &Pose) -> Self {
        Self {
            rotation: pose.rotation.to_rotation_matrix().into_inner(),
            translation: pose.translation.vector,
        }
    }

    #[inline]
    pub fn point(&self, p: &Vector) -> Vector {
        self.rotation * p + self.translation
    }

    #[inline]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self {
            rotation,
            translation: -(rotation * self.translation),
        }
    }
}
