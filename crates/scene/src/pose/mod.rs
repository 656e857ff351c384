//! Poses of objects: in the world, relative to a frame, and their rate of change.

pub mod displacement;
pub(in crate::scene) mod measure;
pub mod placement;
pub(in crate::scene) mod world;

#[cfg(test)]
pub(crate) use world::tests::check_cached_poses;
