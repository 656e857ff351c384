//! Errors of a scene. The texts are CoppeliaSim's: scripts compare them.

/// An operation the scene refused. Nothing was changed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    #[error("object does not exist.")]
    NoSuchObject,
    #[error("object does not exist, or alias/path is ill formatted.")]
    NoSuchPath,
    #[error("illegal object name.")]
    IllegalName,
    #[error("proxy object does not exist.")]
    NoSuchProxy,
    /// The object exists, but is of another type than the function needs, e.g. "joint".
    #[error("object is not a {0}.")]
    WrongType(&'static str),
    #[error("joint is spherical.")]
    SphericalJoint,
    #[error("object is ancestor of desired parent.")]
    AncestorOfParent,
    #[error("object is not tagged as model base.")]
    NotAModel,
    #[error("scene is locked.")]
    Locked,
    #[error("found invalid handles.")]
    InvalidHandles,
    #[error("invalid handle.")]
    InvalidHandle,
    #[error("invalid input.")]
    InvalidInput,
    #[error("invalid argument.")]
    InvalidArgument,
    #[error("invalid data.")]
    InvalidData,
    #[error("operation failed.")]
    OperationFailed,
    #[error("not enough shapes specified.")]
    NotEnoughShapes,
    #[error("cannot divide compound shape.")]
    DividesCompound,
    #[error("collection does not exist.")]
    NoSuchCollection,
    #[error("collision object does not exist.")]
    NoSuchCollisionObject,
    #[error("distance object does not exist.")]
    NoSuchDistanceObject,
    #[error("IK group does not exist.")]
    NoSuchIkGroup,
    #[error("illegal collection name.")]
    IllegalCollectionName,
    /// No custom user interface of V-REP.
    #[error("UI does not exist.")]
    NoSuchInterface,
    #[error("UI button does not exist.")]
    NoSuchButton,
    #[error("button is not a slider.")]
    NotASlider,
    /// No object and no collection.
    #[error("entity does not exist.")]
    NoSuchEntity,
    #[error("invalid proximity sensor handle.")]
    InvalidProximitySensor,
    #[error("object not tagged for explicit handling.")]
    NotExplicit,
    #[error("the scene is full: it can hold {} objects.", super::Handle::END)]
    TooManyObjects,
    /// Any other refusal, in words made where it happens.
    #[error("{0}")]
    Refused(String),
}

pub type SceneResult<T> = Result<T, SceneError>;
