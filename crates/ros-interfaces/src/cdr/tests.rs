//! Bytes that were computed by hand, both orders, and damaged messages.

use std::sync::Arc;

use super::{decode, encode};
use crate::{
    Array, Catalogue, DecodeError, Generation, InterfaceKind, Layout, Number, Numbers, Record,
    TypeName, Value,
};

fn layout(text: &str) -> Arc<Layout> {
    let mut catalogue = Catalogue::new(Generation::Ros2);
    let name = TypeName::new("test_msgs", InterfaceKind::Message, "Tested").expect("a name");
    catalogue.add_text(&name, text).expect("a text");
    catalogue.layout_of(&name).expect("a layout")
}

fn sample() -> Record {
    let layout =
        layout("uint8 a\nfloat64 b\nstring c\nint16[] d\nuint8 e\nfloat64[] f\nbool[3] g\n");
    let mut record = Record::new(&layout);
    let numbers = |numbers| Value::Array(Array::Numbers(numbers));
    record.set("a", Value::Number(Number::UInt8(7))).expect("a");
    record
        .set("b", Value::Number(Number::Float64(1.0)))
        .expect("b");
    record.set("c", Value::String(b"hey".to_vec())).expect("c");
    record
        .set("d", numbers(Numbers::Int16(vec![1, -1])))
        .expect("d");
    record
        .set("g", numbers(Numbers::Bool(vec![true, false, true])))
        .expect("g");
    record
}

const BYTES: &[u8] = &[
    0, 1, 0, 0, // little endian
    7, 0, 0, 0, 0, 0, 0, 0, // a, filled up for b
    0, 0, 0, 0, 0, 0, 0xf0, 0x3f, // b
    4, 0, 0, 0, b'h', b'e', b'y', 0, // c
    2, 0, 0, 0, 1, 0, 0xff, 0xff, // d
    0, 0, 0, 0, 0, 0, 0, 0, // e, filled up, length of f, which has no elements to be aligned
    1, 0, 1, // g
];

#[test]
fn numbers_are_aligned_to_their_size() {
    let record = sample();
    assert_eq!(encode(&record), BYTES);
    assert_eq!(decode(record.layout(), BYTES), Ok(record));
}

#[test]
fn both_orders_are_read() {
    let layout = layout("uint16 a\nint32 b\n");
    let record =
        decode(&layout, &[0, 0, 0, 0, 1, 2, 0, 0, 0xff, 0xff, 0xff, 0xfe]).expect("a message");
    assert_eq!(
        record.values(),
        [
            Value::Number(Number::UInt16(0x0102)),
            Value::Number(Number::Int32(-2))
        ]
    );
    let others = [0, 7, 0, 0, 1, 2, 0, 0, 0, 0, 0, 0];
    assert_eq!(
        decode(&layout, &others),
        Err(DecodeError::Representation([0, 7]))
    );
}

#[test]
fn a_structure_without_fields_is_one_byte() {
    let record = Record::new(&layout("# nothing\n"));
    assert_eq!(encode(&record), [0, 1, 0, 0, 0]);
    assert_eq!(decode(record.layout(), &[0, 1, 0, 0, 0]), Ok(record));
}

#[test]
fn damaged_messages_are_errors() {
    let record = sample();
    for end in 0..BYTES.len() {
        assert!(
            decode(record.layout(), &BYTES[..end]).is_err(),
            "cut after {end} bytes"
        );
    }
    let long = [BYTES, &[0; 8]].concat();
    assert_eq!(
        decode(record.layout(), &long),
        Err(DecodeError::Long { rest: 8 })
    );
    let huge = layout("string[] names\n");
    assert!(decode(&huge, &[0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff]).is_err());
}
