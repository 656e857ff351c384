//! Errors of a scene. The texts are CoppeliaSim's: scripts compare them.

/// An operation the scene refused. Nothing was changed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// No object has that handle.
    #[error("object does not exist.")]
    NoSuchObject,
    /// No object has that path, alias or name.
    #[error("object does not exist, or alias/path is ill formatted.")]
    NoSuchPath,
    /// The name has illegal characters or is taken.
    #[error("illegal object name.")]
    IllegalName,
    /// The object that a relative path starts at does not exist.
    #[error("proxy object does not exist.")]
    NoSuchProxy,
    /// The object exists, but is of another type than the function needs, e.g. "joint".
    #[error("object is not a {0}.")]
    WrongType(&'static str),
    /// A spherical joint has no position along one axis.
    #[error("joint is spherical.")]
    SphericalJoint,
    /// The change would make an object its own ancestor.
    #[error("object is ancestor of desired parent.")]
    AncestorOfParent,
    /// The object is no base of a model.
    #[error("object is not tagged as model base.")]
    NotAModel,
    /// The scene may not be saved.
    #[error("scene is locked.")]
    Locked,
    /// Some of the handles are unknown or given twice.
    #[error("found invalid handles.")]
    InvalidHandles,
    /// The handle refers to nothing that the function can use.
    #[error("invalid handle.")]
    InvalidHandle,
    /// An input is out of its range.
    #[error("invalid input.")]
    InvalidInput,
    /// An argument is out of its range.
    #[error("invalid argument.")]
    InvalidArgument,
    /// Data are malformed, or contain numbers that are not finite.
    #[error("invalid data.")]
    InvalidData,
    /// The operation is impossible in the present state.
    #[error("operation failed.")]
    OperationFailed,
    /// Too few shapes were given.
    #[error("not enough shapes specified.")]
    NotEnoughShapes,
    /// A compound shape was given where only simple ones can be divided.
    #[error("cannot divide compound shape.")]
    DividesCompound,
    /// No collection has that handle.
    #[error("collection does not exist.")]
    NoSuchCollection,
    /// No collision object has that handle or name.
    #[error("collision object does not exist.")]
    NoSuchCollisionObject,
    /// No distance object has that handle or name.
    #[error("distance object does not exist.")]
    NoSuchDistanceObject,
    /// No group of inverse kinematics has that handle or name.
    #[error("IK group does not exist.")]
    NoSuchIkGroup,
    /// The name of the collection has illegal characters or is taken.
    #[error("illegal collection name.")]
    IllegalCollectionName,
    /// No custom user interface of V-REP.
    #[error("UI does not exist.")]
    NoSuchInterface,
    /// The user interface has no button with that number.
    #[error("UI button does not exist.")]
    NoSuchButton,
    /// The button is no slider.
    #[error("button is not a slider.")]
    NotASlider,
    /// No object and no collection.
    #[error("entity does not exist.")]
    NoSuchEntity,
    /// The handle is not that of a proximity sensor.
    #[error("invalid proximity sensor handle.")]
    InvalidProximitySensor,
    /// The object is handled with all others, and cannot be handled alone.
    #[error("object not tagged for explicit handling.")]
    NotExplicit,
    /// All handles are in use.
    #[error("the scene is full: it can hold {} objects.", super::Handle::END)]
    TooManyObjects,
    /// Any other refusal, in words made where it happens.
    #[error("{0}")]
    Refused(String),
}

/// What an operation on the scene returns.
pub type SceneResult<T> = Result<T, SceneError>;
