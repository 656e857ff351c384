//! `swanilda serve`: an idle simulator that programs outside drive.

use std::path::PathBuf;

use super::Outcome;
use super::capture::{CaptureArgs, finish};
use super::interrupt::Interrupt;
use super::launch::Launch;
use super::live::Live;
use super::progress::Progress;
use super::remote::Remote;
use super::replay::CommandLoop;
use super::setup::Setup;
use super::view::ViewArgs;
use capture::Tape;
use simulator::{Builder, RunLimits, ScriptKind, Simulator};

/// Start a simulator that remote API clients control
#[derive(clap::Args)]
pub(super) struct Args {
    /// Scene: a Lua file, a CoppeliaSim file, or a folder made by unpack [default: the default scene]
    scene: Option<PathBuf>,
    /// Do not start the ZeroMQ remote API
    #[arg(long, conflicts_with = "remote_api")]
    no_remote_api: bool,
    #[command(flatten)]
    remote: Remote,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    pub(super) capture: CaptureArgs,
    #[command(flatten)]
    pub(super) setup: Setup,
}

/// Serves until ctrl-c, SIGTERM or `quitSimulator()`.
pub(super) fn serve(args: &Args) -> Outcome {
    let tape = args.capture.tape()?;
    let progress = Progress::new(RunLimits::default(), true);
    let mut launch = Launch::new(
        &args.setup,
        Some(&args.remote),
        args.scene.as_deref(),
        &progress,
        None,
        &tape,
    )?;
    args.fill(&mut launch)?;
    let Launch {
        mut sim,
        output,
        interrupt,
        watchdog,
        ..
    } = launch;
    let viewer = args.view.start(&sim, &args.remote, &output, &watchdog)?;
    let code = Live::new(viewer).run(&mut sim, &interrupt);
    drop(sim);
    finish(&tape);
    Ok(code)
}

impl Args {
    fn fill(&self, launch: &mut Launch) -> Result<(), String> {
        launch.fill(ScriptKind::Customization);
        launch.serve(&self.remote, !self.no_remote_api)
    }

    /// The simulator of a capture at the beginning of its loop, and that loop.
    ///
    /// # Errors
    /// When a file cannot be read.
    pub(super) fn played(
        &self,
        tape: &Tape,
        interrupt: &Interrupt,
        build: impl FnOnce(Builder) -> Builder,
    ) -> Result<(Simulator, CommandLoop), String> {
        let mut launch = Launch::played(
            &self.setup,
            &self.remote,
            self.scene.as_deref(),
            tape,
            interrupt,
            build,
        )?;
        self.fill(&mut launch)?;
        Ok((launch.sim, CommandLoop::Live))
    }
}
