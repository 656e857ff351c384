//! What the terminal shows of a test run.

use std::io::{IsTerminal, Write};

use crate::testing::{Outcome, Reporter, Status, Summary};

/// Lines of a test's console that are shown when it fails.
const CONSOLE_LINES: usize = 20;
/// Lines of source before and after the one that failed.
const CONTEXT: usize = 2;

/// Shows failures as they come, and passes as well when it is verbose.
pub(super) struct Terminal {
    verbose: bool,
    colours: bool,
    done: usize,
    count: usize,
}

impl Terminal {
    pub(super) fn new(verbose: bool) -> Self {
        Self { verbose, colours: std::io::stdout().is_terminal(), done: 0, count: 0 }
    }

    fn paint(&self, colour: u8, text: &str) -> String {
        if self.colours { format!("\x1b[{colour}m{text}\x1b[0m") } else { text.to_owned() }
    }

    fn word(&self, status: Status) -> String {
        let (colour, word) = match status {
            Status::Passed => (32, "PASS"),
            Status::Failed => (31, "FAIL"),
            Status::Error => (31, "ERROR"),
            Status::Pending => (33, "PENDING"),
        };
        self.paint(colour, word)
    }

    fn detail(&self, outcome: &Outcome) -> String {
        let mut text = String::new();
        for line in outcome.message.lines() {
            text += &format!("    {line}\n");
        }
        if let Some(excerpt) = outcome.line.and_then(|line| self.excerpt(outcome, line)) {
            text += &excerpt;
        }
        if let Some(script) = &outcome.script {
            text += &format!("    in script {script}\n");
        }
        if outcome.steps > 0 {
            text += &format!("    at simulated time {:.3} s, after {} steps\n", outcome.time, outcome.steps);
        }
        text + &self.console(outcome)
    }

    /// The source around a line.
    fn excerpt(&self, outcome: &Outcome, line: u32) -> Option<String> {
        let source = std::fs::read(&outcome.test.file).ok()?;
        let source = String::from_utf8_lossy(&source);
        let line = line as usize;
        let mut text = format!("    {}:{line}\n", outcome.test.file.display());
        for (i, code) in source.lines().enumerate().skip(line.saturating_sub(CONTEXT + 1)).take(2 * CONTEXT + 1) {
            let mark = if i + 1 == line { self.paint(31, ">") } else { " ".into() };
            text += &format!("    {mark} {:>4} | {code}\n", i + 1);
        }
        Some(text)
    }

    fn console(&self, outcome: &Outcome) -> String {
        let hidden = outcome.console.len().saturating_sub(CONSOLE_LINES);
        let mut text = if outcome.console.is_empty() { String::new() } else { "    console:\n".to_owned() };
        if hidden > 0 {
            text += &format!("      ... {hidden} lines before\n");
        }
        for line in &outcome.console[hidden..] {
            let origin = line.origin.as_deref().map(|origin| format!("[{origin}:{}] ", line.level)).unwrap_or_default();
            text += &format!("      {:.3} {origin}{}\n", line.time, line.text);
        }
        text
    }

    pub(super) fn summary(&self, summary: &Summary) {
        if summary.outcomes.is_empty() {
            return say("no tests found\n");
        }
        let mut parts = Vec::new();
        for (status, word) in [
            (Status::Passed, "passed"),
            (Status::Failed, "failed"),
            (Status::Error, "errors"),
            (Status::Pending, "pending"),
        ] {
            let count = summary.count(status);
            if count > 0 || status == Status::Passed {
                parts.push(format!("{count} {word}"));
            }
        }
        for (count, word) in [(summary.not_run, "not run"), (summary.deselected, "deselected")] {
            if count > 0 {
                parts.push(format!("{count} {word}"));
            }
        }
        let colour = if summary.is_good() { 32 } else { 31 };
        let line = format!("{} in {:.2} s", parts.join(", "), summary.wall.as_secs_f64());
        say(&format!("{}\n", self.paint(colour, &line)));
    }
}

impl Reporter for Terminal {
    fn begin(&mut self, tests: &[std::sync::Arc<crate::testing::TestCase>]) {
        self.count = tests.len();
    }

    fn outcome(&mut self, outcome: &Outcome) {
        self.done += 1;
        if outcome.is_bad() {
            say(&format!("{} {}\n{}", self.word(outcome.status), outcome.test.id(), self.detail(outcome)));
        } else if self.verbose || outcome.status == Status::Pending {
            let reason = if outcome.message.is_empty() { String::new() } else { format!(": {}", outcome.message) };
            let wall = outcome.wall.as_secs_f64() * 1e3;
            say(&format!("{} {}{reason} ({wall:.1} ms)\n", self.word(outcome.status), outcome.test.id()));
        }
    }
}

/// A reader that closes the pipe has seen enough, which is no error.
fn say(text: &str) {
    let _ = std::io::stdout().lock().write_all(text.as_bytes());
}
