//! URDF, the Unified Robot Description Format (<https://wiki.ros.org/urdf/XML>), with the additions of Bullet (capsules, planes).

mod joint;
mod link;
mod read;
mod write;

pub use read::{OF_GAZEBO, read};
pub use write::write;
