//! Tasks for language models, solved by a scripted client that has nothing but the tools of `swanilda mcp`: so the tools suffice.

#![allow(
    clippy::disallowed_methods,
    reason = "tests start programs and look at the environment"
)]

mod answers;
mod client;
mod misuse;
mod tasks;
mod values;

use std::path::Path;

use client::Client;
use swanilda::mlua;
use tasks::{Attempt, Call, files};
use test_support::parallel;

fn start(arguments: &[String]) -> Call {
    let mut client = Client::start(arguments);
    Box::new(move |tool, arguments| client.call(tool, arguments))
}

#[test]
fn every_task_is_solved_by_tools_alone() {
    let files = files();
    let outcomes = parallel::map(&files, |file| {
        let name = file.file_stem().expect("a name").to_string_lossy();
        outcome(file)
            .err()
            .map(|reason| format!("{name}: {reason}"))
    });
    let failed: Vec<String> = outcomes.into_iter().flatten().collect();
    assert!(failed.is_empty(), "{}", failed.join("\n\n"));
}

#[test]
fn there_are_thirty_tasks_or_more() {
    assert!(std::env::var_os("TASK").is_some() || files().len() >= 30);
}

/// # Errors
/// When the task counts as solved before it is, or as unsolved afterwards.
fn outcome(file: &Path) -> Result<(), String> {
    let unsolved = Attempt::begin(file, start)?;
    if unsolved.check(mlua::Value::Nil)?.is_none() {
        return Err("nothing was done, and the check is content".into());
    }
    let attempt = Attempt::begin(file, start)?;
    let answer = attempt.solve()?;
    attempt.check(answer)?.map_or(Ok(()), Err)
}
