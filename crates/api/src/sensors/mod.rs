//! `sim.*`: sensors, octrees and point clouds.

pub(in crate::api) mod create;
pub(in crate::api) mod force_sensor;
pub(in crate::api) mod proximity_sensor;
pub(in crate::api) mod queries;
pub(in crate::api) mod vision;
pub(in crate::api) mod voxel_objects;
pub(in crate::api) mod voxels;
