//! Messages of protocol buffers, written field by field (Protocol Buffers Encoding).

/// A message in the making.
#[derive(Debug, Clone, Default)]
pub(super) struct Proto(Vec<u8>);

/// How a field is stored.
#[derive(Clone, Copy)]
enum Wire {
    Varint = 0,
    Fixed64 = 1,
    Length = 2,
    Fixed32 = 5,
}

impl Proto {
    pub(super) fn new() -> Self {
        Self::default()
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.0
    }

    fn tag(&mut self, field: u32, wire: Wire) {
        self.varint(u64::from(field) << 3 | wire as u64);
    }

    fn varint(&mut self, mut number: u64) {
        while number >= 0x80 {
            self.0.push(number as u8 | 0x80);
            number >>= 7;
        }
        self.0.push(number as u8);
    }

    pub(super) fn int(mut self, field: u32, number: u64) -> Self {
        self.tag(field, Wire::Varint);
        self.varint(number);
        self
    }

    pub(super) fn double(mut self, field: u32, number: f64) -> Self {
        self.tag(field, Wire::Fixed64);
        self.0.extend(number.to_le_bytes());
        self
    }

    pub(super) fn fixed32(mut self, field: u32, number: u32) -> Self {
        self.tag(field, Wire::Fixed32);
        self.0.extend(number.to_le_bytes());
        self
    }

    pub(super) fn bytes(mut self, field: u32, bytes: &[u8]) -> Self {
        self.tag(field, Wire::Length);
        self.varint(bytes.len() as u64);
        self.0.extend_from_slice(bytes);
        self
    }

    pub(super) fn text(self, field: u32, text: &str) -> Self {
        self.bytes(field, text.as_bytes())
    }

    pub(super) fn message(self, field: u32, message: Self) -> Self {
        self.bytes(field, &message.0)
    }

    /// A repeated field of messages.
    pub fn messages(self, field: u32, all: impl IntoIterator<Item = Self>) -> Self {
        all.into_iter()
            .fold(self, |message, one| message.message(field, one))
    }

    /// Doubles in the fields 1, 2, 3 and so on: vectors, quaternions, colours.
    pub(super) fn doubles(numbers: &[f64]) -> Self {
        (1..)
            .zip(numbers)
            .fold(Self::new(), |message, (field, number)| {
                message.double(field, *number)
            })
    }
}
