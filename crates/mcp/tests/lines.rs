//! Standard input and output: lines of any length, and none that is lost.

use std::io::{Cursor, Read};

mod serving;

use mcp::{Answer, MAX_LINE, Running, serve};
use serde_json::{Value, json};
use serving::{Serving, call_with_progress, check_progress, say_twice};

fn answers(input: impl Read + Send + 'static) -> Vec<Value> {
    let mut service = Serving::new("say", say_twice);
    let mut output = Vec::new();
    serve(&mut service, input, &mut output, &Running::default()).expect("it serves");
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
fn a_call_says_how_far_it_is_before_its_answer() {
    let hello = json!({"jsonrpc": "2.0", "id": 0, "method": "initialize", "params": {"protocolVersion": "2025-06-18"}});
    let call = call_with_progress(7, "say");
    let answers = answers(Cursor::new(format!("{hello}\n{call}\n")));
    check_progress(&answers[1..], 7);
}

/// Its end of the lines is closed, as that of a client which is gone.
struct Closed;

impl std::io::Write for Closed {
    fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
        Err(std::io::ErrorKind::BrokenPipe.into())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn serving_ends_when_nobody_reads() {
    let mut service = Serving::new("nothing", |_| Answer::default());
    let input = Cursor::new(format!("{PING}\n").repeat(100));
    let served = serve(&mut service, input, &mut Closed, &Running::default());
    assert!(served.is_err());
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
