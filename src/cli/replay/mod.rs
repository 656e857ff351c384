//! `swanilda replay`: the run of a capture again, without the world outside, compared step by step.
//!
//! The command line of the capture is performed again with a tape that replays: what the run asks of the world outside comes from the capture.

mod command_loop;
mod moments;
mod open;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use capture::{Header, Tape, Verdict};
use clap::builder::Resettable;
use clap::{CommandFactory, FromArgMatches};
use io::signals::reserve_standard_output;
use serde_json::json;

use super::session::capture::CaptureArgs;
use super::setup::Setup;
use super::{Cli, Command, Outcome, complain};
pub(super) use command_loop::CommandLoop;
use moments::MomentArgs;
pub(super) use open::{Captured, is_capture, open, tests_of};

/// Exit code when the run differs from its capture.
const DIFFERS: u8 = 1;

/// Repeat a run that was captured, and compare each step
#[derive(clap::Args)]
pub(super) struct Args {
    /// Capture (.swc), written with --capture
    capture: PathBuf,
    /// Threads that compute mechanisms and draw pictures; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Print JSON lines (output, log and the comparison) on standard output
    #[arg(long)]
    json: bool,
    /// Suppress status messages
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    moments: MomentArgs,
}

/// The command line of a capture is being read: folders that it names need not be there.
static READS_CAPTURE: AtomicBool = AtomicBool::new(false);

/// Whether folders of the command line may be elsewhere.
pub(super) fn reads_capture() -> bool {
    READS_CAPTURE.load(Ordering::Relaxed)
}

/// Repeats the run; the exit code says whether it was the same.
pub(super) fn replay(args: &Args) -> Outcome {
    if args.moments.is_any() {
        return moments::answer(args);
    }
    let unreadable = |reason: String| format!("cannot read {}: {reason}", args.capture.display());
    let (tape, header) =
        Tape::replaying(&args.capture).map_err(|error| unreadable(error.to_string()))?;
    args.warn_of_version(&header);
    let command = command(&header).map_err(unreadable)?;
    let (is_json, is_quiet) = (args.json, args.quiet);
    tape.on_end(move |verdict| {
        // A run that has differed goes nowhere.
        report(verdict, is_json, is_quiet);
        std::process::exit(i32::from(code_of(verdict)));
    });
    args.perform(command, &header, &tape)
        .map_err(unreadable)??;
    let verdict = tape.finish().ok().flatten();
    let verdict = verdict.unwrap_or(Verdict::Unreadable("the run has no end".into()));
    report(&verdict, is_json, is_quiet);
    Ok(ExitCode::from(code_of(&verdict)))
}

impl Args {
    fn warn_of_version(&self, header: &Header) {
        warn_of_version(header, self.quiet);
    }

    /// Performs the captured command; an error in the first place when captures have no such command.
    fn perform(&self, command: Command, header: &Header, tape: &Tape) -> Result<Outcome, String> {
        Ok(match command {
            Command::Run(mut run) => {
                run.hashes.without_files();
                self.adapt(&mut run.setup, &mut run.capture, tape);
                super::run::run(&run)
            }
            Command::Serve(mut serve) => {
                self.adapt(&mut serve.setup, &mut serve.capture, tape);
                super::serve::serve(&serve)
            }
            Command::View(mut view) => {
                self.adapt(&mut view.setup, &mut view.capture, tape);
                super::view::view(&view)
            }
            Command::Test(test) => {
                super::test::replay(&test.common, header, tape)?;
                Ok(ExitCode::SUCCESS)
            }
            Command::Search(search) => {
                super::test::replay(&search.common, header, tape)?;
                Ok(ExitCode::SUCCESS)
            }
            Command::Batch(batch) => {
                super::batch::replay(&batch, header, tape)?;
                Ok(ExitCode::SUCCESS)
            }
            _ => return Err("it is the capture of a command that runs nothing".into()),
        })
    }

    fn adapt(&self, setup: &mut Setup, capture: &mut CaptureArgs, tape: &Tape) {
        capture.tape = tape.clone();
        setup.json = self.json;
        setup.quiet = self.quiet;
        setup.for_replay(self.threads);
    }
}

/// Says that a capture is of another version, which may run differently.
pub(super) fn warn_of_version(header: &Header, is_quiet: bool) {
    let own = env!("CARGO_PKG_VERSION");
    if header.version != own && !is_quiet {
        complain(&format!(
            "the run was captured by version {}, and this is {own}: it may differ",
            header.version
        ));
    }
}

/// The command of a capture. The environment of this process has no part in it.
fn command(header: &Header) -> Result<Command, String> {
    READS_CAPTURE.store(true, Ordering::Relaxed);
    let mut parser = Cli::command();
    let names: Vec<String> = parser
        .get_subcommands()
        .map(|command| command.get_name().to_owned())
        .collect();
    for name in names {
        parser = parser.mut_subcommand(name, |command| {
            command.mut_args(|arg| arg.env(Resettable::Reset))
        });
    }
    let args = std::iter::once("swanilda").chain(header.args.iter().map(String::as_str));
    let matches = parser.try_get_matches_from(args);
    let cli = matches.and_then(|matches| Cli::from_arg_matches(&matches));
    let command = cli.map(|cli| cli.command);
    command.map_err(|error| format!("its command line is none of this version: {error}"))
}

fn code_of(verdict: &Verdict) -> u8 {
    match verdict {
        Verdict::Same { .. } | Verdict::Cut { .. } => 0,
        Verdict::Differs { .. } | Verdict::Unreadable(_) => DIFFERS,
    }
}

/// Says how the replay has ended.
fn report(verdict: &Verdict, is_json: bool, is_quiet: bool) {
    let (outcome, steps, text) = match verdict {
        Verdict::Same { steps } => (
            "same",
            *steps,
            format!("{steps} steps as in the capture, to the end"),
        ),
        Verdict::Cut { steps } => (
            "cut",
            *steps,
            format!(
                "{steps} steps as in the capture, which ends there: its process did not end by itself"
            ),
        ),
        Verdict::Differs { step, what } => (
            "differs",
            *step,
            format!("the run differs from its capture at step {step}: {what}"),
        ),
        Verdict::Unreadable(reason) => (
            "unreadable",
            0,
            format!("the capture cannot be read: {reason}"),
        ),
    };
    if is_json {
        print_json(&json!({ "type": "replay", "outcome": outcome, "step": steps, "text": text }));
    } else if !is_quiet || code_of(verdict) != 0 {
        let _ = writeln!(std::io::stderr(), "{text}");
    }
}

/// Prints a value as a line, also where the run has ended the program's own output.
fn print_json(value: &serde_json::Value) {
    let line = format!("{value}\n");
    let _ = match reserve_standard_output() {
        Some(mut out) => out.write_all(line.as_bytes()),
        None => std::io::stdout().write_all(line.as_bytes()),
    };
}
