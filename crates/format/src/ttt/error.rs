//! Errors in files, with their position.

use thiserror::Error;

/// Why a file cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FileError {
    #[error("this is not a scene or model of CoppeliaSim: it begins with other bytes than 'VREP'.")]
    NotAScene,
    #[error("the file ends within its header.")]
    ShortHeader,
    #[error(
        "the file was written by a program too old (serialization {0}, before V-REP 2.6.8). Open and save it with a V-REP of 3.x first."
    )]
    TooOld(i32),
    #[error("the file can be read by newer programs only (serialization {0} at least; this program knows 25).")]
    TooNew(i32),
    #[error("the file is compressed by an unknown method, {0}.")]
    Compression(u8),
    #[error("the compressed data are damaged: {0}.")]
    Inflate(&'static str),
    #[error("offset {offset} of the uncompressed data, in {path}: {what}.")]
    Chunk {
        /// Bytes from the beginning of the uncompressed body.
        offset: usize,
        /// The tags on the way to the place, such as `SHP/Ge2/Gst`.
        path: String,
        what: String,
    },
    #[error("line {line}, column {column}, in {path}: {what}.")]
    Element {
        line: usize,
        /// Bytes from the beginning of the line, from 1.
        column: usize,
        /// The elements on the way to the place, such as `CoppeliaSim/joint/common`.
        path: String,
        what: String,
    },
}

pub type FileResult<T> = Result<T, FileError>;
