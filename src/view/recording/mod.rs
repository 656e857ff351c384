//! Recordings: what a simulator showed, in a file that can be played again from any second (docs/VIEW_PROTOCOL.md, "Recordings").
//!
//! A [`Writer`] appends chunk after chunk, so that a run that is killed leaves a file that can be read; a [`Recording`] reads any file
//! without trusting it.

mod chunk;
mod graphs;
mod index;
mod page;
mod reader;
mod recorder;
mod run;
#[cfg(test)]
mod tests;
mod writer;

pub(crate) use chunk::{Content, messages};
pub(crate) use graphs::read as graphs;
use index::ChunkPlace;
pub(crate) use index::{Index, Mark, MarkKind};
pub(crate) use page::{gzip, html};
pub(crate) use reader::Recording;
use recorder::Recorder;
pub(crate) use run::RunRecorder;
use writer::Writer;

const MAGIC: &[u8; 8] = b"SWRECORD";
const VERSION: u32 = 1;
/// At the end of a complete file, after the place of the index.
const END: &[u8; 8] = b"SWINDEX1";
/// Bytes of the file's head: magic, version, zero.
const FILE_HEAD: u64 = 16;
/// Bytes of a chunk's head: length, sum, time.
const CHUNK_HEAD: u64 = 16;
/// Bytes at the end of a file: the place of the index, and `END`.
const FILE_END: u64 = 16;
/// Bytes that a chunk or index may have when it is unpacked; more is no recording but an attack.
const LARGEST_CHUNK: u64 = 512 << 20;

/// Why a recording cannot be read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum RecordingError {
    #[error("it is not a recording of Swanilda")]
    NoRecording,
    #[error("it has version {0} of the format, and this program knows version {VERSION}")]
    Version(u32),
    #[error("it is damaged: {0}")]
    Damaged(&'static str),
    #[error("there is nothing in it")]
    Empty,
    #[error("{0}")]
    Io(#[from] std::io::Error),
}
