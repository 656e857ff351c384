//! What can be wrong with a call.

use thiserror::Error;

/// The result of an operation on an environment.
pub type Result<T> = std::result::Result<T, KinematicsError>;

/// Why an operation on an environment is not possible.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum KinematicsError {
    /// The object was erased, or never existed.
    #[error("object does not exist.")]
    NoSuchObject,
    /// The operation needs a joint.
    #[error("object is not a joint.")]
    NotAJoint,
    /// The operation needs a dummy.
    #[error("object is not a dummy.")]
    NotADummy,
    /// The operation needs a spherical joint.
    #[error("joint is not spherical.")]
    NotSpherical,
    /// The operation is for joints with one coordinate.
    #[error("joint is spherical.")]
    Spherical,
    /// The group does not exist.
    #[error("IK group does not exist.")]
    NoSuchGroup,
    /// The element was removed, or never existed.
    #[error("IK element does not exist.")]
    NoSuchElement,
    /// An object would become its own ancestor.
    #[error("object cannot be its own ancestor.")]
    Circle,
    /// A number is NaN or infinite.
    #[error("argument is not a finite number.")]
    NotFinite,
    /// The bytes do not describe an environment.
    #[error("the data are no kinematic environment, or damaged.")]
    Damaged,
    /// There are more objects than the format can count.
    #[error("the environment is too large to be saved.")]
    TooLarge,
    /// A callback of the solver failed, or its results have wrong sizes.
    #[error("{0}")]
    Callback(String),
}
