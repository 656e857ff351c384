//! Errors of API calls and of the host.

use geometry::PoseError;
use permissions::Denied;
use scene::SceneError;

/// The result of a call from a script.
pub type ApiResult<T> = std::result::Result<T, ApiError>;

/// Why a call from a script failed. The texts are CoppeliaSim's: scripts compare them.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ApiError {
    /// A required argument is missing.
    #[error("the function requires more arguments.")]
    MoreArguments,
    /// An argument has a type that the function does not take, such as nil.
    #[error("one of the function's argument type is not correct.")]
    ArgumentType,
    /// Argument `position` (-1: an element of a table) is no `expected`, e.g. "number" or "string/buffer".
    #[error("argument {position} is not {} {expected}.", article(.expected))]
    NotA {
        /// The position of the argument, from 1; -1 for an element of a table.
        position: i32,
        /// What was expected, in the words of the message.
        expected: &'static str,
    },
    /// A table has too few or too many elements.
    #[error("incorrect table size.")]
    TableSize,
    /// The scene refuses the change, or has no such object.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// There is no script with that handle.
    #[error("script does not exist.")]
    NoSuchScript,
    /// The called script does not run.
    #[error("script is not initialized (or has already ended)")]
    ScriptNotInitialized,
    /// The script to call has no such function.
    #[error("failed calling script function.")]
    CallFailed,
    /// The function of another script raised an error, which was logged.
    #[error("error in script function.")]
    ErrorInCallee,
    /// The function is for the main script.
    #[error("can only be called from the main script.")]
    MainScriptOnly,
    /// The function is for the main script and simulation scripts.
    #[error("can only be called from the main script or a simulation script.")]
    MainOrSimulationScriptOnly,
    /// More calls between scripts are in progress than that many.
    #[error(
        "too many nested calls between scripts: {0} is the limit. Is a script calling itself without end?"
    )]
    TooDeep(usize),
    /// A table has more levels than can be copied.
    #[error("a table is nested deeper than {0} levels, and cannot be copied.")]
    TooNested(usize),
    /// Nothing with properties has that handle.
    #[error("target does not exist.")]
    NoSuchTarget,
    /// The target has no such property.
    #[error("property is unknown.")]
    UnknownProperty,
    /// The property has another type.
    #[error("property type mismatch.")]
    PropertyType,
    /// Scripts cannot set the property, or not to that value.
    #[error("property could not be written.")]
    PropertyNotWritable,
    /// There is no solver of dynamics with that name.
    #[error("there is no solver '{0}': it is 'exact' or 'impulse'.")]
    UnknownSolver(String),
    /// Scripts cannot read the property.
    #[error("property could not be read.")]
    PropertyNotReadable,
    /// The property is not one that scripts can remove.
    #[error("property cannot be removed.")]
    PropertyNotRemovable,
    /// The name of a property has characters that none has, or is empty.
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
    /// The program is being stopped while the call waits.
    #[error("interrupted: the program is to end.")]
    Interrupted,
    /// As Lua's own functions refuse argument `position`.
    #[error("bad argument #{position} ({reason})")]
    BadArgument {
        /// The position of the argument, from 1.
        position: i32,
        /// What is wrong with it.
        reason: String,
    },
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
    if word.starts_with(['a', 'e', 'i', 'o']) {
        "an"
    } else {
        "a"
    }
}
