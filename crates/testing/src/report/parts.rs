//! Shared parts of reports.

use crate::{Outcome, Status, Summary};
use script::test_bench::ConsoleLine;

/// Parts of a summary in the order of the files: the outcomes of each file.
pub fn files(summary: &Summary) -> impl Iterator<Item = &[Outcome]> {
    summary.outcomes.chunk_by(|a, b| a.test.file == b.test.file)
}

/// One word for a status.
pub(super) fn word(status: Status) -> &'static str {
    match status {
        Status::Passed => "passed",
        Status::Failed => "failed",
        Status::Error => "error",
        Status::Pending => "pending",
    }
}

/// How many of the outcomes ended so.
pub(super) fn count(outcomes: &[Outcome], status: Status) -> usize {
    outcomes
        .iter()
        .filter(|outcome| outcome.status == status)
        .count()
}

/// The failure message, with all details.
pub(super) fn details(outcome: &Outcome) -> String {
    let mut parts = vec![outcome.message.clone()];
    parts.extend(outcome.excerpts.iter().map(|excerpt| excerpt.text(">")));
    parts.extend(
        outcome
            .script
            .as_ref()
            .map(|script| format!("in script {script}")),
    );
    parts.extend(moment(outcome));
    if !outcome.trace.trim().is_empty() {
        parts.push(outcome.trace.trim().to_owned());
    }
    parts
        .iter()
        .map(|part| part.trim_end())
        .collect::<Vec<_>>()
        .join("\n\n")
}

/// When it ended, if there was a simulation.
pub fn moment(outcome: &Outcome) -> Option<String> {
    let steps = outcome.steps;
    (steps > 0).then(|| {
        format!(
            "at simulated time {:.3} s, after {steps} step{}",
            outcome.time,
            if steps == 1 { "" } else { "s" }
        )
    })
}

/// A line of the console with its time and its author.
pub fn console_line(line: &ConsoleLine) -> String {
    let origin = line.origin.as_deref();
    let author = origin
        .map(|origin| format!("[{origin}:{}] ", line.level))
        .unwrap_or_default();
    format!(
        "{:.3} {author}{}",
        line.time,
        line.located.as_ref().unwrap_or(&line.text)
    )
}

/// Replaces characters that XML documents must not contain by U+FFFD.
pub(super) fn allowed(c: char) -> char {
    match c {
        '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'.. => c,
        _ => char::REPLACEMENT_CHARACTER,
    }
}

/// Outcomes for the tests of the reports.
#[cfg(test)]
pub(super) mod sample {
    use std::path::PathBuf;
    use std::sync::Arc;
    use std::time::Duration;

    use crate::{Excerpt, Outcome, Status, Summary, TestCase};
    use script::test_bench::ConsoleLine;

    pub const HOSTILE: &str =
        "<script>alert('x')</script> ]]> & \"q\" \u{0}\u{1b}[31m\u{fffe} # -->";

    pub fn outcome(file: &str, index: usize, name: &str, status: Status, message: &str) -> Outcome {
        let name = vec!["group".to_owned(), name.to_owned()];
        let test = TestCase {
            file: PathBuf::from(file),
            index,
            name,
            line: Some(3),
            repetition: 0,
            seed: 7,
            property: None,
        };
        let mut outcome = Outcome::new(Arc::new(test), status, message);
        (outcome.time, outcome.steps, outcome.wall) = (0.5, 10, Duration::from_millis(1500));
        outcome
    }

    /// One of each status in one file, and one that passed in another.
    pub fn summary() -> Summary {
        let mut failed = outcome(
            "a/x_test.lua",
            2,
            HOSTILE,
            Status::Failed,
            &format!("first line\n{HOSTILE}"),
        );
        failed.line = Some(2);
        failed.excerpts = Vec::from_iter(Excerpt::of(
            "a/x_test.lua",
            format!("one\n{HOSTILE}\n").as_bytes(),
            2,
        ));
        failed.script = Some("/Robot/script".into());
        failed.console = vec![
            ConsoleLine {
                time: 0.05,
                origin: None,
                level: "print",
                text: HOSTILE.into(),
                located: None,
            },
            ConsoleLine {
                time: 0.1,
                origin: Some("/Robot/script".into()),
                level: "warning",
                text: "two\nlines".into(),
                located: None,
            },
        ];
        let mut todo = outcome(
            "a/x_test.lua",
            4,
            "todo",
            Status::Pending,
            "not written yet",
        );
        todo.todo = true;
        Summary {
            outcomes: vec![
                outcome("a/x_test.lua", 1, "passes", Status::Passed, ""),
                failed,
                outcome("a/x_test.lua", 3, "crashes", Status::Error, "boom"),
                todo,
                outcome("b_test.lua", 1, "skips", Status::Pending, "later # on"),
            ],
            not_run: 2,
            deselected: 1,
            coverage: None,
            interrupted: false,
            wall: Duration::from_secs(3),
        }
    }
}
