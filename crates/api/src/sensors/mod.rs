//! `sim.*`: sensors, octrees and point clouds.

pub(crate) mod create;
pub(crate) mod force_sensor;
pub(crate) mod proximity_sensor;
pub(crate) mod queries;
pub(crate) mod vision;
pub(crate) mod voxel_objects;
pub(crate) mod voxels;
