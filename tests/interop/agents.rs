//! Clients and servers of the Model Context Protocol: the files `agents_*.py`.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

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

/// `swanilda mcp --http`, which ends with the test.
struct HttpServer(Child);

impl Drop for HttpServer {
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
    let mut server = HttpServer(command.spawn().expect("the server starts"));
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
