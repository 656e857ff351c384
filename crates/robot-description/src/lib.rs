//! Descriptions of robots: URDF, SDF and MJCF as plain values, with warnings instead of failures; URDF is written as well.
//!
//! This crate knows no scene and opens no file: the caller passes bytes, and says which files exist.
//!
//! | to | look at |
//! |---|---|
//! | read and write URDF | [`urdf::read`], [`urdf::write`] |
//! | read models and worlds in SDF | [`sdf::read`] |
//! | read models in MJCF | [`mjcf::read`] |
//! | read what sensors and controllers have to do with ROS 2 | [`ros::of_urdf`], [`ros::of_sdf`], [`ros::of_yaml`], [`ros::of_toml`] |
//! | see what was read | [`Robot`], and the [`Warning`]s beside it |
//! | find the meshes that a file names | [`Search`] |
//! | place the links at positions of the joints | [`Robot::link_poses`] |
//!
//! # Bad files
//!
//! Files of users have errors that other programs do not mind. What can be read is read; each guess, and each element that is not understood, is a
//! warning with its line. Only text that is no XML, has no robot, or exceeds a [limit](limits) is refused ([`ReadError`]).
//!
//! # Why no library
//!
//! `urdf-rs` refuses a tenth of the files that users have, and says no line; here such a file is read, with a warning and its line. SDF and MJCF
//! become the same [`Robot`], with limits that keep time and memory in proportion to the size of a file. XML itself is parsed by `roxmltree`.
//!
//! # Units
//!
//! Metres, radians, kilograms, seconds, newtons; poses are frames in the frame of their parent.

pub mod mjcf;
mod model;
mod positions;
mod report;
mod resolve;
pub mod ros;
pub mod sdf;
mod tree;
pub mod urdf;
mod xml;

pub use model::{
    Collision, Dynamics, Geometry, Inertial, Joint, JointKind, Limits, Link, Material, Mimic, Pose,
    Robot, Sensor, SensorKind, Visual,
};
pub use positions::PositionError;
pub use report::{Parsed, ReadError, Warning, WarningKind};
pub use resolve::{Search, Unresolved};

/// What a file may have at most, so that memory stays bounded by its size.
pub mod limits {
    /// Bytes of a file.
    pub const BYTES: usize = 64 << 20;
    /// Elements, attributes and texts of a file.
    pub const NODES: u32 = 1_000_000;
    /// Attributes of an element.
    pub const ATTRIBUTES: usize = bounded_xml::MAX_ATTRIBUTES;
    /// Declarations of namespaces in a file.
    pub const NAMESPACES: usize = bounded_xml::MAX_NAMESPACES;
    /// Warnings that are told apart; of others only the number is known.
    pub const WARNINGS: usize = 500;
    /// Joints that mimic one that mimics another one.
    pub const MIMIC_CHAIN: usize = 16;
}
