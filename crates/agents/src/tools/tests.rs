//! Running tests.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use mcp::Answer;
use serde_json::json;
use testing::{Allowance, Config, Outcome, Reporter, Status, Summary};

use super::{Group, list, text, tool};
use crate::agent::Agent;
use crate::arguments::Arguments;

pub(crate) const GROUP: Group = Group { tools, call };

/// Failures that are shown in full.
const MAX_FAILURES: usize = 10;
/// Bytes that the Lua code of a test may have.
const MEMORY: usize = 1 << 30;
/// Simulated time of a test, seconds.
const SIMULATED: f64 = 3600.0;

fn tools() -> Vec<mcp::Tool> {
    vec![tool(
        "run_tests",
        "Run tests",
        "Runs tests as `swanilda test` does (busted style: describe, it, assert; t = require 'swanilda.test' with t.load, t.run_for, t.script, ...), each in a simulator of its own, and shows the failures with their lines.",
        &[
            (
                "path",
                text("A test file, or a folder with *_test.lua and test_*.lua"),
            ),
            ("code", text("Instead of files: the text of a test file")),
            (
                "filter",
                list("Only tests whose `file::name` contains one of these"),
            ),
        ],
        &[],
    )]
}

struct Quiet;

impl Reporter for Quiet {
    fn outcome(&mut self, _: &Outcome) {}
}

fn call(agent: &mut Agent, _: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    match (arguments.text("path"), arguments.text("code")) {
        (Some(path), None) => {
            of_path(agent, Path::new(path), arguments).map(|summary| report(&summary, ""))
        }
        (None, Some(code)) => of_code(agent, code, arguments),
        _ => Err("give `path` or `code`".into()),
    }
}

fn of_path(agent: &Agent, path: &Path, arguments: Arguments<'_>) -> Result<Summary, String> {
    agent.permissions().check_inspect(path).map_err(|error| {
        format!("{error} (ask the user to start `swanilda mcp` with that option)")
    })?;
    run(agent, path.to_owned(), arguments)
}

fn of_code(agent: &Agent, code: &str, arguments: Arguments<'_>) -> Result<Answer, String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let file = folder.path().join("code_test.lua");
    std::fs::write(&file, code).map_err(|error| error.to_string())?;
    let summary = run(agent, file, arguments)?;
    // Where the text lies for so long says nothing to anybody.
    Ok(report(&summary, &format!("{}/", folder.path().display())))
}

fn run(agent: &Agent, path: PathBuf, arguments: Arguments<'_>) -> Result<Summary, String> {
    let allowance = Allowance {
        wall: agent.setting.time_limit.min(Duration::from_secs(60)),
        simulated: SIMULATED,
        memory: MEMORY,
    };
    let config = Config {
        paths: vec![path],
        filters: arguments.texts("filter"),
        permissions: agent.permissions().clone(),
        resources: agent.setting.options.resources.clone(),
        ..Config::new(1, allowance, Arc::clone(&agent.setting.options.stop))
    };
    testing::run(&config, &mut Quiet).map_err(|error| error.to_string())
}

fn report(summary: &Summary, hidden: &str) -> Answer {
    let mut out = text_of(summary);
    if !hidden.is_empty() {
        out = out.replace(hidden, "");
    }
    let all: Vec<_> = summary
        .outcomes
        .iter()
        .map(|outcome| json!({"name": outcome.test.title(), "status": word(outcome.status), "message": outcome.message, "line": outcome.line}))
        .collect();
    Answer::text(out).with(json!({"tests": all}))
}

fn text_of(summary: &Summary) -> String {
    if summary.outcomes.is_empty() {
        return "There are no tests: a test file has describe(name, function() it(name, function() ... end) end).".into();
    }
    let bad = summary.outcomes.iter().filter(|outcome| outcome.is_bad());
    let failures: Vec<String> = bad.map(failure).collect();
    let rest = failures.len().saturating_sub(MAX_FAILURES);
    let more = if rest > 0 {
        format!("({rest} more failures)\n")
    } else {
        String::new()
    };
    format!(
        "{} passed, {} failed, {} pending.\n{}{more}",
        summary.count(Status::Passed),
        failures.len(),
        summary.count(Status::Pending),
        failures[..failures.len() - rest].concat()
    )
}

/// What went wrong, with the lines where it did.
fn failure(outcome: &Outcome) -> String {
    let excerpts = outcome.excerpts.iter().map(|excerpt| excerpt.text(">"));
    let message = outcome.message.trim_end();
    format!(
        "\n{}: {message}\n{}",
        outcome.test.title(),
        excerpts.collect::<String>()
    )
}

fn word(status: Status) -> &'static str {
    match status {
        Status::Passed => "passed",
        Status::Failed => "failed",
        Status::Error => "error",
        Status::Pending => "pending",
    }
}
