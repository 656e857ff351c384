//! The Test Anything Protocol, version 14: a plan, a line for each test, a block of YAML for what went wrong.

use std::fmt::Write;

use super::parts;
use crate::{Outcome, Status, Summary};

/// The first lines, with the plan.
pub fn begin(count: usize) -> String {
    let reason = if count == 0 { " # SKIP no tests" } else { "" };
    format!("TAP version 14\n1..{count}{reason}\n")
}

/// The lines of a test that is over; `number` counts them from 1.
pub fn test(number: usize, outcome: &Outcome) -> String {
    let word = if outcome.is_bad() || outcome.todo {
        "not ok"
    } else {
        "ok"
    };
    let title = escaped(&outcome.test.id());
    let directive = match outcome.status {
        Status::Pending if outcome.todo => format!(" # TODO {}", escaped(&outcome.message)),
        Status::Pending => format!(" # SKIP {}", escaped(&outcome.message)),
        _ => String::new(),
    };
    let diagnostic = if outcome.is_bad() {
        diagnostic(outcome)
    } else {
        String::new()
    };
    format!("{word} {number} - {title}{directive}\n{diagnostic}")
}

/// The last lines. Without some of the tests that were planned, the run is void.
pub fn end(summary: &Summary) -> String {
    match summary {
        _ if summary.interrupted => "Bail out! interrupted\n".into(),
        _ if summary.not_run > 0 => format!(
            "Bail out! {} tests were not run: one has failed\n",
            summary.not_run
        ),
        _ => String::new(),
    }
}

fn diagnostic(outcome: &Outcome) -> String {
    let mut block = Block::default();
    block.text("message", &outcome.message);
    block.text(
        "severity",
        if outcome.status == Status::Failed {
            "fail"
        } else {
            "error"
        },
    );
    block.text("file", &outcome.test.file.to_string_lossy());
    if let Some(line) = outcome.line.or(outcome.test.line) {
        block.number("line", line);
    }
    if let Some(script) = &outcome.script {
        block.text("script", script);
    }
    for (key, excerpt) in ["source", "source2", "source3", "source4"]
        .iter()
        .zip(&outcome.excerpts)
    {
        block.text(key, &excerpt.text(">"));
    }
    block.number("time", format_args!("{:.3}", outcome.time));
    block.number("steps", outcome.steps);
    block.number("seed", outcome.test.seed);
    block.number(
        "duration_ms",
        format_args!("{:.3}", outcome.wall.as_secs_f64() * 1e3),
    );
    if !outcome.console.is_empty() {
        let console: Vec<_> = outcome.console.iter().map(parts::console_line).collect();
        block.text("console", &console.join("\n"));
    }
    format!("  ---\n{}  ...\n", block.0)
}

/// Entries of a YAML mapping.
#[derive(Default)]
struct Block(String);

impl Block {
    fn number(&mut self, key: &str, value: impl std::fmt::Display) {
        let _ = writeln!(self.0, "  {key}: {value}");
    }

    /// Several lines stay as they are, where YAML can have them so; everything else is quoted, in which YAML and JSON agree.
    fn text(&mut self, key: &str, value: &str) {
        let value = value.trim_end_matches('\n');
        if value.contains('\n') && can_stand_as_it_is(value) {
            let _ = writeln!(self.0, "  {key}: |-");
            for line in value.lines() {
                let _ = writeln!(self.0, "{}", format!("    {line}").trim_end());
            }
        } else {
            self.number(key, serde_json::Value::from(value));
        }
    }
}

fn can_stand_as_it_is(text: &str) -> bool {
    let is_plain = |c: char| {
        c == '\n'
            || !c.is_control()
                && parts::allowed(c) == c
                && !matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}')
    };
    !text.starts_with([' ', '\n']) && text.chars().all(is_plain)
}

/// Without what would begin a directive or another line.
fn escaped(text: &str) -> String {
    let one_line: String = text
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    one_line.replace('\\', "\\\\").replace('#', "\\#")
}

#[cfg(test)]
mod tests {
    use super::super::parts::sample;
    use super::*;

    #[test]
    fn a_run() {
        let summary = sample::summary();
        let mut text = begin(summary.outcomes.len());
        for (i, outcome) in summary.outcomes.iter().enumerate() {
            text += &test(i + 1, outcome);
        }
        text += &end(&summary);
        let points: Vec<_> = text.lines().filter(|line| !line.starts_with(' ')).collect();
        assert_eq!(
            points[..3],
            [
                "TAP version 14",
                "1..5",
                "ok 1 - a/x_test.lua::group passes"
            ]
        );
        assert!(
            points[3].starts_with("not ok 2 - a/x_test.lua::group <script>")
                && points[3].ends_with("\\# -->")
        );
        assert_eq!(
            points[5],
            "not ok 4 - a/x_test.lua::group todo # TODO not written yet"
        );
        assert_eq!(
            points[6],
            "ok 5 - b_test.lua::group skips # SKIP later \\# on"
        );
        assert_eq!(points[7], "Bail out! 2 tests were not run: one has failed");
    }

    #[test]
    fn what_went_wrong_is_yaml() {
        let text = test(3, &sample::summary().outcomes[2]);
        let expected = "not ok 3 - a/x_test.lua::group crashes\n  ---\n  message: \"boom\"\n  severity: \"error\"\n  \
            file: \"a/x_test.lua\"\n  line: 3\n  time: 0.500\n  steps: 10\n  seed: 7\n  duration_ms: 1500.000\n  ...\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn lines_stay_lines_unless_yaml_cannot_have_them() {
        let mut block = Block::default();
        block.text("a", "one\n\n  two\n");
        block.text("b", " one\ntwo");
        block.text("c", "one\n\u{1b}");
        assert_eq!(
            block.0,
            "  a: |-\n    one\n\n      two\n  b: \" one\\ntwo\"\n  c: \"one\\n\\u001b\"\n"
        );
    }

    #[test]
    fn no_tests() {
        assert_eq!(begin(0), "TAP version 14\n1..0 # SKIP no tests\n");
        assert_eq!(end(&Summary::default()), "");
    }
}
