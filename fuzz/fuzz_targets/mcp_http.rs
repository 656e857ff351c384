//! Any bytes as requests of HTTP: each ends, within its bounds.
//!
//! `cargo fuzz run mcp_http`
#![no_main]

use libfuzzer_sys::fuzz_target;

// The parser is private to the protocol and needs nothing of it.
#[allow(dead_code)]
#[path = "../../crates/mcp/src/http/request.rs"]
mod request;

use request::{Received, receive};

fuzz_target!(|bytes: &[u8]| {
    let mut input = bytes;
    loop {
        let before = input.len();
        match receive(&mut input).expect("memory does not fail") {
            Received::Request(request) => {
                assert!(!request.method.is_empty() && request.body.len() <= request::MAX_BODY);
                assert!(input.len() < before);
            }
            Received::Bad(status) => {
                assert!((400..500).contains(&status));
                return;
            }
            Received::Closed => return,
        }
    }
});
