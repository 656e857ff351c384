//! Description of a failed test for the terminal.

use super::paint::{DIM, Paint, RED, harmless};
use testing::report::{console_line, moment};
use testing::{Excerpt, Outcome};

/// Lines of a test's console that are shown.
const CONSOLE_LINES: usize = 20;

/// The block below the test's name: every line is indented.
pub(super) fn block(outcome: &Outcome, paint: Paint, with_trace: bool) -> String {
    let mut text = indented("    ", &harmless(&outcome.message));
    text.extend(outcome.excerpts.iter().map(|source| excerpt(source, paint)));
    if let Some(script) = &outcome.script {
        text += &indented("    ", &format!("in script {}", harmless(script)));
    }
    if let Some(moment) = moment(outcome) {
        text += &format!("    {moment}, with seed {}\n", outcome.test.seed);
    }
    if with_trace {
        text += &indented("    ", &paint.paint(DIM, harmless(&outcome.trace).trim()));
    }
    text + &files(outcome) + &console(outcome, paint)
}

/// How the failing case of a property is looked at again.
fn files(outcome: &Outcome) -> String {
    if outcome.property.is_none() {
        return String::new();
    }
    let capture = outcome.capture.as_deref();
    let capture = capture.map(|file| format!("run it again: swanilda replay {}", file.display()));
    let page = outcome.recording.as_deref();
    let page = page.map(|file| format!("see it: {}", file.display()));
    let lines = capture.into_iter().chain(page);
    lines
        .map(|line| indented("    ", &harmless(&line)))
        .collect()
}

fn excerpt(excerpt: &Excerpt, paint: Paint) -> String {
    let mut text = format!("    --> {}:{}\n", harmless(&excerpt.place), excerpt.line);
    for (number, code, is_meant) in excerpt.numbered() {
        let line = harmless(&format!("{number:>4} | {code}"));
        let line = if is_meant {
            paint.paint(RED, &format!("> {line}"))
        } else {
            format!("  {line}")
        };
        text += &indented("    ", &line);
    }
    text
}

/// The end of the console: what was said last is nearest to the failure.
fn console(outcome: &Outcome, paint: Paint) -> String {
    if outcome.console.is_empty() {
        return String::new();
    }
    let hidden = outcome.console.len().saturating_sub(CONSOLE_LINES);
    let mut text = "    console:\n".to_owned();
    if hidden > 0 {
        text += &format!(
            "      {}\n",
            paint.paint(DIM, &format!("... {hidden} lines before"))
        );
    }
    for line in &outcome.console[hidden..] {
        text += &indented("      ", &harmless(&console_line(line)));
    }
    text
}

/// Empty lines are left out, so that a block is one.
fn indented(indent: &str, text: &str) -> String {
    text.lines()
        .filter(|line| !line.trim().is_empty())
        .map(|line| format!("{indent}{line}\n"))
        .collect()
}
