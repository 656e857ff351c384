//! What is wrong with a file, and where.

use std::fmt;

/// Where in a file something was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Location {
    /// A line of a text, from 1.
    Line(usize),
    /// A byte of a binary file, from 0.
    Byte(usize),
    /// The file as a whole.
    File,
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Location::Line(line) => write!(f, "line {line}: "),
            Location::Byte(byte) => write!(f, "byte {byte}: "),
            Location::File => Ok(()),
        }
    }
}

/// Why a file is not read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}{element}: {problem}")]
pub struct ReadError {
    /// Where it was found.
    pub place: Location,
    /// What was being read: `face`, `accessor 3`.
    pub element: String,
    /// What is wrong with it.
    pub problem: String,
}

impl ReadError {
    pub(crate) fn new(
        place: Location,
        element: impl Into<String>,
        problem: impl Into<String>,
    ) -> Self {
        Self {
            place,
            element: element.into(),
            problem: problem.into(),
        }
    }
}

/// Why a file is not written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum WriteError {
    /// A triangle names a vertex that the part does not have.
    #[error("part {part}: triangle {triangle} names a vertex that is not there")]
    NoSuchVertex {
        /// Which part, from 0.
        part: usize,
        /// Which triangle of it, from 0.
        triangle: usize,
    },
    /// A coordinate that is infinite or no number.
    #[error("part {part}: vertex {vertex} is not finite")]
    NotFinite {
        /// Which part, from 0.
        part: usize,
        /// Which vertex of it, from 0.
        vertex: usize,
    },
    /// A node without its parent before it, without its mesh, or somewhere infinite.
    #[error("node {node}: its parent, its mesh or its place is not there")]
    NoSuchNode {
        /// Which node, from 0.
        node: usize,
    },
    /// The counts of this format have 32 bits.
    #[error("the mesh is too large for this format")]
    TooLarge,
}

pub(crate) type Result<T> = std::result::Result<T, ReadError>;
