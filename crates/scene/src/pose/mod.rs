//! Poses of objects: in the world, relative to a frame, and their rate of change.

pub mod displacement;
pub(crate) mod measure;
pub mod placement;
pub(crate) mod world;

/// Random operations of layers above, and a check of all poses after each: for tests.
#[cfg(any(test, feature = "test-support"))]
pub use world::tests::check_cached_poses;
