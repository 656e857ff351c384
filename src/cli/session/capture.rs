//! `--capture`: everything that comes from outside is written to a file, from which `swanilda replay` repeats the run.

use std::path::PathBuf;

use capture::{Header, Tape};
use clap::parser::ValueSource;
use clap::{ArgMatches, Command, CommandFactory};

use crate::cli::{Cli, complain};
use testing::Captures;

/// The option about captures.
#[derive(clap::Args)]
pub(in crate::cli) struct CaptureArgs {
    /// Capture the run with everything that comes from outside, to repeat it with `swanilda replay FILE`
    #[arg(long, value_name = "FILE")]
    capture: Option<PathBuf>,
    /// The tape of a replay.
    #[arg(skip)]
    pub tape: Tape,
}

impl CaptureArgs {
    /// For commands that cannot be repeated.
    ///
    /// # Errors
    /// When a capture is asked for.
    pub(in crate::cli) fn refuse(&self, command: &str) -> Result<(), String> {
        match self.capture {
            Some(_) => Err(format!("{command} makes no captures")),
            None => Ok(()),
        }
    }

    /// The tape of the run: that of a replay, one that captures, or one that is off.
    ///
    /// # Errors
    /// When the file cannot be made, or the command line cannot be part of it.
    pub(in crate::cli) fn tape(&self) -> Result<Tape, String> {
        let Some(path) = self.capture.as_ref().filter(|_| !self.tape.is_on()) else {
            return Ok(self.tape.clone());
        };
        let tape = Tape::capturing(path, &header()?)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        tape.on_lack(|what| {
            complain(&format!(
                "not captured: {what}. A replay may differ from there on"
            ));
        });
        Ok(tape)
    }
}

/// Completes a capture.
pub(in crate::cli) fn finish(tape: &Tape) {
    if tape.is_capturing()
        && let Err(error) = tape.finish()
    {
        complain(&format!("the capture is not complete: {error}"));
    }
}

/// Captures of what fails, in a folder.
///
/// # Errors
/// As [`header`].
pub(in crate::cli) fn captures(folder: Option<&PathBuf>) -> Result<Option<Captures>, String> {
    let of_folder = |folder: &PathBuf| {
        Ok(Captures {
            folder: folder.clone(),
            header: header()?,
        })
    };
    folder.map(of_folder).transpose()
}

/// How this process was started.
///
/// # Errors
/// When an argument is no text.
fn header() -> Result<Header, String> {
    let args = std::env::args_os().skip(1).map(|arg| {
        arg.into_string()
            .map_err(|_| "arguments that are no UTF-8 cannot be captured".to_owned())
    });
    let mut args = args.collect::<Result<Vec<_>, _>>()?;
    let matches = Cli::command().try_get_matches();
    let matches = matches.map_err(|error| error.to_string())?;
    if let Some((name, matches)) = matches.subcommand() {
        let command = Cli::command();
        let subcommand = command.find_subcommand(name);
        // Behind the name of the subcommand.
        let place = args
            .iter()
            .position(|arg| arg == name)
            .map_or(0, |at| at + 1);
        args.splice(place..place, of_environment(subcommand, matches));
    }
    Ok(Header {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        args,
        facts: Vec::new(),
    })
}

/// The options that the environment has set, as they would be on the command line.
fn of_environment(command: Option<&Command>, matches: &ArgMatches) -> Vec<String> {
    let options = command.into_iter().flat_map(Command::get_arguments);
    let set = options.filter_map(|option| {
        let id = option.get_id().as_str();
        let is_set = matches.value_source(id) == Some(ValueSource::EnvVariable);
        let values = matches.get_raw(id).filter(|_| is_set)?;
        let values: Vec<_> = values.map(|value| value.to_string_lossy()).collect();
        let separator = option.get_value_delimiter().unwrap_or(',');
        let text = values.join(&separator.to_string());
        Some(format!("--{}={text}", option.get_long()?))
    });
    set.collect()
}
