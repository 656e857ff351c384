//! `swanilda run`: a Lua file becomes a script of a fresh scene, and the simulation runs.
//!
//! This file reads the command line and builds the simulator; `session` holds the loop.

mod branches;
mod isolated;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use super::capture::{CaptureArgs, finish};
use super::fallen::Fallen;
use super::graphs::GraphArgs;
use super::hashes::{Compared, HashArgs};
use super::interrupt::Interrupt;
use super::launch::Launch;
use super::live::{Live, Viewed};
use super::output::Output;
use super::progress::Progress;
use super::recording::RecordArgs;
use super::remote::Remote;
use super::replay::{Captured, CommandLoop};
use super::session::{END, Reminder, Session};
use super::setup::{Setup, seconds};
use super::video::VideoArgs;
use super::view::ViewArgs;
use super::{Outcome, USAGE, complain};
use branches::BranchArgs;
use capture::Tape;
use format::robot_file::RobotFile;
use permissions::Permissions;
use simulator::{Builder, Options, Run, RunLimits, RunObserver, RunTotals, ScriptKind, Simulator};
use view::Viewer;

/// Exit code when a script raised an error.
const SCRIPT_ERROR: u8 = 1;
/// Exit code when a step is another one than in the file of --expect-hash.
const DIFFERENT: u8 = 3;

/// Run a scene
#[derive(clap::Args)]
pub(super) struct Args {
    /// Scene: a Lua file, a CoppeliaSim file, or a folder made by unpack
    scene: PathBuf,
    /// Script type to load the file as
    #[arg(long = "as", value_name = "KIND", default_value = "customization")]
    kind: Kind,
    /// Stop after N simulation steps
    #[arg(long, value_name = "N", conflicts_with = "time", value_parser = count, allow_negative_numbers = true)]
    steps: Option<u64>,
    /// Stop after this much simulated time
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    time: Option<f64>,
    /// Do not start the simulation; scripts may do so
    #[arg(long)]
    no_start: bool,
    /// Loop iterations before exiting with --no-start, or before a paused simulation is stopped
    #[arg(long, value_name = "L", default_value_t = 20, value_parser = count, allow_negative_numbers = true)]
    loops: u64,
    /// Run in a child process, and say in which plugin it has crashed if it does
    #[arg(long)]
    isolate: bool,
    #[command(flatten)]
    branches: BranchArgs,
    #[command(flatten)]
    video: VideoArgs,
    #[command(flatten)]
    record: RecordArgs,
    #[command(flatten)]
    graphs: GraphArgs,
    #[command(flatten)]
    pub(super) hashes: HashArgs,
    #[command(flatten)]
    remote: Remote,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    pub(super) capture: CaptureArgs,
    #[command(flatten)]
    pub(super) setup: Setup,
}

/// Script type of a Lua file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Kind {
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

/// Runs the scene; the exit code reports the outcome.
pub(super) fn run(args: &Args) -> Outcome {
    let plugin_note = isolated::note();
    let is_replay = args.capture.tape.is_on();
    if args.isolate && !is_replay && plugin_note.is_none() {
        return Ok(isolated::run());
    }
    let tape = args.capture.tape()?;
    let progress = Progress::new(
        args.limits(),
        args.setup.quiet || args.setup.json || args.no_start,
    );
    let pages = args.view.debugging(&tape);
    let mut launch = Launch::new(
        &args.setup,
        Some(&args.remote),
        Some(&args.scene),
        &progress,
        plugin_note,
        &tape,
        pages.as_ref(),
    )?;
    let begun = Instant::now();
    let is_robot = args.fill_and_classify(&mut launch, &tape)?;
    let Launch {
        mut sim,
        output,
        interrupt,
        watchdog,
        ..
    } = launch;
    let mut session = Session {
        interrupt: &interrupt,
        progress,
        output: &output,
        reminder: args.reminder(is_replay),
        fallen: if is_robot {
            Fallen::watch(&sim)
        } else {
            Fallen::default()
        },
        hashes: args.hashes.start()?,
    };
    if args.branches.is_asked_for() {
        return branches::run(args, sim, session);
    }
    sim.set_unseen(!args.shows_something());
    // A replay writes no files.
    let recorder = if is_replay {
        None
    } else {
        args.video.start(&mut sim, &args.scene);
        args.record.start(&sim)?
    };
    let viewer = args
        .view
        .start(&sim, pages.as_ref(), &args.remote, &output, &watchdog)?;
    let totals = args.simulate(&mut sim, viewer, &mut session);
    session.progress.finish();
    let recorded = args.record.finish(&sim, recorder);
    let graphs = if is_replay {
        Ok(())
    } else {
        args.graphs.write(&sim)
    };
    let written = args.video.finish(&mut sim).and(graphs).and(recorded);
    let last = session.hashes.last();
    let compared = session.hashes.finish();
    let (errors, code) = end(sim, &written, &interrupt);
    finish(&tape);
    let code = report_comparison(compared, code);
    output.hash(last);
    output.summary(totals, args.time, begun.elapsed(), errors, code);
    Ok(ExitCode::from(code))
}

/// Ends a run; the number of script errors, and the exit code.
fn end(mut sim: Simulator, written: &Result<(), String>, interrupt: &Interrupt) -> (u64, u8) {
    if sim.tape().signal(END, || interrupt.is_requested()) {
        sim.request_stop();
        // Scripts that outlive a run clean up when their scene is closed.
        sim.clear_scene();
    }
    let errors = sim.errors();
    drop(sim);
    if let Err(reason) = written {
        complain(reason);
    }
    let code = match (interrupt.is_requested(), written, errors) {
        (true, ..) => interrupt.exit_code(),
        (_, Err(_), _) => USAGE,
        (_, _, 0) => 0,
        _ => SCRIPT_ERROR,
    };
    (errors, code)
}

/// Says what became of the comparison of hashes; the exit code of the run with that.
fn report_comparison(compared: Result<Option<Compared>, String>, code: u8) -> u8 {
    match compared {
        Ok(None) => code,
        Ok(Some(compared)) => {
            complain(&compared.text);
            if compared.is_equal { code } else { DIFFERENT }
        }
        Err(reason) => {
            complain(&reason);
            USAGE
        }
    }
}

/// A whole number, zero or more.
fn count(text: &str) -> Result<u64, String> {
    text.parse()
        .map_err(|_| "a whole number is needed, zero or more".to_owned())
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
            Some(&self.scene),
            tape,
            interrupt,
            build,
        )
    }

    fn fill(&self, launch: &mut Launch<'_>, tape: &Tape) -> Result<(), String> {
        self.fill_and_classify(launch, tape).map(drop)
    }

    fn begin(&self, sim: &mut Simulator) -> CommandLoop {
        if self.view.is_asked_for() {
            CommandLoop::Viewed(self.viewed(sim))
        } else if self.no_start {
            CommandLoop::Free { left: self.loops }
        } else if sim.errors() > 0 && !self.has_end() {
            CommandLoop::Free { left: 0 }
        } else {
            CommandLoop::Run(Run::begin(sim, self.limits()))
        }
    }
}

impl Args {
    /// Fills the scene and starts the remote APIs; also whether the scene is a robot.
    fn fill_and_classify(&self, launch: &mut Launch<'_>, tape: &Tape) -> Result<bool, String> {
        let permissions = Permissions::all().on_tape(tape);
        let is_robot = RobotFile::is_one(&self.scene, &permissions);
        launch.fill(self.kind.into());
        launch.serve(&self.remote, self.remote.asks_for_zmq())?;
        Ok(is_robot)
    }

    /// A simulator with the scene in it, which `build` makes of the options.
    ///
    /// # Errors
    /// When a file cannot be read.
    pub(super) fn simulator(
        &self,
        interrupt: &Interrupt,
        build: impl FnOnce(Options) -> Simulator,
    ) -> Result<Simulator, String> {
        self.capture.refuse("swanilda debug")?;
        self.setup.debug.refuse("swanilda debug")?;
        let sources = self.setup.sources(Some(&self.scene), &Tape::default())?;
        let options = self.setup.options(Some(&self.scene), interrupt);
        let options = self.remote.guard(options);
        let mut sim = build(options);
        let kind = self.kind.into();
        self.setup.fill(&mut sim, sources, kind, Some(&self.scene));
        Ok(sim)
    }

    /// Starts the remote APIs that are asked for.
    ///
    /// # Errors
    /// When a port is not free.
    pub(super) fn serve(
        &self,
        sim: &mut Simulator,
        output: &Output,
        interrupt: &Interrupt,
    ) -> Result<(), String> {
        let zmq = self.remote.asks_for_zmq();
        self.remote.serve(zmq, &self.setup, sim, output, interrupt)
    }

    /// Runs the simulation to its end.
    pub(super) fn go(&self, sim: &mut Simulator, observer: &mut dyn RunObserver) -> RunTotals {
        if self.no_start {
            sim.loop_freely(self.loops, observer)
        } else if sim.errors() > 0 && !self.has_end() {
            RunTotals::default()
        } else {
            sim.run(self.limits(), observer)
        }
    }

    pub(super) fn limits(&self) -> RunLimits {
        RunLimits {
            steps: self.steps,
            time: self.time,
            idle: self.loops,
            once: false,
        }
    }

    /// Remote clients and --no-start end a run their own way.
    fn reminder(&self, is_replay: bool) -> Reminder {
        Reminder::new(
            is_replay
                || self.has_end()
                || self.no_start
                || self.remote.asks_for_zmq()
                || self.setup.json,
        )
    }

    fn simulate(
        &self,
        sim: &mut Simulator,
        viewer: Option<Viewer>,
        session: &mut Session,
    ) -> RunTotals {
        if self.view.is_asked_for() {
            self.run_viewed(sim, Live::new(viewer), session.interrupt)
        } else if self.no_start {
            sim.loop_freely(self.loops, session)
        } else if sim.errors() > 0 && !self.has_end() {
            // Without its script the run might never end.
            session.output.note(
                "A script failed while it was loaded: the simulation is not started.",
                0.0,
            );
            RunTotals::default()
        } else {
            sim.run(self.limits(), session)
        }
    }

    /// The same with pages that look on, which may pause and resume the simulation as long as they like.
    /// Whether somebody sees the scene while it runs.
    fn shows_something(&self) -> bool {
        self.view.is_asked_for() || self.video.is_asked_for() || self.record.is_asked_for()
    }

    fn run_viewed(&self, sim: &mut Simulator, mut live: Live, interrupt: &Interrupt) -> RunTotals {
        let mut viewed = self.viewed(sim);
        while viewed.iterate(sim, &mut live, || interrupt.is_requested()) {}
        viewed.totals()
    }

    fn viewed(&self, sim: &mut Simulator) -> Viewed {
        if !self.no_start {
            sim.start();
        }
        Viewed::new(self.limits(), self.no_start.then_some(self.loops))
    }

    fn has_end(&self) -> bool {
        self.steps.is_some() || self.time.is_some()
    }
}
