//! `swanilda serve`: an idle simulator that programs outside drive.

use std::path::PathBuf;

use super::Outcome;
use super::capture::{CaptureArgs, finish};
use super::interrupt::Interrupt;
use super::launch::Launch;
use super::live::Live;
use super::progress::Progress;
use super::remote::Remote;
use super::replay::{Captured, CommandLoop};
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
    let pages = args.view.debugging(&tape);
    let mut launch = Launch::new(
        &args.setup,
        Some(&args.remote),
        args.scene.as_deref(),
        &progress,
        None,
        &tape,
        pages.as_ref(),
    )?;
    args.fill(&mut launch, &tape)?;
    let Launch {
        mut sim,
        output,
        interrupt,
        watchdog,
        ..
    } = launch;
    let viewer = args
        .view
        .start(&sim, pages.as_ref(), &args.remote, &output, &watchdog)?;
    let code = Live::new(viewer).run(&mut sim, &interrupt);
    drop(sim);
    finish(&tape);
    Ok(code)
}

impl Captured for Args {
    fn setup(&mut self) -> &mut Setup {
        &mut self.setup
    }

    fn launch(
        &self,
        tape: &Tape,
        interrupt: &Interrupt,
        build: impl FnOnce(Builder) -> Builder,
    ) -> Result<Launch<'_>, String> {
        Launch::played(
            &self.setup,
            &self.remote,
            self.scene.as_deref(),
            tape,
            interrupt,
            build,
        )
    }

    fn fill(&self, launch: &mut Launch<'_>, _: &Tape) -> Result<(), String> {
        launch.fill(ScriptKind::Customization);
        launch.serve(&self.remote, !self.no_remote_api)
    }

    fn begin(&self, _: &mut Simulator) -> CommandLoop {
        CommandLoop::Live
    }
}
