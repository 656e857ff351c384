//! Any bytes as a message of a page of the viewer: a request, or a refusal with a reason; and what is one has the members that were sent.
//!
//! `cargo fuzz run view_request`
#![no_main]

use libfuzzer_sys::fuzz_target;
use serde_json::Value;

// The parser is private to the viewer and needs nothing of it.
#[allow(dead_code)]
#[path = "../../crates/view/src/request.rs"]
mod request;

use request::{Action, Request};

fuzz_target!(|bytes: &[u8]| {
    let sent: Option<Value> = serde_json::from_slice(bytes).ok();
    match Request::parse(bytes) {
        Err(refusal) => assert!(!refusal.reason.is_empty()),
        Ok(Request { id, action }) => {
            let sent = sent.expect("only JSON is a request");
            assert_eq!(id, sent["id"]);
            match action {
                Action::Speed(factor) => assert!((0.0..=100.0).contains(&factor)),
                Action::Step(count) => {
                    assert!(count != 0 && (-1_000_000..=1_000_000).contains(&count));
                }
                Action::Seek(frame) => assert_eq!(Some(frame as u64), sent["frame"].as_u64()),
                Action::Select(handles) | Action::Watch(handles) => {
                    assert_eq!(Some(handles.len()), sent["handles"].as_array().map(Vec::len));
                }
                Action::Set { value, .. } => assert_eq!(value, sent["value"]),
                Action::Run(code) => assert_eq!(Some(code.as_str()), sent["code"].as_str()),
                _ => {}
            }
        }
    }
});
