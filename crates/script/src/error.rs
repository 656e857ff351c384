//! Errors of API calls and of the host.

use geometry::PoseError;
use permissions::Denied;
use scene::SceneError;

/// The result of a call from a script.
pub type ApiResult<T> = std::result::Result<T, ApiError>;

/// Why a call from a script failed. The texts are CoppeliaSim's: scripts compare them.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ApiError {
    #[error("the function requires more arguments.")]
    MoreArguments,
    #[error("one of the function's argument type is not correct.")]
    ArgumentType,
    /// Argument `position` (-1: an element of a table) is no `expected`, e.g. "number" or "string/buffer".
    #[error("argument {position} is not {} {expected}.", article(.expected))]
    NotA { position: i32, expected: &'static str },
    #[error("incorrect table size.")]
    TableSize,
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error("script does not exist.")]
    NoSuchScript,
    #[error("script is not initialized (or has already ended)")]
    ScriptNotInitialized,
    #[error("failed calling script function.")]
    CallFailed,
    #[error("error in script function.")]
    ErrorInCallee,
    #[error("can only be called from the main script.")]
    MainScriptOnly,
    #[error("can only be called from the main script or a simulation script.")]
    MainOrSimulationScriptOnly,
    #[error("too many nested calls between scripts: {0} is the limit. Is a script calling itself without end?")]
    TooDeep(usize),
    #[error("a table is nested deeper than {0} levels, and cannot be copied.")]
    TooNested(usize),
    #[error("target does not exist.")]
    NoSuchTarget,
    #[error("property is unknown.")]
    UnknownProperty,
    #[error("property type mismatch.")]
    PropertyType,
    #[error("property could not be written.")]
    PropertyNotWritable,
    #[error("there is no solver '{0}': it is 'exact' or 'impulse'.")]
    UnknownSolver(String),
    #[error("property could not be read.")]
    PropertyNotReadable,
    #[error("property cannot be removed.")]
    PropertyNotRemovable,
    #[error("invalid property name.")]
    PropertyName,
    /// The simulator's permissions do not allow it.
    #[error(transparent)]
    Denied(#[from] Denied),
    /// A name of the reference that is not built here, or not yet.
    #[error("not implemented in Swanilda: {0}")]
    NotImplemented(String),
    /// The call did not come from Lua, and the function deals with functions, objects or coroutines of Lua.
    #[error("can only be called by a Lua script.")]
    NeedsLua,
    #[error("interrupted: the program is to end.")]
    Interrupted,
    /// As Lua's own functions refuse argument `position`.
    #[error("bad argument #{position} ({reason})")]
    BadArgument { position: i32, reason: String },
    /// The error of a native plugin's function.
    #[error("{0} (c: simSetLastError)")]
    Plugin(String),
    /// Words made where the error happens.
    #[error("{0}")]
    Other(String),
}

/// Errors of the layers and libraries below, which scripts see in the words these have.
macro_rules! in_their_words {
    ($($error:ty),* $(,)?) => { $(
        impl From<$error> for ApiError {
            fn from(error: $error) -> Self {
                Self::Other(error.to_string())
            }
        }
    )* };
}

in_their_words![
    format::mesh_file::MeshFileError,
    imaging::matrix::MatrixError,
    kinematics::KinematicsError,
    ui::UiError,
];

impl From<ik::Error> for ApiError {
    fn from(error: ik::Error) -> Self {
        match error {
            ik::Error::Scene(error) => error.into(),
            ik::Error::Kinematics(error) => error.into(),
        }
    }
}

impl From<PoseError> for ApiError {
    fn from(error: PoseError) -> Self {
        match error {
            PoseError::MissingAxis2 => Self::MoreArguments,
            PoseError::TransformSize(_) => Self::TableSize,
            PoseError::UnknownMode(_) => Self::Other(error.to_string()),
        }
    }
}

fn article(word: &str) -> &'static str {
    if word.starts_with(['a', 'e', 'i', 'o']) { "an" } else { "a" }
}
