//! Any text as the type of a message of ROS 2, and any bytes as a message of it: both are read or refused, and what is read is written as it was.
//!
//! `cargo fuzz run ros2_message`
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use ros_interfaces::{Catalogue, Generation, InterfaceKind, TypeName, cdr};

/// With the built-in types, which take far longer to read than an input.
static CATALOGUE: LazyLock<Catalogue> = LazyLock::new(|| Catalogue::new(Generation::Ros2));

fuzz_target!(|input: (&str, &[u8])| {
    let (text, bytes) = input;
    let mut catalogue = CATALOGUE.clone();
    let name = TypeName::new("fuzz_msgs", InterfaceKind::Message, "Fuzzed").expect("a name");
    if catalogue.add_text(&name, text).is_err() {
        return;
    }
    let Ok(layout) = catalogue.layout_of(&name) else { return };
    let message = [&[0, 1, 0, 0], bytes].concat();
    if let Ok(record) = cdr::decode(&layout, &message) {
        let written = cdr::encode(&record);
        // Not compared as values: what is no number differs from itself.
        let again = cdr::decode(&layout, &written).expect("what was written");
        assert_eq!(cdr::encode(&again), written);
    }
});
