//! The frame of a recording: marks, sizes, and why a file is none.

pub(super) const MAGIC: &[u8; 8] = b"SWRECORD";
pub(super) const VERSION: u32 = 1;
/// At the end of a complete file, after the place of the index.
pub(super) const END: &[u8; 8] = b"SWINDEX1";
/// Bytes of the file's head: magic, version, zero.
pub(super) const FILE_HEAD: u64 = 16;
/// Bytes of a chunk's head: length, sum, time.
pub(super) const CHUNK_HEAD: u64 = 16;
/// Bytes at the end of a file: the place of the index, and `END`.
pub(super) const FILE_END: u64 = 16;
/// Bytes that a chunk or index may have when it is unpacked; more is no recording but an attack.
pub(super) const MAX_CHUNK: u64 = 512 << 20;

/// Why a recording cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The file begins otherwise than a recording.
    #[error("it is not a recording of Swanilda")]
    NoRecording,
    /// A recording of another version of the format.
    #[error("it has version {0} of the format, and this program knows version {VERSION}")]
    Version(u32),
    /// What is wrong in the file.
    #[error("it is damaged: {0}")]
    Damaged(&'static str),
    /// The file has no chunk that is whole.
    #[error("there is nothing in it")]
    Empty,
    /// An error of the system.
    #[error("{0}")]
    Io(#[from] std::io::Error),
}
