//! Poses of objects: in the world, relative to a frame, and their rate of change.

pub mod displacement;
pub(crate) mod measure;
pub mod placement;
#[cfg(test)]
mod tests;
pub(crate) mod world;

#[cfg(test)]
pub(crate) use world::tests::check_cached_poses;
