//! Bytes of messages of every type, as the Python package rosbags writes them (`tests/interop/ros2_vectors.py`): they are read, and written the same.

use std::collections::BTreeSet;

use ros_interfaces::{Catalogue, Generation, Record, cdr};

fn bytes(hex: &str) -> Vec<u8> {
    let digit = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).expect("hexadecimal digits");
    (0..hex.len()).step_by(2).map(digit).collect()
}

#[test]
fn messages_of_every_type_are_read_and_written_as_by_rosbags() {
    let mut catalogue = Catalogue::new(Generation::Ros2);
    let mut types = BTreeSet::new();
    for line in include_str!("cdr_vectors.txt").lines() {
        let (name, hex) = line.split_once(' ').expect("a type and its bytes");
        let layout = catalogue.layout(name).expect("a type that is known");
        let message = bytes(hex);
        let record =
            cdr::decode(&layout, &message).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(cdr::encode(&record), message, "{name}");
        types.insert(name);
        for end in 0..message.len().min(300) {
            // Cut off anywhere it is refused, unless only what fills it up is missing; it never panics.
            let _ = cdr::decode(&layout, &message[..end]);
        }
    }
    assert!(types.len() > 150, "only {} types", types.len());
}

#[test]
fn defaults_of_every_type_are_written_and_read() {
    let mut catalogue = Catalogue::new(Generation::Ros2);
    for name in catalogue
        .names()
        .iter()
        .filter(|name| name.kind == ros_interfaces::InterfaceKind::Message)
    {
        let record = Record::new(&catalogue.layout_of(name).expect("a type that is built in"));
        assert_eq!(
            cdr::decode(record.layout(), &cdr::encode(&record)),
            Ok(record),
            "{name}"
        );
    }
}
