//! Errors in files, with their position.

use thiserror::Error;

/// Why a file cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FileError {
    /// The file does not begin as scenes and models do.
    #[error("this is not a scene or model of CoppeliaSim: it begins with other bytes than 'VREP'.")]
    NotAScene,
    /// The header is incomplete.
    #[error("the file ends within its header.")]
    ShortHeader,
    #[error(
        "the file was written by a program too old (serialization {0}, before V-REP 2.6.8). Open and save it with a V-REP of 3.x first."
    )]
    /// The format is older than those that are read; its number.
    TooOld(i32),
    /// The format is newer than those that are read; the number it needs.
    #[error(
        "the file can be read by newer programs only (serialization {0} at least; this program knows 25)."
    )]
    TooNew(i32),
    /// An unknown method of compression; its number.
    #[error("the file is compressed by an unknown method, {0}.")]
    Compression(u8),
    /// The compressed data are damaged.
    #[error("the compressed data are damaged: {0}.")]
    Inflate(&'static str),
    /// A chunk is damaged.
    #[error("offset {offset} of the uncompressed data, in {path}: {what}.")]
    Chunk {
        /// Bytes from the beginning of the uncompressed body.
        offset: usize,
        /// The tags on the way to the place, such as `SHP/Ge2/Gst`.
        path: String,
        /// What is wrong.
        what: String,
    },
    /// An element of an XML file is wrong.
    #[error("line {line}, column {column}, in {path}: {what}.")]
    Element {
        /// Line of the element, from 1.
        line: usize,
        /// Bytes from the beginning of the line, from 1.
        column: usize,
        /// The elements on the way to the place, such as `CoppeliaSim/joint/common`.
        path: String,
        /// What is wrong.
        what: String,
    },
}

/// The result of reading a file.
pub type FileResult<T> = Result<T, FileError>;
