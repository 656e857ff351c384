//! Records as bytes, in little-endian order.

use std::sync::Arc;

use super::LITTLE;
use crate::{
    Array, ByteOrder, Duration, Element, FieldType, Layout, Number, Record, Shape, Time, Value,
};

/// The bytes of a record, with the head of four bytes.
#[must_use]
pub fn encode(record: &Record) -> Vec<u8> {
    let mut writer = Writer {
        out: LITTLE.to_vec(),
    };
    writer.record(record);
    writer.out
}

struct Writer {
    out: Vec<u8>,
}

impl Writer {
    fn align(&mut self, size: usize) {
        let length = (self.out.len() - LITTLE.len()).next_multiple_of(size) + LITTLE.len();
        self.out.resize(length, 0);
    }

    fn record(&mut self, record: &Record) {
        record
            .iter()
            .for_each(|(field, value)| self.value(value, &field.field_type));
        // A structure of DDS has at least one member, so ROS 2 adds one.
        if record.values().is_empty() {
            self.out.push(0);
        }
    }

    fn value(&mut self, value: &Value, field_type: &FieldType<Arc<Layout>>) {
        match value {
            Value::Number(number) => self.number(*number),
            Value::String(text) => self.text(text, &field_type.element),
            Value::Time(time) => self.time(*time),
            Value::Duration(duration) => self.duration(*duration),
            Value::Record(record) => self.record(record),
            Value::Array(array) => {
                if matches!(field_type.shape, Shape::Sequence(_)) {
                    self.length(array.len());
                }
                self.array(array, &field_type.element);
            }
        }
    }

    fn array(&mut self, array: &Array, element: &Element<Arc<Layout>>) {
        match array {
            Array::Numbers(numbers) => {
                if !numbers.is_empty() {
                    self.align(numbers.number_type().size());
                }
                numbers.write(&mut self.out, ByteOrder::Little);
            }
            Array::Strings(all) => all.iter().for_each(|text| self.text(text, element)),
            Array::Times(all) => all.iter().for_each(|&time| self.time(time)),
            Array::Durations(all) => all.iter().for_each(|&duration| self.duration(duration)),
            Array::Records(all) => all.iter().for_each(|record| self.record(record)),
        }
    }

    fn number(&mut self, number: Number) {
        self.align(number.number_type().size());
        number.write(&mut self.out, ByteOrder::Little);
    }

    /// Values with more than 4 GiB of anything do not come into being: memory limits are lower.
    fn length(&mut self, length: usize) {
        self.align(4);
        self.out.extend_from_slice(&(length as u32).to_le_bytes());
    }

    fn text(&mut self, text: &[u8], element: &Element<Arc<Layout>>) {
        if matches!(element, Element::WString(_)) {
            let units: Vec<u16> = String::from_utf8_lossy(text).encode_utf16().collect();
            self.length(units.len());
            units
                .iter()
                .for_each(|unit| self.out.extend_from_slice(&unit.to_le_bytes()));
            return;
        }
        // With a zero at the end; one within would end the text for other readers.
        self.length(text.len() + 1);
        self.out.extend_from_slice(text);
        self.out.push(0);
    }

    fn time(&mut self, time: Time) {
        self.number(Number::UInt32(time.sec));
        self.number(Number::UInt32(time.nanosec));
    }

    fn duration(&mut self, duration: Duration) {
        self.number(Number::Int32(duration.sec));
        self.number(Number::Int32(duration.nanosec));
    }
}
