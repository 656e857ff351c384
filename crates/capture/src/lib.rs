//! Captures of runs: a file with everything that came from outside, in order, from which the run is repeated without the world outside.
//!
//! A [`Tape`] belongs to one simulator. Whoever reads the clock, a file, a socket or a device does so through [`Tape::input`]: when the run is captured, the
//! value that was read is written to the file; when it is replayed, the value comes from the file, and nothing is read. What inputs mean is not known
//! here: they have a kind, which is a name, and bytes.
//!
//! The file (`.swc`) is a head and frames of compressed records. A thread writes what is there several times a second, so that a process
//! that is killed leaves a capture up to shortly before its end: a last frame that is not whole is no error, the capture only ends before it.

mod frame;
mod reader;
mod record;
mod state;
mod tape;
mod value;
mod writer;

pub use reader::{CaptureError, Reader};
pub use record::{Header, Record};
pub use state::Mark;
pub use tape::{Lost, Tape, Verdict};
pub use value::{Input, Recorded};
