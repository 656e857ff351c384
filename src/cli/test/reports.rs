//! Requested report files and their paths.

use std::fs;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::standard_output;
use super::paint::ColorChoice;
use super::terminal::{Terminal, TerminalOptions};
use format::scene_file::{is_special, link_target, write_whole};
use testing::report::{html, json, junit, tap};
use testing::{Found, Outcome, Reporter, Summary, TestCase};

/// The options of reports.
#[derive(clap::Args)]
#[command(next_help_heading = "Reports")]
pub(in crate::cli) struct ReportArgs {
    /// Write a report that CI systems read: JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write a report for a browser: one page with plots and consoles
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Results to standard output as TAP 14, as the tests finish
    #[arg(long, conflicts_with = "json")]
    tap: bool,
    /// Results to standard output as lines of JSON, as the tests finish
    #[arg(long)]
    json: bool,
    /// Show each test, and tracebacks
    #[arg(long, short)]
    verbose: bool,
    /// Show the N slowest tests
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    durations: usize,
    /// When to use colours
    #[arg(
        long,
        value_name = "WHEN",
        value_enum,
        default_value = "auto",
        alias = "colour"
    )]
    color: ColorChoice,
}

impl ReportArgs {
    /// Makes sure that the files can be written.
    ///
    /// # Errors
    /// The reason why one cannot.
    pub(in crate::cli) fn check(&self) -> Result<(), String> {
        [&self.junit, &self.html]
            .into_iter()
            .flatten()
            .try_for_each(|file| check(file))
    }

    /// Whether results go to standard output for programs, which cannot be asked to forget them.
    pub(super) fn streams(&self) -> bool {
        self.tap || self.json
    }

    /// Output while the tests run; `is_search`: only properties.
    pub(in crate::cli) fn reporter(&self, is_search: bool) -> Reports {
        let stream = if self.tap {
            Some(Stream::Tap(0))
        } else {
            self.json.then_some(Stream::Json)
        };
        // A terminal that shows the report already has no place for a second one.
        let is_silent = stream.is_some() && std::io::stdout().is_terminal();
        let options = TerminalOptions {
            verbose: self.verbose,
            color: self.color,
            durations: self.durations,
            on_stderr: stream.is_some(),
            is_search,
        };
        Reports {
            terminal: (!is_silent).then(|| Terminal::new(options)),
            stream,
        }
    }

    /// Prints a message that belongs to no report, without disturbing one.
    pub(in crate::cli) fn print(&self, text: &str) {
        match (self.tap || self.json, std::io::stdout().is_terminal()) {
            (true, true) => {}
            (true, false) => drop(std::io::stderr().lock().write_all(text.as_bytes())),
            (false, _) => standard_output::say(text.as_bytes()),
        }
    }

    /// Writes the reports that need to know everything.
    ///
    /// # Errors
    /// The reason why one could not be written.
    pub(in crate::cli) fn write(&self, summary: &Summary) -> Result<(), String> {
        if let Some(file) = &self.junit {
            write(file, &junit::report(summary))?;
        }
        if let Some(file) = &self.html {
            write(
                file,
                html::report(summary, file.parent().unwrap_or(Path::new(""))).as_bytes(),
            )?;
        }
        Ok(())
    }
}

/// All output while the tests run.
pub(in crate::cli) struct Reports {
    terminal: Option<Terminal>,
    stream: Option<Stream>,
}

/// A report on standard output.
enum Stream {
    /// With the number of the last test.
    Tap(usize),
    Json,
}

impl Reporter for Reports {
    fn begin(&mut self, tests: &[Arc<TestCase>]) {
        match self.stream {
            Some(Stream::Tap(_)) => say(&tap::begin(tests.len())),
            Some(Stream::Json) => say(&json::begin(tests)),
            None => {}
        }
        self.terminal
            .iter_mut()
            .for_each(|terminal| terminal.begin(tests));
    }

    fn progress(&mut self, test: &TestCase, found: &Found) {
        self.terminal
            .iter_mut()
            .for_each(|terminal| terminal.progress(test, found));
    }

    fn outcome(&mut self, outcome: &Outcome) {
        match &mut self.stream {
            Some(Stream::Tap(number)) => {
                *number += 1;
                say(&tap::test(*number, outcome));
            }
            Some(Stream::Json) => say(&json::test(outcome)),
            None => {}
        }
        self.terminal
            .iter_mut()
            .for_each(|terminal| terminal.outcome(outcome));
    }

    fn end(&mut self, summary: &Summary) {
        match self.stream {
            Some(Stream::Tap(_)) => say(&tap::end(summary)),
            Some(Stream::Json) => say(&json::end(summary)),
            None => {}
        }
        self.terminal
            .iter_mut()
            .for_each(|terminal| terminal.end(summary));
    }
}

fn say(text: &str) {
    standard_output::say(text.as_bytes());
}

fn check(file: &Path) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("cannot write {}: {error}", file.display());
    if file.is_dir() {
        return Err(failed(std::io::ErrorKind::IsADirectory.into()));
    }
    if is_special(file) {
        return Ok(());
    }
    let target = link_target(file);
    let folder = target
        .parent()
        .filter(|folder| *folder != Path::new(""))
        .unwrap_or(Path::new("."));
    fs::create_dir_all(folder)
        .and_then(|()| tempfile::NamedTempFile::new_in(folder))
        .map(drop)
        .map_err(failed)
}

fn write(file: &Path, bytes: &[u8]) -> Result<(), String> {
    write_whole(file, bytes).map_err(|error| format!("cannot write {}: {error}", file.display()))
}
