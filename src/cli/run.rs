//! `swanilda run`: a Lua file becomes a script of a fresh scene, and the simulation runs.
//!
//! This file reads the command line and builds the simulator; `session` holds the loop.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use super::interrupt::Interrupt;
use super::output::{Format, Output};
use super::progress::Progress;
use super::refuse;
use super::session::{Limits, Session};
use crate::script::verbosity;
use crate::{Options, ScriptKind, Simulator};

/// Exit code when a script raised an error.
const SCRIPT_ERROR: u8 = 1;
/// Exit code after ctrl-c, as shells expect it.
const INTERRUPTED: u8 = 130;

/// Run a Lua scene
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
    /// Ask for the end after that many simulation steps
    #[arg(long, value_name = "N", conflicts_with = "time")]
    steps: Option<u64>,
    /// Ask for the end after that much simulated time
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<f64>,
    /// Length of a simulation step
    #[arg(long, value_name = "SECONDS", value_parser = step_length)]
    dt: Option<f64>,
    /// Keep pace with the wall clock
    #[arg(long)]
    realtime: bool,
    /// Leave it to the scripts to start the simulation
    #[arg(long)]
    no_start: bool,
    /// Passes before the end with --no-start; idle passes before a paused simulation is ended
    #[arg(long, value_name = "L", default_value_t = 20)]
    loops: u64,
    /// Seed of the scripts' random numbers
    #[arg(long)]
    seed: Option<u32>,
    /// Lua instructions that stand for a millisecond of a thread's time slice
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    instructions_per_ms: Option<u64>,
    /// A named parameter scripts can read (sim.getNamedStringParam); may be repeated
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = named_param)]
    define: Vec<(String, String)>,
    /// Folder of the data scripts keep beyond a run [default: where the system keeps the user's]
    #[arg(long, value_name = "FOLDER")]
    data_dir: Option<PathBuf>,
    /// A Lua file to load as an add-on first; may be repeated
    #[arg(long, value_name = "FILE")]
    addon: Vec<PathBuf>,
    /// Highest level of log lines to show: none, errors, warnings, loadinfos, scripterrors, scriptwarnings, scriptinfos, infos,
    /// debug or trace
    #[arg(long, value_name = "LEVEL", value_parser = level)]
    verbosity: Option<i64>,
    /// One JSON object per line printed or logged, then a summary, all on standard output
    #[arg(long)]
    json: bool,
    /// No chatter of the simulator and no summary
    #[arg(long, short)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Kind {
    Customization,
    Simulation,
    Addon,
    Sandbox,
    Main,
}

impl From<Kind> for ScriptKind {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Customization => Self::Customization,
            Kind::Simulation => Self::Simulation,
            Kind::Addon => Self::AddOn,
            Kind::Sandbox => Self::Sandbox,
            Kind::Main => Self::Main,
        }
    }
}

/// Runs the scene; the exit code tells how it went.
pub(super) fn run(args: &Args) -> ExitCode {
    let sources = match args.sources() {
        Ok(sources) => sources,
        Err(reason) => return refuse(&reason),
    };
    let interrupt = Interrupt::install(INTERRUPTED);
    let progress = Progress::new(args.limits(), args.quiet || args.json || args.no_start);
    let output = Output::new(if args.json { Format::Json } else { Format::Text }, args.quiet, progress.bar());
    let begun = Instant::now();
    let mut sim = Simulator::with_console(args.options(), Box::new(output.clone()));
    args.fill(&mut sim, &sources);
    let failed_to_load = sim.errors() > 0;
    let mut session = Session::new(&mut sim, args.limits(), args.loops, &interrupt, progress, &output);
    if args.no_start {
        session.loop_freely()
    } else if failed_to_load && !args.limits().are_set() {
        // Without its script the run might never end.
        output.note("A script failed while it was loaded: the simulation is not started.", 0.0);
    } else {
        session.run_simulation()
    }
    let (steps, time) = session.totals();
    if interrupt.is_requested() {
        // Scripts that outlive a run clean up when their scene is closed.
        sim.clear_scene();
    }
    let errors = sim.errors();
    drop(sim);
    let code = match (interrupt.is_requested(), errors) {
        (true, _) => INTERRUPTED,
        (false, 0) => 0,
        (false, _) => SCRIPT_ERROR,
    };
    output.summary(steps, time, begun.elapsed(), errors, code);
    ExitCode::from(code)
}

/// A script file: its name without extension, and its text.
type Source = (String, Vec<u8>);

/// The files of the command line, read.
struct Sources {
    scene: Source,
    add_ons: Vec<Source>,
}

impl Args {
    fn sources(&self) -> Result<Sources, String> {
        let add_ons = self.addon.iter().map(|path| read(path)).collect::<Result<_, _>>()?;
        Ok(Sources { scene: read(&self.scene)?, add_ons })
    }

    fn options(&self) -> Options {
        let mut options = Options {
            named_params: self.define.iter().cloned().collect(),
            data_dir: self.data_dir.clone(),
            package_dirs: vec![folder_of(&self.scene)],
            ..Options::default()
        };
        options.seed = self.seed.unwrap_or(options.seed);
        options.instructions_per_ms = self.instructions_per_ms.unwrap_or(options.instructions_per_ms);
        options.verbosity = self.verbosity.unwrap_or(options.verbosity);
        options
    }

    fn limits(&self) -> Limits {
        Limits { steps: self.steps, time: self.time }
    }

    /// Add-ons come with the application, so they start first; then the scene and its script.
    fn fill(&self, sim: &mut Simulator, sources: &Sources) {
        for (name, code) in &sources.add_ons {
            // A script that fails has said so in the log, and is counted.
            let _ = sim.add_script(ScriptKind::AddOn, name, code);
        }
        sim.scene_mut().modify_settings(|settings| {
            settings.time_step = self.dt.unwrap_or(settings.time_step);
            settings.real_time |= self.realtime;
            settings.path = std::path::absolute(&self.scene).unwrap_or_default().to_string_lossy().into_owned();
        });
        if !self.empty {
            // An add-on that fills the scene leaves no room for more: nothing is missing then.
            let _ = sim.scene_mut().add_default_objects();
        }
        let (name, code) = &sources.scene;
        let _ = sim.add_script(self.kind.into(), name, code);
        if self.kind == Kind::Addon && self.empty {
            // What an add-on made before there was a scene does not belong to it.
            sim.clear_scene();
        }
    }
}

fn read(path: &Path) -> Result<Source, String> {
    let code = std::fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let name = path.file_stem().map_or_else(|| "Script".into(), |stem| stem.to_string_lossy().into_owned());
    Ok((name, code))
}

/// The folder a file lies in; scripts find their modules there.
fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if folder != Path::new("") => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds >= 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err("a number of seconds is needed".into()),
    }
}

fn step_length(text: &str) -> Result<f64, String> {
    let dt = seconds(text)?;
    if (0.0001..=10.0).contains(&dt) { Ok(dt) } else { Err("a step lasts 0.0001 to 10 seconds".into()) }
}

fn named_param(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() => Ok((name.to_owned(), value.to_owned())),
        _ => Err("NAME=VALUE is needed".into()),
    }
}

fn level(text: &str) -> Result<i64, String> {
    let number = || text.parse().ok().filter(|level| (0..=1000).contains(level));
    verbosity::from_name(text).or_else(number).ok_or_else(|| "unknown level".into())
}
