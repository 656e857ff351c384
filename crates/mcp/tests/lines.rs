//! Standard input and output: lines of any length, and none that is lost.

use std::io::{Cursor, Read};

use mcp::{
    About, Answer, Contents, MAX_LINE, NotFound, Resource, Running, Service, Template, Tool, serve,
};
use serde_json::{Value, json};

struct Nothing;

impl Service for Nothing {
    fn about(&self) -> About {
        About {
            name: "test",
            title: "Test",
            version: "1",
            instructions: String::new(),
        }
    }

    fn tools(&self) -> &[Tool] {
        &[]
    }

    fn call(&mut self, _: &str, _: &Value) -> Answer {
        Answer::default()
    }

    fn resources(&mut self) -> Vec<Resource> {
        Vec::new()
    }

    fn templates(&self) -> Vec<Template> {
        Vec::new()
    }

    fn read(&mut self, uri: &str) -> Result<Contents, NotFound> {
        Err(NotFound(uri.into()))
    }
}

fn answers(input: impl Read + Send + 'static) -> Vec<Value> {
    let mut output = Vec::new();
    serve(&mut Nothing, input, &mut output, &Running::default()).expect("it serves");
    let text = String::from_utf8(output).expect("answers are text");
    text.lines()
        .map(|line| serde_json::from_str(line).expect("an answer is JSON"))
        .collect()
}

const PING: &str = "{\"jsonrpc\":\"2.0\",\"id\":1,\"method\":\"ping\"}";

#[test]
fn every_request_before_the_end_is_answered() {
    let text = format!("\n{PING}\r\n  \n").repeat(1000) + PING;
    assert_eq!(answers(Cursor::new(text)).len(), 1001);
}

#[test]
fn a_line_that_is_too_long_is_refused_and_the_next_one_answered() {
    let long = std::io::repeat(b'[').take(MAX_LINE as u64 + 100_000);
    let input = long.chain(Cursor::new(format!("\n{PING}\n")));
    let answers = answers(input);
    assert_eq!(answers.len(), 2);
    assert_eq!(answers[0]["error"]["code"], -32600);
    assert_eq!(answers[1]["result"], json!({}));
}

#[test]
fn notifications_and_responses_have_no_answer() {
    let note = "{\"jsonrpc\":\"2.0\",\"method\":\"notifications/initialized\"}\n{\"jsonrpc\":\"2.0\",\"id\":1,\"result\":{}}\n";
    assert_eq!(answers(Cursor::new(format!("{note}{PING}\n"))).len(), 1);
}

#[test]
fn batches_are_those_of_older_versions() {
    let hello = |version| {
        format!(
            "{{\"jsonrpc\":\"2.0\",\"id\":0,\"method\":\"initialize\",\"params\":{{\"protocolVersion\":\"{version}\"}}}}"
        )
    };
    let batch = format!("[{PING},{PING},{{\"jsonrpc\":\"2.0\",\"method\":\"x\"}}]");
    let old = answers(Cursor::new(format!("{}\n{batch}\n", hello("2025-03-26"))));
    assert_eq!(old[1].as_array().map(Vec::len), Some(2));
    let new = answers(Cursor::new(format!("{}\n{batch}\n", hello("2025-06-18"))));
    assert_eq!(new[1]["error"]["code"], -32600);
}
