//! What can be wrong with texts, names, values and bytes.

use thiserror::Error;

use crate::limits;

/// Why a type is not available.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum InterfaceError {
    /// No description and no file has this name.
    #[error("unknown interface '{0}'")]
    Unknown(String),
    /// Not of the form `package/Name`, `package/msg/Name`, `package/srv/Name` or `package/action/Name`.
    #[error("'{0}' is no name of an interface: package/msg/Name is expected")]
    Name(String),
    /// A line of a text.
    #[error("{file}:{line}: {problem}")]
    Text {
        /// The file, or the name of the interface if it is built in.
        file: String,
        /// From 1.
        line: usize,
        /// What is wrong there.
        problem: String,
    },
    /// A file that exists but cannot be read.
    #[error("{file}: {problem}")]
    File {
        /// The path.
        file: String,
        /// What the system says.
        problem: String,
    },
    /// A type that contains itself.
    #[error("{0} contains itself")]
    Cycle(String),
    /// Types within types.
    #[error("{0} is nested more than {n} levels deep", n = limits::NESTING)]
    Nesting(String),
    /// Fixed arrays within fixed arrays.
    #[error("{0} has more than {n} values in fixed arrays", n = limits::FIXED_VALUES)]
    TooLarge(String),
    /// A nested type that is not available.
    #[error("{outer} has a field of type {inner}: {problem}")]
    Nested {
        /// The type with the field.
        outer: String,
        /// The type of the field.
        inner: String,
        /// Why it is not available.
        problem: Box<InterfaceError>,
    },
}

/// Why bytes are no message of a type.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum DecodeError {
    /// The message ends within a value.
    #[error("the message ends after {length} bytes, within a value")]
    Short {
        /// Of the message, in bytes.
        length: usize,
    },
    /// Bytes are left after the last field.
    #[error("{rest} bytes follow the last field")]
    Long {
        /// The number of bytes.
        rest: usize,
    },
    /// More elements than a message may have.
    #[error("a message has at most {n} nested records", n = limits::RECORDS)]
    Records,
    /// A sequence or a string that is longer than its type allows.
    #[error("{length} elements where the type allows {bound}")]
    Bound {
        /// What the message says.
        length: usize,
        /// What the type allows.
        bound: usize,
    },
    /// Not plain CDR: the first two bytes say which representation it is.
    #[error("the message is not in plain CDR but in representation {0:02x?}")]
    Representation([u8; 2]),
    /// Text that is not encoded as it should be.
    #[error("invalid text")]
    Text,
}

/// Why a value cannot be part of a record.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ValueError {
    /// No field has this name.
    #[error("{layout} has no field '{field}'")]
    Field {
        /// The name of the record's type.
        layout: String,
        /// What was looked for.
        field: String,
    },
    /// A value of another type.
    #[error("{layout}: field {field}: expected {expected}")]
    Type {
        /// The name of the record's type.
        layout: String,
        /// The field.
        field: String,
        /// The field's type, as texts of interfaces write it.
        expected: String,
    },
}
