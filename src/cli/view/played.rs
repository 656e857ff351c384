//! `swanilda view` of a capture: it is played with a timeline, and goes on live where a page wants that.

use std::path::Path;
use std::process::ExitCode;

use super::{Args, Mode, view_recording};
use crate::cli::Outcome;
use crate::cli::interrupt::Interrupt;
use crate::cli::live::Live;
use crate::cli::replay::{CommandLoop, open, tests_of, warn_of_version};
use crate::cli::{complain, test};
use view::CaptureViewer;

/// Shows a capture until ctrl-c or SIGTERM, or until what goes on from it ends.
pub(super) fn view(args: &Args, path: &Path) -> Outcome {
    args.capture.refuse("the view of a capture")?;
    if let Some((command, header, tape)) = tests_of(path)? {
        warn_of_version(&header, args.setup.quiet);
        // The test itself drives the simulator, so it runs to its end, and what is shown is a recording of that.
        let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
        let (recording, message) = test::record(&command, &header, &tape, folder.path())?;
        complain(&format!("the test has failed: {message}"));
        return view_recording(args, &recording);
    }
    let interrupt = Interrupt::of_scripts_here();
    let (file, asked) = (path.to_owned(), interrupt.clone());
    let again = move || open(&file, None, &asked, simulator::Builder::observed);
    let (playback, header) = again()?;
    warn_of_version(&header, args.setup.quiet);
    let is_read_only = args.view == Mode::ReadOnly;
    let started = CaptureViewer::start(
        playback,
        move || again().map(|(playback, _)| playback),
        args.listen()?,
        is_read_only,
    );
    let mut viewer = started.map_err(|error| args.failed(&error))?;
    viewer.set_speed(args.speed);
    let watchdog = interrupt.watchdog(!args.setup.json);
    watchdog.show_on(viewer.busy_sign());
    args.announce(&viewer.url(), &interrupt);
    play(viewer, &interrupt)
}

fn play(mut viewer: CaptureViewer<CommandLoop>, interrupt: &Interrupt) -> Result<ExitCode, String> {
    while !interrupt.is_requested() {
        if viewer.attend()? {
            let (mut sim, viewer) = viewer.go_live();
            return Ok(Live::new(Some(viewer)).run(&mut sim, interrupt));
        }
    }
    Ok(interrupt.outcome())
}
