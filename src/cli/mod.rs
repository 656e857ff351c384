//! The command line: one file per subcommand.
//!
//! This is the outermost layer, the one that may look at clocks, terminals and signals.
#![allow(
    clippy::disallowed_methods,
    reason = "the outside world is this layer's business"
)]

mod api;
mod batch;
mod bench;
mod built;
mod convert;
mod debug;
mod diff;
mod doctor;
mod export;
mod files;
mod init;
mod inspect;
mod library;
mod mcp;
mod original;
mod remote;
mod render;
mod replay;
mod run;
mod search;
mod serve;
mod session;
mod standard_output;
mod test;
mod unpack;
mod view;

use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

use session::{
    capture, debugging, fallen, graphs, hashes, interrupt, launch, live, output, permissions,
    progress, recording, resources, setup, video, watchdog,
};
use standard_output::say;

/// Exit code for a wrong command line or a file that cannot be read or written; clap uses the same.
const USAGE: u8 = 2;
/// Exit code for a failure of the simulator itself (`EX_SOFTWARE`).
const INTERNAL: u8 = 70;

/// Headless robot simulator that runs CoppeliaSim's Lua scripts and scenes.
#[derive(Parser)]
#[command(name = "swanilda", version, propagate_version = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Run(Box<run::Args>),
    Export(export::Args),
    Render(render::Args),
    Replay(replay::Args),
    View(view::Args),
    Serve(serve::Args),
    #[command(mut_args(mcp::under_own_heading))]
    Mcp(mcp::Args),
    Debug(debug::Args),
    Test(test::Args),
    Search(search::Args),
    Batch(batch::Args),
    Bench(bench::Args),
    Api(api::Args),
    Doctor(doctor::Args),
    Inspect(inspect::Args),
    Unpack(unpack::UnpackArgs),
    Pack(unpack::PackArgs),
    Convert(convert::Args),
    Diff(diff::Args),
    Init(init::Args),
    Library(library::Args),
    #[command(name = "coppeliasim")]
    Original(original::Args),
    /// Print a completion script for a shell
    Completions {
        shell: Shell,
    },
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    // Scripts may recurse deeply, within Lua and across scripts.
    let thread = std::thread::Builder::new()
        .name("simulator".into())
        .stack_size(simulator::Simulator::STACK_SIZE);
    let outcome = thread.spawn(|| parse().map_or_else(|code| code, |cli| cli.command.execute()));
    match outcome.map(std::thread::JoinHandle::join) {
        Ok(Ok(code)) => code_of_loss().map_or(code, ExitCode::from),
        _ => ExitCode::from(INTERNAL),
    }
}

/// The exit code for output that could not be written, which is said; nothing when all is well.
fn code_of_loss() -> Option<u8> {
    let reason = standard_output::lost()?;
    complain(reason);
    Some(USAGE)
}

/// The parsed command line; errors and help have been printed.
fn parse() -> Result<Cli, ExitCode> {
    Cli::try_parse().map_err(|error| {
        standard_output::note(&error.print());
        let for_tests = std::env::args()
            .nth(1)
            .is_some_and(|command| command == "test" || command == "search");
        ExitCode::from(if !error.use_stderr() {
            0
        } else if for_tests {
            test::USAGE
        } else {
            USAGE
        })
    })
}

/// The exit code of a command, or why it cannot do what it is asked to: exit code [`USAGE`].
type Outcome = Result<ExitCode, String>;

impl Command {
    fn execute(self) -> ExitCode {
        let outcome = match self {
            Self::Run(args) => run::run(&args),
            Self::Export(args) => export::export(&args),
            Self::Render(args) => render::render(&args),
            Self::Replay(args) => replay::replay(&args),
            Self::View(args) => view::view(&args),
            Self::Serve(args) => serve::serve(&args),
            Self::Mcp(args) => mcp::serve(&args),
            Self::Debug(args) => debug::debug(&args),
            Self::Test(args) => Ok(test::test(&args)),
            Self::Search(args) => Ok(search::search(&args)),
            Self::Batch(args) => batch::batch(&args),
            Self::Bench(args) => bench::bench(&args),
            Self::Api(args) => api::api(&args),
            Self::Doctor(args) => doctor::doctor(&args),
            Self::Inspect(args) => inspect::inspect(&args),
            Self::Unpack(args) => unpack::unpack(&args),
            Self::Pack(args) => unpack::pack(&args),
            Self::Convert(args) => convert::convert(&args),
            Self::Diff(args) => diff::diff(&args),
            Self::Init(args) => init::init(&args),
            Self::Library(args) => library::library(&args),
            Self::Original(args) => original::start(&args),
            Self::Completions { shell } => {
                let mut script = Vec::new();
                clap_complete::generate(shell, &mut Cli::command(), "swanilda", &mut script);
                say(&script);
                Ok(ExitCode::SUCCESS)
            }
        };
        outcome.unwrap_or_else(|reason| {
            complain(&reason);
            ExitCode::from(USAGE)
        })
    }
}

/// Writes to standard error, in the name of the program. A closed pipe is not an error.
fn complain(reason: &str) {
    let _ = writeln!(std::io::stderr(), "swanilda: {reason}");
}
