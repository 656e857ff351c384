//! Standard output, and whether everything got there: a full disk is an error of the command, a reader that has seen enough is none.

use std::io::{Error, ErrorKind, Write};
use std::sync::OnceLock;

/// Why the first thing was lost.
static LOST: OnceLock<String> = OnceLock::new();

/// Writes at once, for readers of a pipe.
pub(super) fn say(text: &[u8]) {
    let mut out = std::io::stdout().lock();
    note(&out.write_all(text).and_then(|()| out.flush()));
}

/// Remembers that something could not be written; true if so. A closed pipe is not an error.
pub(super) fn note(written: &Result<(), Error>) -> bool {
    let Err(error) = written else { return false };
    let is_lost = error.kind() != ErrorKind::BrokenPipe;
    if is_lost {
        LOST.get_or_init(|| format!("cannot write to standard output: {error}"));
    }
    is_lost
}

/// Why something that was to be on standard output is not there.
pub(super) fn lost() -> Option<&'static str> {
    LOST.get().map(String::as_str)
}
