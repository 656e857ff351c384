//! Output of a test run on the terminal.
//!
//! Failures are shown in full as they come, passed tests by file, or one by one when it is verbose; at the end stands what matters once more.

use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::super::standard_output;
use super::failure;
use super::paint::{BOLD, ColorChoice, DIM, GREEN, Paint, RED, YELLOW, harmless};
use testing::report::files;
use testing::{Found, Outcome, Reporter, Status, Summary, TestCase};

/// Options for the terminal.
#[derive(Debug, Clone, Copy)]
pub(super) struct TerminalOptions {
    /// Each test, and tracebacks.
    pub verbose: bool,
    pub color: ColorChoice,
    /// How many of the slowest tests.
    pub durations: usize,
    /// Standard output is taken by a report.
    pub on_stderr: bool,
    /// Only properties run.
    pub is_search: bool,
}

/// Shows how tests get on.
pub(super) struct Terminal {
    options: TerminalOptions,
    paint: Paint,
    bar: ProgressBar,
    bad: usize,
    /// How many tests of each file are not over yet, and what the others did.
    open: BTreeMap<PathBuf, (usize, Tally)>,
}

/// Counts of a file.
#[derive(Debug, Default)]
struct Tally {
    total: usize,
    bad: usize,
    pending: usize,
    wall: Duration,
}

impl Terminal {
    pub(super) fn new(options: TerminalOptions) -> Self {
        let is_terminal = if options.on_stderr {
            std::io::stderr().is_terminal()
        } else {
            std::io::stdout().is_terminal()
        };
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        Self {
            options,
            paint: Paint::new(options.color, is_terminal),
            bar,
            bad: 0,
            open: BTreeMap::new(),
        }
    }

    /// Writes text between the frames of the progress bar. A reader that closes the pipe has seen enough, which is no error.
    fn say(&self, text: &str) {
        self.bar.suspend(|| {
            if self.options.on_stderr {
                let _ = std::io::stderr().lock().write_all(text.as_bytes());
            } else {
                standard_output::say(text.as_bytes());
            }
        });
    }

    fn show_bar(&self, count: usize) {
        if !std::io::stderr().is_terminal() {
            return;
        }
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} tests{msg}, {elapsed}");
        self.bar
            .set_style(style.expect("the template is well-formed"));
        self.bar.set_length(count as u64);
        self.bar.set_draw_target(ProgressDrawTarget::stderr());
        // A long test should not look like a standstill.
        self.bar.enable_steady_tick(Duration::from_millis(200));
    }

    fn advance(&mut self, outcome: &Outcome) {
        self.bad += usize::from(outcome.is_bad());
        if self.bad > 0 {
            self.bar.set_message(format!(", {} failed", self.bad));
        }
        self.bar.inc(1);
    }

    /// The line of a file whose tests are all over.
    fn tally(&mut self, outcome: &Outcome) -> Option<String> {
        let file = &outcome.test.file;
        let (left, tally) = self.open.get_mut(file)?;
        tally.add(outcome);
        *left = left.saturating_sub(1);
        if *left > 0 {
            return None;
        }
        let (_, tally) = self.open.remove(file)?;
        let status = if tally.bad > 0 {
            Status::Failed
        } else {
            Status::Passed
        };
        Some(format!(
            "{} {} ({tally})\n",
            self.paint.status(status),
            harmless(&file.to_string_lossy())
        ))
    }

    fn test_line(&self, outcome: &Outcome) -> String {
        let title = harmless(&outcome.test.id());
        let reason = if outcome.message.is_empty() {
            String::new()
        } else {
            format!(": {}", harmless(&outcome.message))
        };
        let wall = self.paint.paint(
            DIM,
            &format!("({:.1} ms)", outcome.wall.as_secs_f64() * 1e3),
        );
        format!(
            "{} {title}{reason} {wall}\n",
            self.paint.status(outcome.status)
        )
    }

    fn failure(&self, outcome: &Outcome) -> String {
        let title = self.paint.paint(BOLD, &harmless(&outcome.test.id()));
        let block = failure::block(outcome, self.paint, self.options.verbose);
        format!("{} {title}\n{block}\n", self.paint.status(outcome.status))
    }

    /// Failed tests, one per line, in the order of the files.
    fn failures(&self, summary: &Summary) -> String {
        let bad: String = files(summary)
            .flatten()
            .filter(|outcome| outcome.is_bad())
            .map(|o| self.short(o))
            .collect();
        if bad.is_empty() {
            bad
        } else {
            format!("Failures:\n{bad}\n")
        }
    }

    fn short(&self, outcome: &Outcome) -> String {
        let line = outcome
            .line
            .or(outcome.test.line)
            .map(|line| format!(":{line}"))
            .unwrap_or_default();
        let place = outcome.test.file.display().to_string() + &line;
        let first = outcome.message.lines().next().unwrap_or_default();
        // Lua's messages begin with the place.
        let first = first.strip_prefix(&format!("{place}: ")).unwrap_or(first);
        let text = harmless(&format!("{place} {}: {first}", outcome.test.title()));
        format!("  {} {text}\n", self.paint.status(outcome.status))
    }

    fn slowest(&self, summary: &Summary) -> String {
        let mut slowest: Vec<_> = summary.outcomes.iter().collect();
        slowest.sort_by_key(|outcome| std::cmp::Reverse(outcome.wall));
        slowest.truncate(self.options.durations);
        let line = |outcome: &&Outcome| {
            format!(
                "  {:>8.3} s  {}\n",
                outcome.wall.as_secs_f64(),
                harmless(&outcome.test.id())
            )
        };
        let lines: String = slowest.iter().map(line).collect();
        if lines.is_empty() {
            lines
        } else {
            format!("Slowest tests:\n{lines}\n")
        }
    }

    /// The last line: counts and time.
    fn counts(&self, summary: &Summary) -> String {
        let errors = summary.count(Status::Error);
        let counts = [
            (summary.count(Status::Passed), "passed", GREEN),
            (summary.count(Status::Failed), "failed", RED),
            (errors, if errors == 1 { "error" } else { "errors" }, RED),
            (summary.count(Status::Pending), "pending", YELLOW),
            (summary.not_run, "not run", YELLOW),
            (summary.deselected, "deselected", DIM),
        ];
        let counts = counts
            .into_iter()
            .filter(|(count, word, _)| *count > 0 || *word == "passed");
        let parts: Vec<_> = counts
            .map(|(count, word, colour)| self.paint.paint(colour, &format!("{count} {word}")))
            .collect();
        let interrupted = if summary.interrupted {
            "interrupted: "
        } else {
            ""
        };
        if summary.outcomes.is_empty() && !summary.interrupted {
            return no_tests(summary.deselected, self.options.is_search);
        }
        format!(
            "{interrupted}{} in {:.2} s\n",
            parts.join(", "),
            summary.wall.as_secs_f64()
        )
    }
}

/// Advice when nothing was run.
fn no_tests(deselected: usize, is_search: bool) -> String {
    if is_search {
        return "no properties found: t.property makes them, in files named *_test.lua or test_*.lua; --filter may leave them out\n".into();
    }
    if deselected > 0 {
        return format!(
            "no tests run: --filter and --shard leave out all {deselected}; --list shows names\n"
        );
    }
    "no tests found: they are in files named *_test.lua or test_*.lua; `swanilda test --init` writes an example\n"
        .into()
}

impl Reporter for Terminal {
    fn begin(&mut self, tests: &[Arc<TestCase>]) {
        for test in tests {
            self.open.entry(test.file.clone()).or_default().0 += 1;
        }
        self.show_bar(tests.len());
    }

    fn progress(&mut self, _: &TestCase, found: &Found) {
        let closest = found.closest.as_ref().map(|report| report.robustness);
        let closest = closest.map_or_else(String::new, |least| format!(", robustness {least:.4}"));
        let failing = if found.failing.is_some() {
            ", shrinking"
        } else {
            ""
        };
        self.bar
            .set_message(format!(", {} cases{closest}{failing}", found.cases));
    }

    fn outcome(&mut self, outcome: &Outcome) {
        self.advance(outcome);
        let file = self.tally(outcome);
        if outcome.is_bad() {
            self.say(&self.failure(outcome));
        } else if self.options.verbose {
            self.say(&self.test_line(outcome));
        }
        if let Some(line) = file.filter(|_| !self.options.verbose) {
            self.say(&line);
        }
    }

    fn end(&mut self, summary: &Summary) {
        self.bar.finish_and_clear();
        self.say(&(self.failures(summary) + &self.slowest(summary) + &self.counts(summary)));
    }
}

impl Tally {
    fn add(&mut self, outcome: &Outcome) {
        self.total += 1;
        self.bad += usize::from(outcome.is_bad());
        self.pending += usize::from(outcome.status == Status::Pending);
        self.wall += outcome.wall;
    }
}

impl std::fmt::Display for Tally {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let plural = if self.total == 1 { "" } else { "s" };
        if self.bad > 0 {
            write!(f, "{} of ", self.bad)?;
        }
        write!(
            f,
            "{} test{plural}{}",
            self.total,
            if self.bad > 0 { " failed" } else { "" }
        )?;
        if self.pending > 0 {
            write!(f, ", {} pending", self.pending)?;
        }
        write!(f, ", {:.2} s", self.wall.as_secs_f64())
    }
}
