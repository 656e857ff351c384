//! The command line.

mod output;
mod run;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Runs CoppeliaSim's Lua scripts and scenes without a display.
#[derive(Parser)]
#[command(name = "swanilda", version, propagate_version = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Run(run::Args),
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    // Scripts may recurse deeply, within Lua and across scripts.
    let thread = std::thread::Builder::new().name("simulator".into()).stack_size(crate::Simulator::STACK_SIZE);
    let outcome = thread.spawn(|| match Cli::parse().command {
        Command::Run(args) => run::run(&args),
    });
    match outcome.map(std::thread::JoinHandle::join) {
        Ok(Ok(code)) => code,
        _ => ExitCode::from(70),
    }
}
