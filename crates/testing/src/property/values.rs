//! The values of cases, for people and for tables.

use std::fmt::Write;
use std::path::Path;

use super::PropertyReport;
use script::test_cases::Note;
use search::{Found, Report, Status, Value};

/// Values that are written into a message; the report has the others.
const MAX_VALUES: usize = 30;

/// A value that a case has drawn, as people read it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ShownValue {
    /// The line of the test's file that has drawn it, if known.
    pub line: Option<u32>,
    /// The text of that line, without its indentation.
    pub source: String,
    /// The value.
    pub value: String,
}

/// A case that a search has tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The numbers that it chose, in order.
    pub choices: Vec<f64>,
    /// Whether it passed; None when it was discarded.
    pub passed: Option<bool>,
    /// How far it was from failing; infinite when that was not measured.
    pub robustness: f64,
}

impl Sample {
    pub(super) fn of(report: &Report) -> Self {
        let choices = report.choices.iter().map(|choice| choice.value.as_float());
        Self {
            choices: choices.collect(),
            passed: match report.status {
                Status::Passed => Some(true),
                Status::Failed => Some(false),
                Status::Discarded => None,
            },
            robustness: report.robustness,
        }
    }
}

/// The cases as a table.
pub(super) fn csv(samples: &[Sample]) -> String {
    let count = samples
        .iter()
        .map(|sample| sample.choices.len())
        .max()
        .unwrap_or(0);
    let mut text = String::from("status,robustness");
    for number in 1..=count {
        // Writing to a string does not fail.
        let _ = write!(text, ",choice{number}");
    }
    for sample in samples {
        let status = match sample.passed {
            Some(true) => "passed",
            Some(false) => "failed",
            None => "discarded",
        };
        let _ = write!(text, "\n{status},{}", sample.robustness);
        for number in &sample.choices {
            let _ = write!(text, ",{number}");
        }
    }
    text + "\n"
}

/// The values that were noted, with the lines of the test's file.
pub(super) fn shown(file: &Path, notes: &[Note]) -> Vec<ShownValue> {
    // Without the file the lines have numbers only.
    let text = std::fs::read_to_string(file).unwrap_or_default();
    let source = |line: u32| text.lines().nth(line.saturating_sub(1) as usize);
    let value = |note: &Note| ShownValue {
        line: note.line,
        source: note
            .line
            .and_then(source)
            .unwrap_or_default()
            .trim()
            .to_owned(),
        value: note.text.clone(),
    };
    notes.iter().map(value).collect()
}

/// What a message says about a failing case.
pub(super) fn explained(report: &PropertyReport, found: &Found) -> String {
    let plural = |count: usize| if count == 1 { "" } else { "s" };
    let mut text = format!(
        "\n\nfailed in case {} of the search, shrunk in {} run{}:\n",
        found.cases,
        found.shrinks,
        plural(found.shrinks)
    );
    if report.simplest.is_empty() {
        text += "    (it draws no values)";
    }
    for value in report.simplest.iter().take(MAX_VALUES) {
        let line = value
            .line
            .map(|line| format!("{line}: "))
            .unwrap_or_default();
        // Writing to a string does not fail.
        let _ = writeln!(text, "    {line}{}  -> {}", value.source, value.value);
    }
    if report.simplest.len() > MAX_VALUES {
        let _ = writeln!(text, "    and {} more", report.simplest.len() - MAX_VALUES);
    }
    text.truncate(text.trim_end().len());
    text
}

/// The same of a case that was not run to its end: it is known by its choices only.
pub(super) fn of_unfinished(values: &[Value]) -> String {
    let numbers: Vec<_> = values
        .iter()
        .take(MAX_VALUES)
        .map(|value| value.as_float().to_string())
        .collect();
    format!(
        "\n\nthe case was not run to its end; it had chosen, in order: {}",
        if numbers.is_empty() {
            "nothing".into()
        } else {
            numbers.join(", ")
        }
    )
}
