//! What a reader says beside its result.

use std::fmt;

/// What was read, and what was wrong with it.
#[derive(Debug, Clone)]
pub struct Parsed<T> {
    pub value: T,
    /// In the order of the file, at most [`limits::WARNINGS`](crate::limits::WARNINGS).
    pub warnings: Vec<Warning>,
    /// How many more warnings there were.
    pub further_warnings: usize,
}

/// Something in a file that was guessed, or left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Counted from 1.
    pub line: u32,
    /// The name of the element.
    pub element: String,
    pub message: String,
    pub kind: WarningKind,
}

/// What became of the place that a warning is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WarningKind {
    /// It is wrong, and was read in the most likely sense.
    Corrected,
    /// It was not understood, and left out.
    NotUnderstood,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "line {}, <{}>: {}", self.line, self.element, self.message)
    }
}

/// Why a file has no robot.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    #[error("the file has {0} bytes, more than the {max} that are read", max = crate::limits::BYTES)]
    TooLong(usize),
    #[error("the file has more than {max} elements, attributes and texts", max = crate::limits::NODES)]
    TooManyNodes,
    #[error("line {line}: an element has more than {max} attributes", max = crate::limits::ATTRIBUTES)]
    TooManyAttributes { line: u32 },
    #[error("the file declares more than {max} namespaces", max = crate::limits::NAMESPACES)]
    TooManyNamespaces,
    #[error("no valid XML: {0}")]
    Xml(String),
    #[error("the file declares entities (line {line}), which are not expanded")]
    Entities { line: u32 },
    #[error("line {line}: the file begins with <{found}> instead of <{expected}>")]
    WrongRoot { line: u32, found: String, expected: &'static str },
    #[error(
        "line {line}: this is a xacro file. Expand it first: xacro FILE > robot.urdf (pip install xacro, or a ROS installation)"
    )]
    Xacro { line: u32 },
}
