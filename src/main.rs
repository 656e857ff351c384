//! The `swanilda` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    swanilda::cli::main()
}
