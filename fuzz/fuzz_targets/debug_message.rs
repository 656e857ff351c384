//! Any bytes from the client of a debugger: messages, whichever way they are cut into pieces, or a refusal; what is a request has an answer to it.
//!
//! `cargo fuzz run debug_message`
#![no_main]

use libfuzzer_sys::fuzz_target;
use serde_json::Value;

// These parts need nothing of the simulator.
#[allow(dead_code)]
#[path = "../../crates/debugger/src/framing.rs"]
mod framing;
#[allow(dead_code)]
#[path = "../../crates/debugger/src/request.rs"]
mod request;

use framing::{Framing, framed};
use request::Request;

fn read(bytes: &[u8], size: usize) -> (Vec<Value>, bool) {
    let (mut framing, mut messages) = (Framing::default(), Vec::new());
    for piece in bytes.chunks(size) {
        framing.push(piece);
        loop {
            match framing.next_message() {
                Ok(Some(message)) => messages.push(message),
                Ok(None) => break,
                Err(_) => return (messages, true),
            }
        }
    }
    (messages, false)
}

fuzz_target!(|bytes: &[u8]| {
    let (messages, failed) = read(bytes, usize::MAX);
    let (in_pieces, _) = read(bytes, 7);
    assert!(failed || messages == in_pieces);
    for message in &messages {
        assert_eq!(read(&framed(message), 3).0, [message.clone()]);
        if let Some(request) = Request::parse(message) {
            assert_eq!(request.answer(Ok(Value::Null))["request_seq"], message["seq"]);
        }
    }
});
