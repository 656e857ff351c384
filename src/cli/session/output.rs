//! Output of a run: prints to stdout, the log to stderr; or everything as JSON lines on stdout.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::net::SocketAddr;
use std::rc::Rc;
use std::time::Duration;

use indicatif::ProgressBar;
use serde_json::{Value, json};

use super::super::standard_output::note;
use super::interrupt::Interrupt;
use io::signals::{reserve_standard_output, standard_output_is_closed};
use script::log::{status, verbosity};
use simulator::{Console, LogLine, RunTotals};
use testing::batch::{Row, Run};

/// Output format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum Format {
    Text,
    /// Text with errors in CoppeliaSim's words.
    OriginalText,
    /// One object per line, distinguished by its `type`.
    Json,
}

/// Writes the lines of a simulator and the command line's own.
#[derive(Clone)]
pub(in crate::cli) struct Output {
    format: Format,
    /// Suppress the simulator's own messages.
    quiet: bool,
    /// Stands on the terminal between lines.
    bar: ProgressBar,
    /// State since the last error of a script.
    aftermath: Rc<Cell<Aftermath>>,
    /// The first error of a script since it was last taken.
    error: Rc<RefCell<Option<String>>>,
    /// Requested when nobody reads standard output any more.
    interrupt: Interrupt,
    /// Standard output, where nothing but lines of ours may be.
    reserved: Option<&'static File>,
    /// Writes nothing to standard output.
    is_silent: bool,
}

/// A script error pauses the simulation, and a run that nobody resumes is then stopped. Of the four lines about that, people read one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Aftermath {
    /// No error, or the simulation went on after it.
    None,
    Error,
    /// The line about the pause is held back.
    Paused,
    /// The paused simulation is being stopped.
    Stopping,
}

impl Output {
    pub(in crate::cli) fn new(
        format: Format,
        quiet: bool,
        bar: ProgressBar,
        interrupt: Interrupt,
    ) -> Self {
        let reserved = (format == Format::Json)
            .then(reserve_standard_output)
            .flatten();
        Self {
            format,
            quiet,
            bar,
            aftermath: Rc::new(Cell::new(Aftermath::None)),
            error: Rc::default(),
            interrupt,
            reserved,
            is_silent: false,
        }
    }

    /// The same for a run that only repeats what another one has said.
    pub(in crate::cli) fn silenced(self) -> Self {
        Self {
            is_silent: true,
            ..self
        }
    }

    /// The first error of a script since the last time.
    pub(in crate::cli) fn take_error(&self) -> Option<String> {
        self.error.take()
    }

    /// A message of the command line itself, under the simulator's name in the log.
    pub(in crate::cli) fn note(&self, text: &str, time: f64) {
        self.write_log(&LogLine {
            origin: "CoppeliaSim",
            level: verbosity::SCRIPT_INFOS,
            text,
            located: None,
            time,
            status: true,
        });
    }

    /// Reports that a simulation nobody resumes is stopped.
    pub(in crate::cli) fn stops_paused(&self, time: f64) {
        if self.aftermath.get() == Aftermath::Paused {
            return self.aftermath.set(Aftermath::Stopping);
        }
        self.note(
            "The simulation is paused and nobody resumes it: it is stopped.",
            time,
        );
    }

    /// Line to show; None if it is left out or delayed.
    fn condensed<'a>(&self, line: &LogLine<'a>) -> Option<LogLine<'a>> {
        if !line.status {
            if verbosity::plain(line.level) == verbosity::SCRIPT_ERRORS {
                self.aftermath.set(Aftermath::Error);
            }
            return Some(*line);
        }
        let (next, text) = match (self.aftermath.get(), line.text) {
            (Aftermath::Error, status::PAUSED) => (Aftermath::Paused, None),
            (Aftermath::Stopping, status::RESUMED) => (Aftermath::Stopping, None),
            (Aftermath::Stopping, status::STOPPED) => (Aftermath::None, Some(STOPPED_AFTER_ERROR)),
            (Aftermath::Paused, text) => {
                // The simulation was resumed, so the pause is reported after all.
                self.write_error(&LogLine {
                    text: status::PAUSED,
                    ..*line
                });
                (Aftermath::None, Some(text))
            }
            (_, text) => (Aftermath::None, Some(text)),
        };
        self.aftermath.set(next);
        text.map(|text| LogLine { text, ..*line })
    }

    /// Reports the address of a server.
    pub(in crate::cli) fn listening(&self, api: &str, address: SocketAddr) {
        match self.format {
            Format::Text | Format::OriginalText => {
                self.write_line(format!("{api} remote API at {address}").as_bytes());
            }
            Format::Json => self.write_json(&json!({
                "type": "listening", "api": api, "address": address.ip(), "port": address.port(),
            })),
        }
    }

    /// Reports the address of the visualization stream.
    pub(in crate::cli) fn streaming(&self, address: SocketAddr) {
        match self.format {
            Format::Text | Format::OriginalText => {
                self.write_line(format!("Visualization stream at {address}").as_bytes());
            }
            Format::Json => {
                self.write_json(&json!({ "type": "streaming", "address": address.ip(), "port": address.port() }));
            }
        }
    }

    /// Reports where the page of the viewer is.
    pub(in crate::cli) fn viewing(&self, url: &str) {
        match self.format {
            Format::Text | Format::OriginalText => {
                self.write_line(format!("Viewer at {url}").as_bytes());
            }
            Format::Json => self.write_json(&json!({ "type": "viewing", "url": url })),
        }
    }

    /// The hash of the state after the last step.
    pub(in crate::cli) fn hash(&self, last: Option<(u64, u64)>) {
        let Some((step, hash)) = last else { return };
        match self.format {
            Format::Text | Format::OriginalText => {
                self.write_line(format!("state hash {hash:016x} after step {step}").as_bytes());
            }
            Format::Json => self.write_json(
                &json!({ "type": "hash", "step": step, "hash": format!("{hash:016x}") }),
            ),
        }
    }

    /// A future of a run begins.
    pub(in crate::cli) fn branch(&self, run: &Run, runs: usize, time: f64) {
        let Run { number, params, .. } = run;
        if self.format == Format::Json {
            let params: BTreeMap<_, _> = params.iter().cloned().collect();
            let value = json!({ "type": "branch", "run": number, "params": params, "time": time });
            return self.write_json(&value);
        }
        let values = params.iter().map(|(name, value)| format!("{name}={value}"));
        let values = values.collect::<Vec<_>>().join(", ");
        self.note(&format!("Branch {number} of {runs}: {values}"), time);
    }

    /// What came of a future of a run.
    pub(in crate::cli) fn row(&self, row: &Row) {
        if self.format == Format::Json {
            let mut value = row.value();
            value["type"] = "row".into();
            self.write_json(&value);
        }
    }

    /// Says where the table of results is.
    pub(in crate::cli) fn table(&self, line: &str) {
        if self.format == Format::Json {
            self.write_json(&json!({ "type": "table", "text": line }));
        } else {
            self.write_line(line.as_bytes());
        }
    }

    /// The last line: steps, times and errors of the run.
    pub(in crate::cli) fn summary(
        &self,
        totals: RunTotals,
        limit: Option<f64>,
        wall: Duration,
        errors: u64,
        exit_code: u8,
    ) {
        if self.quiet || self.interrupt.is_quiet() {
            return;
        }
        let RunTotals { steps, time } = totals;
        let wall = wall.as_secs_f64();
        let ratio = time / wall.max(1e-9);
        match self.format {
            Format::Text | Format::OriginalText => drop(writeln!(
                std::io::stderr(),
                "{steps} steps, {time:.3} s simulated in {wall:.3} s of wall time ({ratio:.1} times as fast){}",
                match errors {
                    0 => String::new(),
                    1 => ", 1 script error".to_owned(),
                    _ => format!(", {errors} script errors"),
                } + beyond(time, limit)
            )),
            Format::Json => self.write_json(&json!({
                "type": "summary", "steps": steps, "time": time, "wallTime": wall, "ratio": ratio, "errors": errors,
                "exitCode": exit_code,
            })),
        }
    }

    fn write_log(&self, line: &LogLine<'_>) {
        if self.quiet && line.status || self.interrupt.is_quiet() {
            return;
        }
        match self.format {
            Format::Text | Format::OriginalText => self.condensed(line).iter().for_each(|line| self.write_error(line)),
            Format::Json => self.write_json(&json!({
                "type": "log", "level": verbosity::name(line.level), "origin": line.origin, "text": line.plain_text(),
                "time": line.time, "located": line.located,
            })),
        }
    }

    fn write_error(&self, line: &LogLine<'_>) {
        let text = if self.format == Format::OriginalText {
            line.original()
        } else {
            line.located()
        };
        self.bar.suspend(|| {
            let _ = writeln!(std::io::stderr().lock(), "{text}");
        });
    }

    fn write_json(&self, value: &Value) {
        self.write_line(value.to_string().as_bytes());
    }

    /// Writes a line to standard output. When nobody reads it any more, or it has no room, the program ends.
    fn write_line(&self, line: &[u8]) {
        if self.is_silent {
            return;
        }
        let line = [line, b"\n"].concat();
        let written = match self.reserved {
            Some(mut out) => out.write_all(&line),
            None => std::io::stdout()
                .lock()
                .write_all(&line)
                .and_then(|()| std::io::stdout().flush()),
        };
        if note(&written) || written.is_err_and(|error| error.kind() == ErrorKind::BrokenPipe) {
            self.interrupt.request_quietly();
        }
    }
}

/// Instead of the line about the end, after an error.
const STOPPED_AFTER_ERROR: &str = "Simulation stopped because of the error.";

/// Why a run is longer than it was asked to be.
fn beyond(time: f64, limit: Option<f64>) -> &'static str {
    if limit.is_some_and(|limit| time > limit + 1e-9) {
        "\n(The stop was asked for at that time; as in CoppeliaSim, three more steps run until the simulation has stopped.)"
    } else {
        ""
    }
}

impl Console for Output {
    fn print(&mut self, line: &[u8], _: f64) {
        match self.format {
            Format::Text | Format::OriginalText => self.bar.suspend(|| self.write_line(line)),
            Format::Json => {
                self.write_json(&json!({"type": "print", "text": String::from_utf8_lossy(line)}));
            }
        }
    }

    fn log(&mut self, line: &LogLine<'_>) {
        if !line.status && verbosity::plain(line.level) == verbosity::SCRIPT_ERRORS {
            let text = || line.located.unwrap_or(line.text).to_owned();
            self.error.borrow_mut().get_or_insert_with(text);
        }
        self.write_log(line);
    }

    fn pipe_closed(&mut self) {
        if standard_output_is_closed(self.reserved) {
            self.interrupt.request_quietly();
        }
    }
}
