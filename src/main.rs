//! The `swanilda` command.

mod cli;

use std::process::ExitCode;

/// Each simulator has memory of its own, at the same addresses in every run.
#[global_allocator]
static ALLOCATOR: swanilda::Allocator = swanilda::Allocator;

fn main() -> ExitCode {
    cli::main()
}
