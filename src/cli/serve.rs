//! `swanilda serve`: an idle simulator that programs outside drive.

use std::path::PathBuf;
use std::process::ExitCode;

use super::interrupt::Interrupt;
use super::live::Live;
use super::progress::Progress;
use super::refuse;
use super::remote::Remote;
use super::setup::Setup;
use super::view::ViewArgs;
use crate::{RunLimits, ScriptKind, Simulator};

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
    setup: Setup,
}

/// Serves until ctrl-c, SIGTERM or `quitSimulator()`.
pub(super) fn serve(args: &Args) -> ExitCode {
    let scene = args.scene.as_deref();
    let sources = match args.setup.sources(scene) {
        Ok(sources) => sources,
        Err(reason) => return refuse(&reason),
    };
    let interrupt = Interrupt::of_scripts_here();
    let output = args.setup.output(&Progress::new(RunLimits::default(), true), &interrupt);
    let options = args.remote.guard(args.setup.options(scene, &interrupt));
    let mut sim = Simulator::with_console(options, Box::new(output.clone()));
    args.setup.fill(&mut sim, sources, ScriptKind::Customization, scene);
    if let Err(reason) = args.remote.serve(!args.no_remote_api, &args.setup, &mut sim, &output, &interrupt) {
        return refuse(&reason);
    }
    let mut live = match args.view.start(&sim, &args.remote, &output) {
        Ok(viewer) => Live::new(viewer),
        Err(reason) => return refuse(&reason),
    };
    while !interrupt.is_requested() && !sim.quit_requested() {
        live.iterate(&mut sim);
    }
    sim.stop();
    sim.clear_scene();
    ExitCode::SUCCESS
}
