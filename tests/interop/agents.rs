//! Clients and servers of the Model Context Protocol: the files `agents_*.py`.

#[path = "../agents/tasks.rs"]
mod tasks;
#[path = "../agents/values.rs"]
mod values;

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use serde_json::{Value, json};
use tasks::{Attempt, Call, files};
use test_support::parallel;
use test_support::process::run_bounded;

use crate::server::{Server, folder, python, run};

const PROGRAM: &str = env!("CARGO_BIN_EXE_swanilda");

fn client(python: &Path, arguments: &[&str]) {
    let mut command = Command::new(python);
    command
        .arg(folder().join("agents_client.py"))
        .args(arguments);
    assert_eq!(
        run_bounded(&mut command).as_deref(),
        Ok(""),
        "{arguments:?}"
    );
}

#[test]
fn the_official_client_by_standard_input_and_output() {
    let Some(python) = python() else { return };
    client(python, &["stdio", PROGRAM]);
}

/// A program that ends with the test.
struct Ending(Child);

impl Drop for Ending {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn the_official_client_by_http() {
    let Some(python) = python() else { return };
    let mut command = Command::new(PROGRAM);
    command
        .args(["mcp", "--http", "0"])
        .stdin(Stdio::null())
        .stderr(Stdio::piped());
    let mut server = Ending(command.spawn().expect("the server starts"));
    let said = server.0.stderr.take().expect("standard error is piped");
    let mut said = BufReader::new(said)
        .lines()
        .map(|line| line.expect("the server lives"));
    let first = said.next().expect("an address");
    let url = first
        .split_whitespace()
        .last()
        .expect("an address")
        .to_owned();
    let second = said.next().expect("a secret");
    let secret = second
        .split_whitespace()
        .last()
        .expect("a secret")
        .to_owned();
    client(python, &["http", &url, &secret]);
}

#[test]
fn a_server_of_others_for_coppeliasim() {
    let Some(python) = python() else { return };
    let server = Server::start();
    run(python, "agents_other.py", &server, &[]);
}

/// Calls tools by the official client.
fn bridge(python: &Path, arguments: &[String]) -> Call {
    let mut command = Command::new(python);
    command
        .arg(folder().join("agents_bridge.py"))
        .arg(PROGRAM)
        .args(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().expect("the client starts");
    let mut input = child.stdin.take().expect("it is piped");
    let mut answers = BufReader::new(child.stdout.take().expect("it is piped")).lines();
    let mut client = Ending(child);
    Box::new(move |tool, arguments| {
        let call = json!({"tool": tool, "arguments": arguments});
        input
            .write_all(format!("{call}\n").as_bytes())
            .expect("the client reads");
        let answer = answers.next().map(|line| line.expect("the client writes"));
        let answer = answer.unwrap_or_else(|| panic!("{:?}", client.0.try_wait()));
        serde_json::from_str::<Value>(&answer).expect("an answer is JSON")
    })
}

/// All tasks of `tests/agents`, by the client of others.
#[test]
fn the_official_client_solves_every_task() {
    let Some(python) = python() else { return };
    let solved = parallel::map(&files(), |file| {
        let attempt = Attempt::begin(file, |arguments| bridge(python, arguments))?;
        let answer = attempt.solve()?;
        attempt.check(answer)?.map_or(Ok(()), Err)
    });
    let failed: Vec<(_, Result<(), String>)> = files()
        .into_iter()
        .zip(solved)
        .filter(|(_, outcome)| outcome.is_err())
        .collect();
    assert!(failed.is_empty(), "{failed:#?}");
}
