//! Octrees and point clouds.

pub mod cloud_points;
pub mod growth;
pub mod octree;
pub mod options;
pub mod point_cloud;
pub(crate) mod voxelize;

use geometry::BoundingBox;
use nalgebra::Vector3;

use crate::Pose;
pub use voxelize::{cells_of_mesh, cells_of_octree};

/// The box along the axes of the object around cubes of that edge at these centres; without size when there are none.
fn box_around(centres: impl Iterator<Item = [f64; 3]>, edge: f64) -> BoundingBox {
    let empty = (
        Vector3::repeat(f64::INFINITY),
        Vector3::repeat(f64::NEG_INFINITY),
    );
    let (low, high) = centres
        .map(Vector3::from)
        .fold(empty, |(l, h), centre| (l.inf(&centre), h.sup(&centre)));
    if low.x > high.x {
        return BoundingBox {
            size: [0.0; 3],
            pose: Pose::identity(),
        };
    }
    let centre = (low + high) * 0.5;
    let pose = Pose::translation(centre.x, centre.y, centre.z);
    BoundingBox {
        size: (high - low).add_scalar(edge).into(),
        pose,
    }
}
