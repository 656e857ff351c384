//! Records as bytes: fields one after the other in little-endian order, lengths of 32 bits before strings and sequences.

use std::sync::Arc;

use crate::{Array, ByteOrder, Duration, FieldType, Layout, Record, Shape, Time, Value};

/// The bytes of a record.
#[must_use]
pub fn encode(record: &Record) -> Vec<u8> {
    let mut out = Vec::new();
    write_record(record, &mut out);
    out
}

fn write_record(record: &Record, out: &mut Vec<u8>) {
    for (field, value) in record.iter() {
        write_value(value, &field.field_type, out);
    }
}

fn write_value(value: &Value, field_type: &FieldType<Arc<Layout>>, out: &mut Vec<u8>) {
    match value {
        Value::Number(number) => number.write(out, ByteOrder::Little),
        Value::String(text) => write_string(text, out),
        Value::Time(time) => write_time(*time, out),
        Value::Duration(duration) => write_duration(*duration, out),
        Value::Record(record) => write_record(record, out),
        Value::Array(array) => {
            if matches!(field_type.shape, Shape::Sequence(_)) {
                write_length(array.len(), out);
            }
            write_array(array, out);
        }
    }
}

fn write_array(array: &Array, out: &mut Vec<u8>) {
    match array {
        Array::Numbers(numbers) => numbers.write(out, ByteOrder::Little),
        Array::Strings(all) => all.iter().for_each(|text| write_string(text, out)),
        Array::Times(all) => all.iter().for_each(|&time| write_time(time, out)),
        Array::Durations(all) => all
            .iter()
            .for_each(|&duration| write_duration(duration, out)),
        Array::Records(all) => all.iter().for_each(|record| write_record(record, out)),
    }
}

/// Values with more than 4 GiB of anything do not come into being: memory limits are lower.
fn write_length(length: usize, out: &mut Vec<u8>) {
    out.extend_from_slice(&(length as u32).to_le_bytes());
}

fn write_string(text: &[u8], out: &mut Vec<u8>) {
    write_length(text.len(), out);
    out.extend_from_slice(text);
}

fn write_time(time: Time, out: &mut Vec<u8>) {
    out.extend_from_slice(&time.sec.to_le_bytes());
    out.extend_from_slice(&time.nanosec.to_le_bytes());
}

fn write_duration(duration: Duration, out: &mut Vec<u8>) {
    out.extend_from_slice(&duration.sec.to_le_bytes());
    out.extend_from_slice(&duration.nanosec.to_le_bytes());
}
