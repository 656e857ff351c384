//! Any bytes as a message of a script's Python process: a message or an error, and what is a value can be written and read again.
//!
//! `cargo fuzz run python_message`
#![no_main]

use libfuzzer_sys::fuzz_target;

// The decoder of messages is private to its crate.
#[allow(dead_code)]
#[path = "../../crates/script/src/python_runtime/message.rs"]
mod message;

use message::Message;
use wire::marshal::{Encoder, decode};

fuzz_target!(|bytes: &[u8]| {
    let message = Message::decode(bytes);
    match decode(bytes) {
        Err(_) => assert!(message.is_err()),
        Ok(value) => {
            let mut encoder = Encoder::default();
            encoder.value(&value);
            let written = encoder.into_bytes();
            let mut again = Encoder::default();
            again.value(&decode(&written).expect("what was written can be read"));
            assert_eq!(again.into_bytes(), written);
        }
    }
});
