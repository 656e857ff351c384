//! JSON lines: an object for the beginning, each test and the end of a run. docs/TESTING.md describes the fields.

use serde_json::{Value, json};

use super::parts;
use crate::{Excerpt, Outcome, PropertyReport, ShownValue, Status, Summary, TestCase};
use script::test_bench::ConsoleLine;
use script::test_cases::Signal;

/// The first line: how many tests will run.
pub fn begin(tests: &[impl AsRef<TestCase>]) -> String {
    let mut files: Vec<_> = tests
        .iter()
        .map(|test| test.as_ref().file.to_string_lossy())
        .collect();
    files.sort();
    files.dedup();
    line(
        &json!({"type": "begin", "version": env!("CARGO_PKG_VERSION"), "tests": tests.len(), "files": files}),
    )
}

/// The line of a test that is over.
pub fn test(outcome: &Outcome) -> String {
    line(&test_value(outcome))
}

pub(crate) fn test_value(outcome: &Outcome) -> Value {
    let test = &outcome.test;
    json!({
        "type": "test",
        "file": test.file.to_string_lossy(),
        "name": test.name,
        "title": test.title(),
        "definedAt": test.line,
        "repetition": test.repetition,
        "seed": test.seed,
        "status": parts::word(outcome.status),
        "todo": outcome.todo,
        "message": outcome.message,
        "line": outcome.line,
        "script": outcome.script,
        "recording": outcome.recording,
        "capture": outcome.capture,
        "property": outcome.property.as_ref().map(property),
        "temporal": outcome.signals.iter().map(signal).collect::<Vec<_>>(),
        "excerpts": outcome.excerpts.iter().map(excerpt).collect::<Vec<_>>(),
        "trace": outcome.trace,
        "time": outcome.time,
        "steps": outcome.steps,
        "wallTime": outcome.wall.as_secs_f64(),
        "console": outcome.console.iter().map(console_line).collect::<Vec<_>>(),
    })
}

/// The last line: counts.
pub fn end(summary: &Summary) -> String {
    line(&json!({
        "type": "summary",
        "passed": summary.count(Status::Passed),
        "failed": summary.count(Status::Failed),
        "errors": summary.count(Status::Error),
        "pending": summary.count(Status::Pending),
        "notRun": summary.not_run,
        "deselected": summary.deselected,
        "interrupted": summary.interrupted,
        "wallTime": summary.wall.as_secs_f64(),
    }))
}

/// Robustness that was not measured is null.
fn property(property: &PropertyReport) -> Value {
    let values = |values: &[ShownValue]| -> Value {
        let value = |value: &ShownValue| json!({"line": value.line, "source": value.source, "value": value.value});
        values.iter().map(value).collect()
    };
    json!({
        "cases": property.cases,
        "discarded": property.discarded,
        "shrinks": property.shrinks,
        "chosen": property.chosen,
        "robustness": property.robustness,
        "lines": property.lines,
        "first": values(&property.first),
        "simplest": values(&property.simplest),
        "kept": property.kept,
    })
}

fn signal(signal: &Signal) -> Value {
    json!({"name": signal.name, "robustness": signal.robustness})
}

fn excerpt(excerpt: &Excerpt) -> Value {
    json!({"place": excerpt.place, "line": excerpt.line, "first": excerpt.first, "lines": excerpt.lines})
}

fn console_line(line: &ConsoleLine) -> Value {
    json!({"time": line.time, "origin": line.origin, "level": line.level, "text": line.text,
        "located": line.located})
}

fn line(value: &Value) -> String {
    value.to_string() + "\n"
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::super::parts::sample;

    #[test]
    fn each_moment_is_one_line() {
        let summary = sample::summary();
        let tests: Vec<_> = summary
            .outcomes
            .iter()
            .map(|outcome| outcome.test.clone())
            .collect();
        let mut text = super::begin(&tests);
        text.extend(summary.outcomes.iter().map(super::test));
        text += &super::end(&summary);
        let lines: Vec<Value> = text
            .lines()
            .map(|line| serde_json::from_str(line).unwrap())
            .collect();
        assert_eq!(lines.len(), 7);
        assert_eq!(
            lines[0]["files"],
            serde_json::json!(["a/x_test.lua", "b_test.lua"])
        );
        let failed = &lines[2];
        assert_eq!(
            (&failed["status"], &failed["line"], &failed["seed"]),
            (&"failed".into(), &2.into(), &7.into())
        );
        assert_eq!(failed["console"][0]["text"], sample::HOSTILE);
        assert_eq!(failed["excerpts"][0]["lines"][0], "one");
        assert_eq!(
            (&lines[6]["errors"], &lines[6]["notRun"]),
            (&1.into(), &2.into())
        );
    }

    #[test]
    fn a_time_that_is_no_number_is_null() {
        let mut outcome = sample::summary().outcomes.remove(0);
        outcome.time = f64::NAN;
        let value: Value = serde_json::from_str(&super::test(&outcome)).unwrap();
        assert_eq!(value["time"], Value::Null);
    }
}
