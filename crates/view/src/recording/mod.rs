//! Recordings: what a simulator showed, in a file that can be played again from any second (docs/VIEW_PROTOCOL.md, "Recordings").
//!
//! A [`Writer`] appends chunk after chunk, so that a run that is killed leaves a file that can be read; a [`Recording`] reads any file
//! without trusting it.

mod chunk;
mod format;
mod graphs;
mod index;
mod page;
mod reader;
mod recorder;
mod run;
#[cfg(test)]
mod tests;
mod writer;

pub use chunk::{Content, messages};
pub use format::RecordingError;
use format::{CHUNK_HEAD, END, FILE_END, FILE_HEAD, MAGIC, MAX_CHUNK, VERSION};
pub use graphs::read as graphs;
use index::ChunkPlace;
pub(crate) use index::{Index, Mark, MarkKind};
pub use page::{gzip, html};
pub use reader::Recording;
pub use recorder::Recorded;
use recorder::Recorder;
pub use run::RunRecorder;
pub(crate) use run::path;
use writer::Writer;
