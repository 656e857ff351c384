//! Bytes that are published: the examples of RFC 8949 (appendix A), and what Python's `marshal` writes.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use scene::{Data, Key};
use wire::cbor_head::{BREAK, Head, major, push_float, push_head, push_int};
use wire::marshal::{Declared, Encoder, MarshalError};
use wire::{cbor, marshal};

fn bytes(hex: &str) -> Vec<u8> {
    let pairs = hex.as_bytes().chunks(2);
    pairs
        .map(|pair| u8::from_str_radix(str::from_utf8(pair).unwrap(), 16).unwrap())
        .collect()
}

const INTEGERS: [(&str, i64); 14] = [
    ("00", 0),
    ("01", 1),
    ("17", 23),
    ("1818", 24),
    ("1864", 100),
    ("1903e8", 1000),
    ("1a000f4240", 1_000_000),
    ("1b000000e8d4a51000", 1_000_000_000_000),
    ("20", -1),
    ("29", -10),
    ("3863", -100),
    ("3903e7", -1000),
    ("1b7fffffffffffffff", i64::MAX),
    ("3b7fffffffffffffff", i64::MIN),
];

#[test]
fn integers_are_as_short_as_can_be() {
    for (hex, number) in INTEGERS {
        let mut out = Vec::new();
        push_int(&mut out, number);
        assert_eq!(out, bytes(hex), "{number}");
        assert_eq!(cbor::decode(&bytes(hex)), Ok(Data::Int(number)));
    }
}

#[test]
fn integers_beyond_64_bits_are_floats() {
    for (hex, number) in [
        ("1bffffffffffffffff", 18_446_744_073_709_551_615.0),
        ("3bffffffffffffffff", -18_446_744_073_709_551_616.0),
        ("3b8000000000000000", -9_223_372_036_854_775_809.0),
    ] {
        assert_eq!(cbor::decode(&bytes(hex)), Ok(Data::Float(number)), "{hex}");
    }
}

#[test]
fn floats_are_as_short_as_can_be() {
    for (hex, number) in [
        ("f90000", 0.0),
        ("f98000", -0.0),
        ("f93c00", 1.0),
        ("fb3ff199999999999a", 1.1),
        ("f93e00", 1.5),
        ("f97bff", 65504.0),
        ("fa47c35000", 100_000.0),
        ("fa7f7fffff", f64::from(f32::MAX)),
        ("fb7e37e43c8800759c", 1.0e300),
        ("f90001", 5.960_464_477_539_063e-8),
        ("f90400", 0.000_061_035_156_25),
        ("f9c400", -4.0),
        ("fbc010666666666666", -4.1),
        ("f97c00", f64::INFINITY),
        ("f9fc00", f64::NEG_INFINITY),
    ] {
        let mut out = Vec::new();
        push_float(&mut out, number);
        assert_eq!(out, bytes(hex), "{number}");
        let (head, end) = Head::read(&out, 0).unwrap();
        let read = head.float().unwrap();
        assert_eq!((read.to_bits(), end), (number.to_bits(), out.len()));
        assert!(!head.is_break());
    }
    assert!(
        Head::read(&bytes("f97e00"), 0)
            .unwrap()
            .0
            .float()
            .unwrap()
            .is_nan()
    );
}

#[test]
fn only_floats_are_floats_and_only_a_break_is_a_break() {
    for hex in ["1903e8", "f5", "f6", "1a000f4240", "ff"] {
        let head = Head::read(&bytes(hex), 0).unwrap().0;
        assert_eq!(head.float(), None, "{hex}");
        assert_eq!(head.is_break(), hex == "ff", "{hex}");
    }
    assert!(Head::read(&[BREAK], 0).unwrap().0.is_break());
    assert!(!Head::read(&bytes("9f"), 0).unwrap().0.is_break());
    assert!(!Head::read(&bytes("f6"), 0).unwrap().0.is_break());
}

#[test]
fn other_items_are_as_in_the_appendix() {
    let text = |text: &str| Data::text(text);
    let list = |items: &[i64]| Data::Array(items.iter().copied().map(Data::Int).collect());
    for (hex, data) in [
        ("f4", Data::Bool(false)),
        ("f5", Data::Bool(true)),
        ("f6", Data::Nil),
        ("f7", Data::Nil),
        ("c11a514b67b0", Data::Int(1_363_896_240)),
        ("4401020304", Data::Buffer(vec![1, 2, 3, 4])),
        ("6449455446", text("IETF")),
        ("80", list(&[])),
        ("83010203", list(&[1, 2, 3])),
        (
            "a201020304",
            Data::Map(vec![
                (Key::Int(1), Data::Int(2)),
                (Key::Int(3), Data::Int(4)),
            ]),
        ),
        (
            "826161a161626163",
            Data::Array(vec![text("a"), Data::map([("b", text("c"))])]),
        ),
        ("5f42010243030405ff", Data::Buffer(vec![1, 2, 3, 4, 5])),
        ("7f657374726561646d696e67ff", text("streaming")),
        ("9fff", list(&[])),
        ("9f010203ff", list(&[1, 2, 3])),
        (
            "bf6346756ef563416d7421ff",
            Data::map([("Fun", Data::Bool(true)), ("Amt", Data::Int(-2))]),
        ),
    ] {
        assert_eq!(cbor::decode(&bytes(hex)), Ok(data), "{hex}");
    }
    for wrong in [
        "",
        "ff",
        "5f01ff",
        "7f6161",
        "83ff",
        "a1f6",
        "18",
        "a1f97e0001",
        "a101ff",
        "9f01",
        "6261",
    ] {
        assert!(cbor::decode(&bytes(wrong)).is_err(), "{wrong}");
    }
}

/// A hundred levels and not more, of lists, tags, keys and values.
#[test]
fn items_may_be_nested_a_hundred_times() {
    for level in ["81", "c1", "a101"] {
        let nested = |levels: usize| bytes(&(level.repeat(levels) + "01"));
        assert!(cbor::decode(&nested(100)).is_ok(), "{level}");
        assert!(cbor::decode(&nested(101)).is_err(), "{level}");
    }
}

#[test]
fn heads_of_all_kinds_have_their_kind_and_number() {
    for kind in [
        major::UNSIGNED,
        major::NEGATIVE,
        major::BYTES,
        major::TEXT,
        major::ARRAY,
        major::MAP,
        major::TAG,
    ] {
        for (argument, length) in [
            (0, 1),
            (23, 1),
            (24, 2),
            (0xff, 2),
            (0x100, 3),
            (0xffff, 3),
            (0x1_0000, 5),
            (0xffff_ffff, 5),
            (0x1_0000_0000, 9),
        ] {
            let mut out = vec![0x77];
            push_head(&mut out, kind, argument);
            let (head, end) = Head::read(&out, 1).unwrap();
            assert_eq!(
                (head.major, head.argument, end),
                (kind, argument, out.len())
            );
            assert_eq!(out.len(), 1 + length);
        }
    }
}

#[test]
fn integers_of_python_have_digits_of_15_bits() {
    // marshal.dumps(n, 2)
    for (written, number) in [
        (&b"l\x03\0\0\0\0\0\0\0\x04\0"[..], Data::Int(1 << 32)),
        (b"l\xfd\xff\xff\xff\0\0\0\0\x04\0", Data::Int(-(1 << 32))),
        (b"l\x02\0\0\0\x01\0\x01\0", Data::Int(32769)),
        (
            b"l\x05\0\0\0\xff\x7f\xff\x7f\xff\x7f\xff\x7f\x07\0",
            Data::Int(i64::MAX),
        ),
        (
            b"l\x05\0\0\0\0\0\0\0\0\0\0\0\x08\0",
            Data::Float(9_223_372_036_854_775_808.0),
        ),
        (
            b"l\x06\0\0\0\0\0\0\0\0\0\0\0\0\0\x01\0",
            Data::Float(2_f64.powi(75)),
        ),
        (
            b"l\xfa\xff\xff\xff\0\0\0\0\0\0\0\0\0\0\x01\0",
            Data::Float(-2_f64.powi(75)),
        ),
        (b"l\0\0\0\0", Data::Int(0)),
    ] {
        assert_eq!(marshal::decode(written), Ok(number), "{written:?}");
    }
}

#[test]
fn keys_of_python_become_keys() {
    // marshal.dumps({True: 1}, 2) and so on
    let one = Data::Int(1);
    for (written, key) in [
        (&b"{Ti\x01\0\0\x000"[..], Key::Bool(true)),
        (b"{i\xfe\xff\xff\xffi\x01\0\0\x000", Key::Int(-2)),
        (b"{g\0\0\0\0\0\0\xe0?i\x01\0\0\x000", Key::Float(0.5)),
        (b"{u\x01\0\0\0ki\x01\0\0\x000", Key::Text(b"k".to_vec())),
        (b"{s\x01\0\0\0ki\x01\0\0\x000", Key::Text(b"k".to_vec())),
    ] {
        assert_eq!(
            marshal::decode(written),
            Ok(Data::Map(vec![(key, one.clone())]))
        );
    }
    let not_a_number = b"{g\0\0\0\0\0\0\xf8\x7fi\x01\0\0\x000";
    assert_eq!(marshal::decode(not_a_number), Err(MarshalError::Key));
    assert_eq!(
        marshal::decode(b"{[\0\0\0\0i\x01\0\0\x000"),
        Err(MarshalError::Key)
    );
}

#[test]
fn texts_lists_and_tuples_are_written_as_python_does() {
    let mut encoder = Encoder::default();
    encoder.tuple(2);
    encoder.text("ab");
    encoder.list(&[Data::Int(1), Data::Array(Vec::new())]);
    assert_eq!(
        encoder.into_bytes(),
        b"(\x02\0\0\0u\x02\0\0\0ab[\x02\0\0\0i\x01\0\0\0{0"
    );
}

#[test]
fn only_the_first_result_has_the_declared_type() {
    let written = |values: &[Data], results, first| {
        let mut encoder = Encoder::default();
        encoder.results(values, Declared { results, first });
        encoder.into_bytes()
    };
    let texts = [Data::text("a"), Data::text("b")];
    assert_eq!(
        written(&texts, true, "buffer"),
        b"[\x02\0\0\0s\x01\0\0\0au\x01\0\0\0b"
    );
    let zeros = [Data::text("\0"), Data::text("\0")];
    assert_eq!(
        written(&zeros, true, "string"),
        b"[\x02\0\0\0u\x01\0\0\0\0s\x01\0\0\0\0"
    );
    let no_text = [Data::Text(vec![0xff])];
    assert_eq!(
        written(&no_text, true, "string"),
        b"[\x01\0\0\0s\x01\0\0\0\xff"
    );
    let empty = [Data::Map(Vec::new())];
    assert_eq!(written(&empty, true, ""), b"[\x01\0\0\0[\0\0\0\0");
    assert_eq!(written(&empty, false, ""), b"[\x01\0\0\0{0");
    let full = [Data::map([("k", Data::Nil)])];
    assert_eq!(written(&full, true, ""), b"[\x01\0\0\0{u\x01\0\0\0kN0");
    assert_eq!(
        written(&[Data::Array(vec![Data::Nil])], false, ""),
        b"[\x01\0\0\0[\x01\0\0\0N"
    );
}

#[test]
fn floats_that_are_numbers_may_be_keys() {
    let entry = |key: f64| Ok(Data::Map(vec![(Key::Float(key), Data::Int(1))]));
    assert_eq!(cbor::decode(&bytes("a1f93e0001")), entry(1.5));
    assert_eq!(cbor::decode(&bytes("a1fbc01066666666666601")), entry(-4.1));
}

/// A hundred levels and not more, of lists and of values of dictionaries.
#[test]
fn values_of_python_may_be_nested_a_hundred_times() {
    let lists = |levels: usize| [b"[\x01\0\0\0".repeat(levels), b"N".to_vec()].concat();
    let maps = |levels: usize| [b"{T".repeat(levels), b"N".to_vec(), b"0".repeat(levels)].concat();
    for nested in [lists(100), maps(100)] {
        assert!(marshal::decode(&nested).is_ok());
    }
    for nested in [lists(101), maps(101)] {
        assert_eq!(marshal::decode(&nested), Err(MarshalError::TooNested));
    }
}
