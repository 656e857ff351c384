//! Opening a capture to go to its moments.

use std::path::Path;

use capture::{CaptureError, Header, Tape};
use simulator::{Builder, Playback, Simulator};

use super::{CommandLoop, command};
use crate::cli::Command;
use crate::cli::interrupt::Interrupt;
use crate::cli::launch::Launch;
use crate::cli::setup::Setup;
use crate::cli::test::CommonArgs;

/// Whether a file is a capture, by its first bytes.
pub(in crate::cli) fn is_capture(path: &Path) -> bool {
    !matches!(
        capture::Reader::open(path),
        Err(CaptureError::Io(_) | CaptureError::NoCapture)
    )
}

/// The options, the header and the tape of a capture of tests; None for other captures.
///
/// # Errors
/// When the file cannot be read.
pub(in crate::cli) fn tests_of(path: &Path) -> Result<Option<(CommonArgs, Header, Tape)>, String> {
    let unreadable = |reason: String| format!("cannot read {}: {reason}", path.display());
    let (tape, header) = Tape::replaying(path).map_err(|error| unreadable(error.to_string()))?;
    Ok(match command(&header).map_err(unreadable)? {
        Command::Test(test) => Some((test.common, header, tape)),
        Command::Search(search) => Some((search.common, header, tape)),
        _ => None,
    })
}

/// A command whose captures are played.
pub(in crate::cli) trait Captured {
    /// Its options about the simulator.
    fn setup(&mut self) -> &mut Setup;

    /// A simulator without a scene, in which everything comes from the tape. `build` adds a console, and a debugger if there is one.
    ///
    /// # Errors
    /// When a file cannot be read.
    fn launch(
        &self,
        tape: &Tape,
        interrupt: &Interrupt,
        build: impl FnOnce(Builder) -> Builder,
    ) -> Result<Launch<'_>, String>;

    /// Fills the scene, and starts the remote APIs.
    ///
    /// # Errors
    /// When a port is not free.
    fn fill(&self, launch: &mut Launch<'_>, tape: &Tape) -> Result<(), String>;

    /// The loop of the command, which begins.
    fn begin(&self, sim: &mut Simulator) -> CommandLoop;
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
    let open = Opening {
        tape: &tape,
        threads,
        interrupt,
    };
    let playback = match command {
        Command::Run(run) => open.playback(*run, build)?,
        Command::Serve(serve) => open.playback(serve, build)?,
        Command::View(view) => open.playback(view, build)?,
        Command::Test(_) | Command::Search(_) | Command::Batch(_) => {
            let reason = "the capture of a test or a batch runs from its beginning to its end only: see `swanilda replay`";
            return Err(unreadable(reason.into()));
        }
        _ => {
            return Err(unreadable(
                "it is the capture of a command that runs nothing".into(),
            ));
        }
    };
    Ok((playback, header))
}

/// What a capture is opened with.
struct Opening<'a> {
    tape: &'a Tape,
    threads: Option<u16>,
    interrupt: &'a Interrupt,
}

impl Opening<'_> {
    /// The run of a command at the beginning of its loop.
    fn playback(
        &self,
        mut command: impl Captured,
        build: impl FnOnce(Builder) -> Builder,
    ) -> Result<Playback<CommandLoop>, String> {
        let setup = command.setup();
        setup.for_replay(self.threads);
        setup.json = false;
        let mut launch = command.launch(self.tape, self.interrupt, build)?;
        command.fill(&mut launch, self.tape)?;
        let mut sim = launch.sim;
        let command_loop = command.begin(&mut sim);
        Ok(Playback::new(sim, command_loop))
    }
}
