//! Any bytes as a message of the process of an interface in QML: a message or an error, and pictures are of their form.
//!
//! `cargo fuzz run qml_message`
#![no_main]

use libfuzzer_sys::fuzz_target;

// The decoder of messages is private to its crate.
#[allow(dead_code)]
#[path = "../../crates/modules-windows/src/sim_qml/message.rs"]
mod message;

use message::Message;

fuzz_target!(|bytes: &[u8]| {
    match Message::decode(bytes) {
        Ok(Message::Picture { size, png, .. }) => {
            assert!(size.iter().all(|side| (1..=8192).contains(side)));
            assert!(png.starts_with(b"\x89PNG"));
        }
        Ok(Message::Window { size, .. }) => {
            assert!(size.iter().all(|side| (1..=8192).contains(side)));
        }
        _ => {}
    }
});
