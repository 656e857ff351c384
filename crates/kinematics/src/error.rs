//! What can be wrong with a call.

use thiserror::Error;

pub type Result<T> = std::result::Result<T, KinematicsError>;

#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum KinematicsError {
    #[error("object does not exist.")]
    NoSuchObject,
    #[error("object is not a joint.")]
    NotAJoint,
    #[error("object is not a dummy.")]
    NotADummy,
    #[error("joint is not spherical.")]
    NotSpherical,
    #[error("joint is spherical.")]
    Spherical,
    #[error("IK group does not exist.")]
    NoSuchGroup,
    #[error("IK element does not exist.")]
    NoSuchElement,
    #[error("object cannot be its own ancestor.")]
    Circle,
    #[error("argument is not a finite number.")]
    NotFinite,
    #[error("the data are no kinematic environment, or damaged.")]
    Damaged,
    #[error("the environment is too large to be saved.")]
    TooLarge,
    /// A callback of the solver failed, or its results have wrong sizes.
    #[error("{0}")]
    Callback(String),
}
