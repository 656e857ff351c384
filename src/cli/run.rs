//! `swanilda run`.

use std::path::PathBuf;
use std::process::ExitCode;

use super::output::Text;
use crate::{Options, ScriptKind, SimulationState, Simulator};

/// Run a scene script.
#[derive(clap::Args)]
pub(super) struct Args {
    /// The Lua file
    scene: PathBuf,
    /// What the file becomes
    #[arg(long = "as", value_name = "KIND", default_value = "customization")]
    kind: Kind,
    /// Start from nothing instead of the default scene
    #[arg(long)]
    empty: bool,
    /// Stop after that many steps
    #[arg(long, value_name = "N")]
    steps: Option<u64>,
    /// Do not start the simulation from outside
    #[arg(long)]
    no_start: bool,
    /// Idle passes before the end
    #[arg(long, value_name = "L", default_value_t = 20)]
    loops: u64,
    /// No chatter, no summary
    #[arg(long, short)]
    quiet: bool,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Kind {
    Customization,
    Simulation,
    Addon,
    Sandbox,
    Main,
}

pub(super) fn run(args: &Args) -> ExitCode {
    let code = match std::fs::read(&args.scene) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("swanilda: cannot read {}: {error}", args.scene.display());
            return ExitCode::from(2);
        }
    };
    let mut sim = Simulator::with_console(Options::default(), Box::new(Text { quiet: args.quiet }));
    let kind = match args.kind {
        Kind::Customization => ScriptKind::Customization,
        Kind::Simulation => ScriptKind::Simulation,
        Kind::Addon => ScriptKind::AddOn,
        Kind::Sandbox => ScriptKind::Sandbox,
        Kind::Main => ScriptKind::Main,
    };
    let name = args.scene.file_stem().map_or_else(|| "Script".into(), |stem| stem.to_string_lossy().into_owned());
    let _ = sim.add_script(kind, &name, &code);
    if args.no_start {
        for _ in 0..args.loops {
            if sim.quit_requested() {
                break;
            }
            sim.pass();
        }
    } else {
        sim.start();
        let mut idle = 0;
        let mut asked = false;
        while sim.state() != SimulationState::Stopped && !sim.quit_requested() {
            asked = asked && sim.state() != SimulationState::Paused;
            if !asked && (args.steps.is_some_and(|n| sim.steps() >= n) || idle > args.loops) {
                sim.request_stop();
                asked = true;
            }
            if sim.state() == SimulationState::Paused {
                idle += 1;
            }
            sim.pass();
        }
        sim.pass();
    }
    if sim.errors() > 0 { ExitCode::from(1) } else { ExitCode::SUCCESS }
}
