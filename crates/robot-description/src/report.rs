//! What a reader says beside its result.

use std::fmt;

/// What was read, and what was wrong with it.
#[derive(Debug, Clone)]
pub struct Parsed<T> {
    /// What was read.
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
    /// What is wrong, and what was read instead.
    pub message: String,
    /// What became of the place.
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
        write!(
            f,
            "line {}, <{}>: {}",
            self.line, self.element, self.message
        )
    }
}

/// Why a file has no robot.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// The file has so many bytes, more than [`limits::BYTES`](crate::limits::BYTES).
    #[error("the file has {0} bytes, more than the {max} that are read", max = crate::limits::BYTES)]
    TooLong(usize),
    /// The file has more than [`limits::NODES`](crate::limits::NODES).
    #[error("the file has more than {max} elements, attributes and texts", max = crate::limits::NODES)]
    TooManyNodes,
    /// An element has more than [`limits::ATTRIBUTES`](crate::limits::ATTRIBUTES).
    #[error("line {line}: an element has more than {max} attributes", max = crate::limits::ATTRIBUTES)]
    TooManyAttributes {
        /// Its line, from 1.
        line: u32,
    },
    /// The file declares more than [`limits::NAMESPACES`](crate::limits::NAMESPACES).
    #[error("the file declares more than {max} namespaces", max = crate::limits::NAMESPACES)]
    TooManyNamespaces,
    /// The file is no well-formed XML; the text says why, and in which line.
    #[error("no valid XML: {0}")]
    Xml(String),
    /// The file declares entities.
    #[error("the file declares entities (line {line}), which are not expanded")]
    Entities {
        /// The line of the declaration, from 1.
        line: u32,
    },
    /// The outermost element belongs to another format.
    #[error("line {line}: the file begins with <{found}> instead of <{expected}>")]
    WrongRoot {
        /// Its line, from 1.
        line: u32,
        /// Its name.
        found: String,
        /// The name it should have.
        expected: &'static str,
    },
    #[error(
        "line {line}: this is a xacro file. Expand it first: xacro FILE > robot.urdf (pip install xacro, or a ROS installation)"
    )]
    /// The file has to be expanded with xacro first.
    Xacro {
        /// The line of the first element, from 1.
        line: u32,
    },
}
