//! Poses of objects: in the world, in a frame of one's choice, and how fast they change.

pub mod placement;
pub(in crate::scene) mod world;
