//! `swanilda debug`: runs a scene for a debugger that speaks the Debug Adapter Protocol.

mod capture;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;
use std::rc::Rc;

use clap::Parser;

use super::debugging::{listen, standard_streams};
use super::interrupt::Interrupt;
use super::progress::Progress;
use super::replay::is_capture;
use super::session::rest;
use super::{Outcome, USAGE, run};
use debugger::{Ending, Launch, Link, Session};
use script::log::verbosity;
use simulator::{Console, LogLine, Options, RunObserver, Simulator};

/// Run a scene for an editor: breakpoints, steps and variables of Lua scripts
///
/// Speaks the Debug Adapter Protocol on standard input and output, or on a port of this machine.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Scene: a Lua file, a CoppeliaSim file, a folder made by unpack, or a capture (.swc), in which steps go back as well [default: what the editor launches]
    scene: Option<PathBuf>,
    /// Listen on this port instead of standard input (0: any free port, which is printed)
    #[arg(long, value_name = "PORT")]
    port: Option<u16>,
    /// Let scripts in Python listen for debugpy, which has to be installed; each prints its port
    #[arg(long)]
    debug_python: bool,
    /// Options of `swanilda run`, after `--`
    #[arg(last = true, value_name = "OPTIONS")]
    options: Vec<OsString>,
}

/// What a launched scene is run with: the command line of `run`.
#[derive(clap::Parser)]
#[command(name = "swanilda debug")]
struct Launched {
    #[command(flatten)]
    run: run::Args,
}

/// Serves one client, until it goes or the run is over.
pub(super) fn debug(args: &Args) -> Outcome {
    let interrupt = Interrupt::of_scripts_here();
    let session = Session::new(connect(args)?, false);
    if args.scene.as_deref().is_some_and(is_capture) {
        session.expect_replay();
    }
    while let Some(launch) = session.wait_for_launch(|| interrupt.is_requested()) {
        let code = run_once(args, &launch, &session, &interrupt).unwrap_or_else(|reason| {
            session.print("stderr", &format!("{reason}\n"));
            USAGE
        });
        if session.ending() != Some(Ending::Restart) {
            session.finish(code);
            return Ok(ExitCode::from(code));
        }
        session.begin_again();
    }
    Ok(interrupt.outcome())
}

fn connect(args: &Args) -> Result<Link, String> {
    args.port.map_or_else(standard_streams, listen)
}

/// One run from its beginning to its end; the exit code.
fn run_once(
    args: &Args,
    launch: &Launch,
    session: &Rc<Session>,
    interrupt: &Interrupt,
) -> Result<u8, String> {
    if let Some(folder) = &launch.cwd {
        std::env::set_current_dir(folder)
            .map_err(|error| format!("cannot run in {}: {error}", folder.display()))?;
    }
    let program = launch.program.as_ref().or(args.scene.as_ref());
    if let Some(file) = program.filter(|program| is_capture(program)) {
        return capture::debug(file, session, interrupt);
    }
    let launched = command_line(args, launch)?;
    let progress = Progress::new(launched.run.limits(), true);
    let output = launched.run.setup.output(&progress, interrupt);
    let debug_python = args.debug_python || launch.debug_python;
    let mut sim = launched.run.simulator(interrupt, |options| {
        Simulator::builder()
            .options(Options {
                debug_python,
                ..options
            })
            .console(Box::new(Printer(Rc::clone(session))))
            .debugger(session.clone())
            .build()
    })?;
    launched.run.serve(&mut sim, &output, interrupt)?;
    let mut observer = Observer { session, interrupt };
    launched.run.go(&mut sim, &mut observer);
    if session.ending().is_some() || interrupt.is_requested() {
        sim.stop();
    }
    Ok(u8::from(sim.errors() > 0))
}

fn command_line(args: &Args, launch: &Launch) -> Result<Launched, String> {
    let program = launch.program.as_ref().or(args.scene.as_ref());
    let program = program.ok_or("launch: program has to be a scene or script")?;
    let words = std::iter::once(OsString::from("swanilda debug"))
        .chain(args.options.iter().cloned())
        .chain(launch.args.iter().map(OsString::from))
        .chain([OsString::from("--"), program.clone().into_os_string()]);
    Launched::try_parse_from(words).map_err(|error| error.to_string())
}

/// The output of scripts and simulator, as the client shows it.
struct Printer(Rc<Session>);

impl Console for Printer {
    fn print(&mut self, line: &[u8], _: f64) {
        let line = String::from_utf8_lossy(line);
        self.0.print("stdout", &format!("{line}\n"));
    }

    fn log(&mut self, line: &LogLine<'_>) {
        let is_error = verbosity::plain(line.level) == verbosity::SCRIPT_ERRORS;
        let category = if is_error { "stderr" } else { "console" };
        self.0.print(category, &format!("{}\n", line.located()));
    }
}

struct Observer<'a> {
    session: &'a Session,
    interrupt: &'a Interrupt,
}

impl RunObserver for Observer<'_> {
    fn should_stop(&self, _: &Simulator) -> bool {
        self.interrupt.is_requested() || self.session.ending().is_some()
    }

    fn iterated(&mut self, sim: &Simulator, stepped: bool) {
        if !stepped {
            rest(sim);
        }
    }
}
