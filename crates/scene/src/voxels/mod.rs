//! Octrees and point clouds.

pub mod octree;
pub mod options;
pub mod point_cloud;
pub(crate) mod voxelize;

pub use voxelize::{cells_of_mesh, cells_of_octree};
