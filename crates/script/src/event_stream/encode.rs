//! Values of properties as the event stream writes them (spec: events 2): CBOR with a few types of its own.
//!
//! Items are encoded here and not by a library, because the stream requires widths that a canonical encoder would not choose: floats
//! of 32 bits for all values, integers of 32 bits inside arrays.

use super::protocol::{Meaning, Protocol};
use scene::{Data, ValueType};
use wire::cbor;
use wire::cbor_head::{BREAK, FALSE, INDEFINITE, NULL, TRUE, major, push_head, push_int};

/// Tags of protocol 4.
mod tag {
    pub const MATRIX: u64 = 40;
    pub const INTS: u64 = 78;
    pub const LONGS: u64 = 79;
    pub const DOUBLES: u64 = 86;
    pub const COLOR: u64 = 4_294_970_000;
    pub const QUATERNION: u64 = 4_294_980_000;
    pub const POSE: u64 = 4_294_980_500;
    pub const HANDLES: u64 = 4_294_999_998;
    pub const HANDLE: u64 = 4_294_999_999;
}

/// A map and a list without a length, and what ends them.
pub(crate) const MAP: u8 = major::MAP | INDEFINITE;
pub(crate) const LIST: u8 = major::ARRAY | INDEFINITE;
pub(crate) const END: u8 = BREAK;

/// The first bytes of what has a width of its own, however small the number.
const INT_32: u8 = major::UNSIGNED | 26;
const INT_64: u8 = major::UNSIGNED | 27;
const FLOAT_32: u8 = major::SIMPLE | 26;

pub(crate) fn text(out: &mut Vec<u8>, text: &[u8]) {
    push_head(out, major::TEXT, text.len() as u64);
    out.extend(text);
}

fn bytes(out: &mut Vec<u8>, bytes: &[u8]) {
    push_head(out, major::BYTES, bytes.len() as u64);
    out.extend(bytes);
}

fn float(out: &mut Vec<u8>, f: f64) {
    out.push(FLOAT_32);
    out.extend(numbers::single(f).to_be_bytes());
}

/// Writes a value of type `ty`; nil as null.
pub(crate) fn value(protocol: Protocol, ty: ValueType, data: &Data, out: &mut Vec<u8>) {
    match (data, ty) {
        // Tables of scripts are sent as the bytes in which they are stored.
        (_, ValueType::Table) => bytes(out, &cbor::encode(data)),
        (Data::Array(items), _) if protocol == Protocol::V4 => tagged_array(ty, items, out),
        (Data::Array(items), _) => plain_array(items, out),
        (Data::Nil, _) => out.push(NULL),
        (Data::Bool(b), _) => out.push(if *b { TRUE } else { FALSE }),
        (Data::Int(i), _) => push_int(out, *i),
        (Data::Float(f), _) => float(out, *f),
        (Data::Text(t), _) => text(out, t),
        (Data::Buffer(b), _) => bytes(out, b),
        (Data::Map(_), _) => bytes(out, &cbor::encode(data)),
    }
}

/// Null: the property is gone.
pub(crate) fn null() -> Vec<u8> {
    vec![NULL]
}

/// Writes a value that protocol 4 takes to mean something else than protocol 3 does.
pub(crate) fn with_meaning(meaning: Meaning, ty: ValueType, data: &Data, out: &mut Vec<u8>) {
    match (meaning, data) {
        (Meaning::Not, Data::Bool(b)) => out.push(if *b { FALSE } else { TRUE }),
        (Meaning::Handle, Data::Int(handle)) => {
            push_head(out, major::TAG, tag::HANDLE);
            push_int(out, *handle);
        }
        (Meaning::Handles, Data::Array(handles)) => {
            push_head(out, major::TAG, tag::HANDLES);
            push_head(out, major::ARRAY, handles.len() as u64);
            handles
                .iter()
                .filter_map(as_int)
                .for_each(|handle| push_int(out, handle));
        }
        _ => value(Protocol::V4, ty, data, out),
    }
}

/// Elements have one width each: 32 bits, or 64 for integers beyond.
fn plain_array(items: &[Data], out: &mut Vec<u8>) {
    out.push(LIST);
    let wide = items
        .iter()
        .filter_map(as_int)
        .any(|i| i32::try_from(i).is_err());
    for item in items {
        match item {
            Data::Int(i) if wide => wide_int(out, *i),
            Data::Int(i) => narrow_int(out, *i),
            Data::Float(f) => float(out, *f),
            _ => out.push(NULL),
        }
    }
    out.push(END);
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "only integers of 32 bits come here"
)]
fn narrow_int(out: &mut Vec<u8>, i: i64) {
    out.push(INT_32 | sign(i));
    out.extend((magnitude(i) as u32).to_be_bytes());
}

fn wide_int(out: &mut Vec<u8>, i: i64) {
    out.push(INT_64 | sign(i));
    out.extend(magnitude(i).to_be_bytes());
}

fn sign(i: i64) -> u8 {
    if i < 0 {
        major::NEGATIVE
    } else {
        major::UNSIGNED
    }
}

/// CBOR counts negative integers from -1 down.
fn magnitude(i: i64) -> i64 {
    if i < 0 { !i } else { i }
}

fn as_int(item: &Data) -> Option<i64> {
    if let Data::Int(i) = item {
        Some(*i)
    } else {
        None
    }
}

fn tagged_array(ty: ValueType, items: &[Data], out: &mut Vec<u8>) {
    match ty {
        ValueType::Pose => numbers(tag::POSE, items, out),
        ValueType::Quaternion => numbers(tag::QUATERNION, items, out),
        ValueType::Color => colour(items, out),
        ValueType::Vector2 | ValueType::Vector3 => column(items, out),
        ValueType::IntArray | ValueType::IntArray2 => integers(items, out),
        _ => doubles(items, out),
    }
}

fn numbers(tag: u64, items: &[Data], out: &mut Vec<u8>) {
    push_head(out, major::TAG, tag);
    push_head(out, major::ARRAY, items.len() as u64);
    items
        .iter()
        .filter_map(Data::as_f64)
        .for_each(|f| float(out, f));
}

/// Four bytes, red green blue alpha; the factor is the original's.
fn colour(items: &[Data], out: &mut Vec<u8>) {
    push_head(out, major::TAG, tag::COLOR);
    let channels = items
        .iter()
        .filter_map(Data::as_f64)
        .map(|part| numbers::level(part * 255.1));
    let rgba: Vec<u8> = channels.chain([255]).collect();
    bytes(out, &rgba);
}

/// A matrix of one column: `[[rows, columns], [values]]`.
fn column(items: &[Data], out: &mut Vec<u8>) {
    push_head(out, major::TAG, tag::MATRIX);
    push_head(out, major::ARRAY, 2);
    push_head(out, major::ARRAY, 2);
    push_int(out, numbers::count(items.len()));
    push_int(out, 1);
    push_head(out, major::ARRAY, items.len() as u64);
    items
        .iter()
        .filter_map(Data::as_f64)
        .for_each(|f| float(out, f));
}

fn integers(items: &[Data], out: &mut Vec<u8>) {
    let ints: Vec<i64> = items.iter().filter_map(as_int).collect();
    let narrow: Result<Vec<i32>, _> = ints.iter().map(|&i| i32::try_from(i)).collect();
    match narrow {
        Ok(narrow) => packed(
            tag::INTS,
            narrow.iter().flat_map(|i| i.to_le_bytes()).collect(),
            out,
        ),
        Err(_) => packed(
            tag::LONGS,
            ints.iter().flat_map(|i| i.to_le_bytes()).collect(),
            out,
        ),
    }
}

fn doubles(items: &[Data], out: &mut Vec<u8>) {
    packed(
        tag::DOUBLES,
        items
            .iter()
            .filter_map(Data::as_f64)
            .flat_map(f64::to_le_bytes)
            .collect(),
        out,
    );
}

fn packed(tag: u64, content: Vec<u8>, out: &mut Vec<u8>) {
    push_head(out, major::TAG, tag);
    bytes(out, &content);
}

#[cfg(test)]
mod tests {
    use super::{Data, Protocol, ValueType, value};

    fn hex(protocol: Protocol, ty: ValueType, data: impl Into<Data>) -> String {
        let mut out = Vec::new();
        value(protocol, ty, &data.into(), &mut out);
        out.iter().map(|byte| format!("{byte:02x}")).collect()
    }

    #[test]
    fn protocol_3_writes_plain_numbers_of_32_bits() {
        let v3 = |ty, data: Data| hex(Protocol::V3, ty, data);
        assert_eq!(v3(ValueType::Float, 0.5.into()), "fa3f000000");
        assert_eq!(v3(ValueType::Int, (-500).into()), "3901f3");
        assert_eq!(
            v3(ValueType::IntArray, vec![1, -1].into()),
            "9f1a000000013a00000000ff"
        );
        assert_eq!(
            v3(ValueType::IntArray, vec![1 << 40].into()),
            "9f1b0000010000000000ff"
        );
        assert_eq!(
            v3(ValueType::Vector3, vec![1.0, 2.0, 3.0].into()),
            "9ffa3f800000fa40000000fa40400000ff"
        );
        assert_eq!(
            v3(ValueType::Table, Data::map([("a", 1.into())])),
            "45bf616101ff"
        );
    }

    #[test]
    fn protocol_4_tags_what_a_value_means() {
        let v4 = |ty, data: Data| hex(Protocol::V4, ty, data);
        assert_eq!(
            v4(ValueType::Vector3, vec![1.0, 2.0, 3.0].into()),
            "d82882820301".to_owned() + "83fa3f800000fa40000000fa40400000"
        );
        assert_eq!(
            v4(ValueType::Color, vec![1.0, 0.5, 0.0].into()),
            "db0000000100000a9044ff7f00ff"
        );
        assert_eq!(v4(ValueType::IntArray, vec![-1].into()), "d84e44ffffffff");
        assert!(v4(ValueType::Pose, vec![0.0; 7].into()).starts_with("db000000010000339487fa"));
    }
}
