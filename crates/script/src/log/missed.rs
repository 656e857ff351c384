//! What functions did not find, for hints beside errors.

/// Something that a function did not find, for the error that may come of it.
#[derive(Debug, Clone)]
pub(crate) enum Missed {
    /// The path of an object.
    Object(String),
    /// The name of a file of a scene or model.
    File(String),
    /// An argument that is nil or missing, in words.
    Argument {
        /// The function that was called.
        function: String,
        /// Which argument, and what is wrong with it.
        wrong: String,
    },
}
