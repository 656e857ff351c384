//! Values as bytes that differ wherever the values do, and their hashes.

use std::fmt::Debug;

use scene::{Data, Key};
use twox_hash::XxHash3_64;

/// The bytes of one value. The buffer is used again for the next one.
#[derive(Default)]
pub(super) struct Bytes(Vec<u8>);

/// What a value is about, as a seed of its hash: equal values of different properties or objects have different hashes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Key64(u64);

impl Key64 {
    /// Of a property.
    pub(super) fn of_name(name: &str) -> Self {
        Self(XxHash3_64::oneshot(name.as_bytes()))
    }

    /// Of the same property of one target.
    pub(super) fn on(self, target: i64) -> Self {
        Self(
            self.0
                ^ target
                    .cast_unsigned()
                    .wrapping_add(1)
                    .wrapping_mul(0x9e37_79b9_7f4a_7c15),
        )
    }
}

impl Bytes {
    /// The hash of the bytes so far, under a key. The buffer is empty then.
    pub(super) fn take_hash(&mut self, key: Key64) -> u64 {
        let hash = XxHash3_64::oneshot_with_seed(key.0, &self.0);
        self.0.clear();
        hash
    }

    pub(super) fn int(&mut self, value: i64) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    /// A length or another number of things.
    pub(super) fn count(&mut self, value: usize) {
        self.0.extend_from_slice(&(value as u64).to_le_bytes());
    }

    /// By its bits: -0 is another value than 0.
    pub(super) fn float(&mut self, value: f64) {
        self.0.extend_from_slice(&value.to_bits().to_le_bytes());
    }

    pub(super) fn floats(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.float(*value));
    }

    /// A list of floats of unknown length.
    pub(super) fn list(&mut self, values: &[f64]) {
        self.count(values.len());
        self.floats(values);
    }

    pub(super) fn text(&mut self, text: &[u8]) {
        self.count(text.len());
        self.0.extend_from_slice(text);
    }

    /// A value that changes so rarely that its text for debugging will do, which has every field.
    pub(super) fn debug(&mut self, value: &impl Debug) {
        self.text(format!("{value:?}").as_bytes());
    }

    fn tag(&mut self, tag: u8) {
        self.0.push(tag);
    }

    pub(super) fn data(&mut self, data: &Data) {
        match data {
            Data::Nil => self.tag(0),
            Data::Bool(value) => self.tag(1 + u8::from(*value)),
            Data::Int(value) => {
                self.tag(3);
                self.int(*value);
            }
            Data::Float(value) => {
                self.tag(4);
                self.float(*value);
            }
            Data::Text(text) => {
                self.tag(5);
                self.text(text);
            }
            Data::Buffer(bytes) => {
                self.tag(6);
                self.text(bytes);
            }
            Data::Array(items) => {
                self.tag(7);
                self.count(items.len());
                items.iter().for_each(|item| self.data(item));
            }
            Data::Map(entries) => self.map(entries),
        }
    }

    /// The entries of a table have no order.
    fn map(&mut self, entries: &[(Key, Data)]) {
        let mut sum = 0_u64;
        for (key, value) in entries {
            let mut entry = Self::default();
            entry.key(key);
            entry.data(value);
            sum = sum.wrapping_add(entry.take_hash(Key64(0)));
        }
        self.tag(8);
        self.count(entries.len());
        self.int(sum.cast_signed());
    }

    fn key(&mut self, key: &Key) {
        match key {
            Key::Bool(value) => self.data(&Data::Bool(*value)),
            Key::Int(value) => self.data(&Data::Int(*value)),
            Key::Float(value) => self.data(&Data::Float(*value)),
            Key::Text(text) => {
                self.tag(5);
                self.text(text);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hash(data: &Data) -> u64 {
        let mut bytes = Bytes::default();
        bytes.data(data);
        bytes.take_hash(Key64::of_name("x"))
    }

    #[test]
    fn different_values_have_different_hashes() {
        let text = |text: &str| Data::Text(text.into());
        let values = [
            Data::Nil,
            Data::Bool(false),
            Data::Bool(true),
            Data::Int(0),
            Data::Float(0.0),
            Data::Float(-0.0),
            text(""),
            text("a"),
            Data::Buffer(b"a".to_vec()),
            Data::Array(vec![text("a"), text("b")]),
            Data::Array(vec![text("ab"), text("")]),
            Data::Array(vec![]),
            Data::Map(vec![]),
            Data::Map(vec![(Key::Int(1), text("a"))]),
            Data::Map(vec![(Key::Text(b"1".to_vec()), text("a"))]),
        ];
        for (i, one) in values.iter().enumerate() {
            for other in &values[..i] {
                assert_ne!(hash(one), hash(other), "{one:?} and {other:?}");
            }
        }
    }

    #[test]
    fn the_order_of_entries_does_not_count() {
        let entry = |n: i64| (Key::Int(n), Data::Int(n));
        let (one, other) = (vec![entry(1), entry(2)], vec![entry(2), entry(1)]);
        assert_eq!(hash(&Data::Map(one)), hash(&Data::Map(other)));
    }

    #[test]
    fn equal_values_of_others_have_other_hashes() {
        let mut bytes = Bytes::default();
        let mut hash = |key: Key64| {
            bytes.int(5);
            bytes.take_hash(key)
        };
        let (x, y) = (Key64::of_name("x"), Key64::of_name("y"));
        let hashes = [x, y, x.on(0), x.on(1), x.on(-12)].map(&mut hash);
        for (i, one) in hashes.iter().enumerate() {
            assert!(!hashes[..i].contains(one));
        }
        assert_eq!(hash(x), hash(Key64::of_name("x")));
    }
}
