//! A test in a process of its own, which may crash: what it prints as JSON becomes the outcome again.

use std::io::Read;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use serde_json::{Value, json};

use super::case::{Outcome, Status, TestCase};
use super::excerpt::Excerpt;
use super::report;
use script::coverage::{CountedText, FunctionLines, LineCounts};
use script::test_bench::ConsoleLine;

/// How often the process is looked at.
const TICK: Duration = Duration::from_millis(5);

/// Runs a test by `command`, which prints its outcome; kills the process when `stop` is set. Its standard input ends with this process, so
/// that it can do the same.
pub(super) fn run(mut command: Command, test: &Arc<TestCase>, stop: &AtomicBool) -> Outcome {
    let started = command.stdin(lifeline()).stdout(Stdio::piped()).spawn();
    let ended = started.and_then(|child| wait(child, stop));
    let failed = |message: String| Outcome::new(Arc::clone(test), Status::Error, message);
    match ended {
        Err(error) => failed(format!(
            "the test could not be run in a process of its own: {error}"
        )),
        Ok((status, text)) => outcome(&text, test).unwrap_or_else(|| {
            failed(format!(
                "the test has ended its process, which ran nothing else (--isolate): {status}"
            ))
        }),
    }
}

/// A pipe that closes with this process, where a process can put something else in the place of its standard input.
fn lifeline() -> Stdio {
    if cfg!(unix) {
        Stdio::piped()
    } else {
        Stdio::null()
    }
}

fn wait(mut child: Child, stop: &AtomicBool) -> std::io::Result<(ExitStatus, String)> {
    let mut out = child.stdout.take().ok_or(std::io::ErrorKind::BrokenPipe)?;
    let reader = std::thread::spawn(move || {
        let mut bytes = Vec::new();
        // After an error, the bytes before it are used.
        let _ = out.read_to_end(&mut bytes);
        String::from_utf8_lossy(&bytes).into_owned()
    });
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if stop.load(Ordering::Relaxed) {
            child.kill()?;
            break child.wait()?;
        }
        crate::workers::rest(TICK);
    };
    // A program that the test has left behind may keep the pipe open.
    for _ in 0..200 {
        if reader.is_finished() {
            break;
        }
        crate::workers::rest(TICK);
    }
    let text = if reader.is_finished() {
        reader.join().unwrap_or_default()
    } else {
        String::new()
    };
    Ok((status, text))
}

/// The outcome among the lines, as `report::json` writes it.
fn outcome(text: &str, test: &Arc<TestCase>) -> Option<Outcome> {
    let values = text
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let value = values.into_iter().find(|value| value["type"] == "test")?;
    let status = match value["status"].as_str()? {
        "passed" => Status::Passed,
        "failed" => Status::Failed,
        "pending" => Status::Pending,
        _ => Status::Error,
    };
    let mut outcome = Outcome::new(Arc::clone(test), status, string(&value["message"]));
    outcome.todo = value["todo"].as_bool().unwrap_or_default();
    outcome.trace = string(&value["trace"]);
    outcome.line = value["line"].as_u64().map(|line| line as u32);
    outcome.recording = value["recording"].as_str().map(Into::into);
    outcome.capture = value["capture"].as_str().map(Into::into);
    outcome.script = value["script"].as_str().map(str::to_owned);
    outcome.time = value["time"].as_f64().unwrap_or(f64::NAN);
    outcome.steps = value["steps"].as_u64().unwrap_or_default();
    outcome.excerpts = list(&value["excerpts"]).map(excerpt).collect();
    outcome.console = list(&value["console"]).map(console_line).collect();
    outcome.line_counts = line_counts(&value["lineCounts"]);
    Some(outcome)
}

/// The line that a child prints: that of the JSON report, with the counts of lines.
pub(super) fn printed(outcome: &Outcome, counts: &LineCounts) -> String {
    let mut value = report::json::test_value(outcome);
    let texts = counts.texts.iter().map(|(text, lines)| {
        let mut value = match text {
            CountedText::File(file) => json!({"file": file.to_string_lossy(), "counts": lines}),
            CountedText::Script { scene, path, text } => {
                json!({"scene": scene, "path": path, "text": latin1(text), "counts": lines})
            }
        };
        if let Some(functions) = counts.functions.get(text) {
            value["functions"] = functions
                .iter()
                .map(|f| json!([f.line, f.name, f.lines]))
                .collect();
        }
        value
    });
    value["lineCounts"] = texts.collect();
    value.to_string() + "\n"
}

fn line_counts(value: &Value) -> LineCounts {
    let mut all = LineCounts::default();
    for value in list(value) {
        let text = match value["file"].as_str() {
            Some(file) => CountedText::File(file.into()),
            None => {
                let text = string(&value["text"])
                    .chars()
                    .filter_map(|c| u8::try_from(c).ok())
                    .collect();
                CountedText::Script {
                    scene: string(&value["scene"]),
                    path: string(&value["path"]),
                    text,
                }
            }
        };
        let counts: Vec<u64> = list(&value["counts"]).filter_map(Value::as_u64).collect();
        if value["functions"].is_array() {
            all.functions.insert(
                text.clone(),
                list(&value["functions"]).map(function).collect(),
            );
        }
        all.add(text, &counts);
    }
    all
}

fn function(value: &Value) -> FunctionLines {
    let line = |value: &Value| value.as_u64().unwrap_or_default() as u32;
    FunctionLines {
        line: line(&value[0]),
        name: value[1].as_str().map(str::to_owned),
        lines: list(&value[2]).map(line).collect(),
    }
}

/// Bytes as characters, one each: JSON holds no others, and a script need not be UTF-8.
fn latin1(bytes: &[u8]) -> String {
    bytes.iter().map(|&byte| char::from(byte)).collect()
}

fn excerpt(value: &Value) -> Excerpt {
    let number = |name: &str| value[name].as_u64().unwrap_or_default() as u32;
    let lines = list(&value["lines"]).map(string).collect();
    Excerpt {
        place: string(&value["place"]),
        line: number("line"),
        first: number("first"),
        lines,
    }
}

fn console_line(value: &Value) -> ConsoleLine {
    const LEVELS: [&str; 9] = [
        "print", "stderr", "error", "warning", "loadinfo", "info", "debug", "trace", "tracelua",
    ];
    let level = LEVELS
        .into_iter()
        .find(|level| value["level"] == *level)
        .unwrap_or("unknown");
    let origin = value["origin"].as_str().map(str::to_owned);
    let located = value["located"].as_str().map(str::to_owned);
    let time = value["time"].as_f64().unwrap_or_default();
    ConsoleLine {
        time,
        origin,
        level,
        text: string(&value["text"]),
        located,
    }
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

fn string(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn counts_of_lines_come_back_from_a_child() {
        let mut counts = LineCounts::default();
        counts.add(CountedText::File("lib/a.lua".into()), &[1, 0, 7]);
        let text = b"-- \xff\xc3\xa4\nx = 1".as_slice().into();
        let script = CountedText::Script {
            scene: "s.ttt".into(),
            path: "/Arm".into(),
            text,
        };
        counts.add(script.clone(), &[0, 2]);
        let inner = FunctionLines {
            line: 1,
            lines: vec![2],
            name: Some("f".into()),
        };
        counts.functions.insert(
            script,
            vec![
                FunctionLines {
                    line: 0,
                    lines: vec![1],
                    name: None,
                },
                inner,
            ],
        );
        let test = Arc::new(TestCase::of_file(Path::new("a_test.lua")));
        let passed = Outcome::new(Arc::clone(&test), Status::Passed, "");
        let printed = printed(&passed, &counts);
        assert_eq!(printed.lines().count(), 1);
        let read = outcome(&printed, &test).expect("the line of a test");
        assert_eq!(
            (read.status, read.line_counts.texts),
            (Status::Passed, counts.texts)
        );
        assert_eq!(read.line_counts.functions, counts.functions);
    }
}
