//! Opening a capture to go to its moments.

use std::path::Path;

use capture::{CaptureError, Header, Tape};
use simulator::{Builder, Playback};

use super::{CommandLoop, command};
use crate::cli::Command;
use crate::cli::interrupt::Interrupt;

/// Whether a file is a capture, by its first bytes.
pub(in crate::cli) fn is_capture(path: &Path) -> bool {
    !matches!(
        capture::Reader::open(path),
        Err(CaptureError::Io(_) | CaptureError::NoCapture)
    )
}

/// The command, the header and the tape of a capture of tests; None for other captures.
///
/// # Errors
/// When the file cannot be read.
pub(in crate::cli) fn tests_of(
    path: &Path,
) -> Result<Option<(crate::cli::test::Args, Header, Tape)>, String> {
    let unreadable = |reason: String| format!("cannot read {}: {reason}", path.display());
    let (tape, header) = Tape::replaying(path).map_err(|error| unreadable(error.to_string()))?;
    Ok(match command(&header).map_err(unreadable)? {
        Command::Test(test) => Some((test, header, tape)),
        _ => None,
    })
}

/// The run of a capture, at its beginning. `build` adds a console, and a debugger if there is one.
///
/// # Errors
/// When the file cannot be read, or is the capture of something else than a run.
pub(in crate::cli) fn open(
    path: &Path,
    threads: Option<u16>,
    interrupt: &Interrupt,
    build: impl FnOnce(Builder) -> Builder,
) -> Result<(Playback<CommandLoop>, Header), String> {
    let unreadable = |reason: String| format!("cannot read {}: {reason}", path.display());
    let (tape, header) = Tape::replaying(path).map_err(|error| unreadable(error.to_string()))?;
    let command = command(&header).map_err(unreadable)?;
    let (sim, command_loop) = match command {
        Command::Run(mut run) => {
            run.setup.for_replay(threads);
            run.setup.json = false;
            run.played(&tape, interrupt, build)?
        }
        Command::Serve(mut serve) => {
            serve.setup.for_replay(threads);
            serve.setup.json = false;
            serve.played(&tape, interrupt, build)?
        }
        Command::View(mut view) => {
            view.setup.for_replay(threads);
            view.setup.json = false;
            view.played(&tape, interrupt, build)?
        }
        Command::Test(_) | Command::Batch(_) => {
            let reason = "the capture of a test or a batch runs from its beginning to its end only: see `swanilda replay`";
            return Err(unreadable(reason.into()));
        }
        _ => {
            return Err(unreadable(
                "it is the capture of a command that runs nothing".into(),
            ));
        }
    };
    Ok((Playback::new(sim, command_loop), header))
}
