//! Python's `marshal` format, version 2: values between the simulator and its Python processes.
//!
//! The format is built into every Python, where it is the fastest way to write and read plain values. Version 2 has no references and no
//! interned texts: a value is a type byte and its content, numbers little-endian. Only the types that scripts can pass on are known here.

use scene::{Data, Key};

/// Maximum nesting of lists and dictionaries.
const MAX_DEPTH: usize = 100;
/// Bits of each digit of a long integer.
const DIGIT_BITS: u32 = 15;
/// Digits that 64 bits may need.
const DIGITS_OF_I64: u32 = 5;
/// Room is made for so many items before they are seen.
const MAX_HINT: usize = 1 << 10;

/// Why bytes are no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum MarshalError {
    /// The bytes end within the value.
    #[error("the value ends too early")]
    Truncated,
    /// More bytes follow the value.
    #[error("there are bytes after the value")]
    Trailing,
    /// A type byte that is none of the known ones.
    #[error("values of type {0:#04x} are unknown")]
    UnknownType(u8),
    /// A length below 0.
    #[error("a length is negative")]
    NegativeLength,
    /// A digit of a long integer is not below 2^15.
    #[error("a digit of an integer is too large")]
    Digit,
    /// A key of a dictionary is neither text, a number nor a boolean.
    #[error("this cannot be the key of a table")]
    Key,
    /// Lists or dictionaries are nested too deeply.
    #[error("lists are nested too deeply")]
    TooNested,
    /// More elements than a script's value may have.
    #[error("there are too many values")]
    TooManyItems,
}

type Result<T> = std::result::Result<T, MarshalError>;

/// Reads one value, which is all of `bytes`. Tuples are lists; integers of more than 64 bits are floats.
///
/// # Errors
/// When the bytes are no such value.
pub fn decode(bytes: &[u8]) -> Result<Data> {
    let mut reader = Reader { bytes, items: 0 };
    let value = reader.value(0)?;
    if reader.bytes.is_empty() {
        Ok(value)
    } else {
        Err(MarshalError::Trailing)
    }
}

struct Reader<'a> {
    bytes: &'a [u8],
    items: usize,
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8]> {
        let (taken, rest) = self
            .bytes
            .split_at_checked(count)
            .ok_or(MarshalError::Truncated)?;
        self.bytes = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N]> {
        let (taken, rest) = self
            .bytes
            .split_first_chunk()
            .ok_or(MarshalError::Truncated)?;
        self.bytes = rest;
        Ok(*taken)
    }

    fn kind(&mut self) -> Result<u8> {
        self.array::<1>().map(|[kind]| kind)
    }

    fn i32(&mut self) -> Result<i32> {
        self.array().map(i32::from_le_bytes)
    }

    fn length(&mut self) -> Result<usize> {
        usize::try_from(self.i32()?).map_err(|_| MarshalError::NegativeLength)
    }

    fn text(&mut self) -> Result<Vec<u8>> {
        let length = self.length()?;
        self.take(length).map(<[u8]>::to_vec)
    }

    fn value(&mut self, depth: usize) -> Result<Data> {
        let kind = self.kind()?;
        self.value_of(kind, depth)
    }

    fn value_of(&mut self, kind: u8, depth: usize) -> Result<Data> {
        self.items += 1;
        if self.items > Data::MAX_ITEMS {
            return Err(MarshalError::TooManyItems);
        }
        if depth > MAX_DEPTH {
            return Err(MarshalError::TooNested);
        }
        Ok(match kind {
            b'N' => Data::Nil,
            b'T' => Data::Bool(true),
            b'F' => Data::Bool(false),
            b'i' => Data::Int(self.i32()?.into()),
            b'l' => self.long()?,
            b'g' => Data::Float(f64::from_le_bytes(self.array()?)),
            b'u' => Data::Text(self.text()?),
            b's' => Data::Buffer(self.text()?),
            b'[' | b'(' => self.list(depth)?,
            b'{' => self.dictionary(depth)?,
            other => return Err(MarshalError::UnknownType(other)),
        })
    }

    fn long(&mut self) -> Result<Data> {
        let count = self.i32()?;
        let negative = count < 0;
        let (mut exact, mut rough) = (Some(0_i128), 0.0);
        for place in 0..count.unsigned_abs() {
            let digit = u16::from_le_bytes(self.array()?);
            if digit >> DIGIT_BITS != 0 {
                return Err(MarshalError::Digit);
            }
            exact = exact
                .filter(|_| place < DIGITS_OF_I64)
                .map(|sum| sum | i128::from(digit) << (DIGIT_BITS * place));
            if digit != 0 {
                rough += f64::from(digit) * power_of_two(DIGIT_BITS.saturating_mul(place));
            }
        }
        let exact = exact.map(|sum| if negative { -sum } else { sum });
        let whole = exact.and_then(|sum| i64::try_from(sum).ok()).map(Data::Int);
        Ok(whole.unwrap_or(Data::Float(if negative { -rough } else { rough })))
    }

    fn list(&mut self, depth: usize) -> Result<Data> {
        let count = self.length()?;
        let mut items = Vec::with_capacity(count.min(MAX_HINT));
        for _ in 0..count {
            items.push(self.value(depth + 1)?);
        }
        Ok(Data::Array(items))
    }

    /// Keys and values in turn, up to a null.
    fn dictionary(&mut self, depth: usize) -> Result<Data> {
        let mut entries = Vec::new();
        loop {
            let kind = self.kind()?;
            if kind == b'0' {
                return Ok(Data::Map(entries));
            }
            let key = key(self.value_of(kind, depth + 1)?)?;
            entries.push((key, self.value(depth + 1)?));
        }
    }
}

fn power_of_two(exponent: u32) -> f64 {
    i32::try_from(exponent).map_or(f64::INFINITY, |exponent| 2_f64.powi(exponent))
}

fn key(value: Data) -> Result<Key> {
    match value {
        Data::Bool(key) => Ok(Key::Bool(key)),
        Data::Int(key) => Ok(Key::Int(key)),
        Data::Float(key) if !key.is_nan() => Ok(Key::Float(key)),
        Data::Text(key) | Data::Buffer(key) => Ok(Key::Text(key)),
        _ => Err(MarshalError::Key),
    }
}

/// The types that the results of a function are declared to have; they decide what Lua leaves open.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Declared<'a> {
    /// The function declares results at all, so that an empty table among them is a list.
    pub results: bool,
    /// The type of the first one.
    pub first: &'a str,
}

/// Writes values.
#[derive(Debug, Default)]
pub struct Encoder(Vec<u8>);

impl Encoder {
    /// The bytes that were written.
    pub fn into_bytes(self) -> Vec<u8> {
        self.0
    }

    /// Begins a tuple of so many values, which follow.
    pub fn tuple(&mut self, count: usize) {
        self.head(b'(', count);
    }

    /// A text.
    pub fn text(&mut self, text: &str) {
        self.bytes(b'u', text.as_bytes());
    }

    /// A list of values of undeclared types: an empty table among them is a dictionary.
    pub fn list(&mut self, values: &[Data]) {
        self.head(b'[', values.len());
        values.iter().for_each(|value| self.value(value));
    }

    /// The results of a function.
    pub fn results(&mut self, values: &[Data], declared: Declared<'_>) {
        self.head(b'[', values.len());
        for (place, value) in values.iter().enumerate() {
            match value {
                Data::Array(items) if declared.results => self.items(items),
                Data::Map(entries) if declared.results && entries.is_empty() => self.head(b'[', 0),
                Data::Text(text) if place == 0 && declared.first == "buffer" => {
                    self.bytes(b's', text);
                }
                Data::Text(text)
                    if place == 0
                        && declared.first == "string"
                        && std::str::from_utf8(text).is_ok() =>
                {
                    self.bytes(b'u', text);
                }
                _ => self.value(value),
            }
        }
    }

    /// One value.
    pub fn value(&mut self, value: &Data) {
        match value {
            Data::Nil => self.0.push(b'N'),
            Data::Bool(true) => self.0.push(b'T'),
            Data::Bool(false) => self.0.push(b'F'),
            Data::Int(number) => self.int(*number),
            Data::Float(number) => self.float(*number),
            Data::Text(text) => self.bytes(if is_text(text) { b'u' } else { b's' }, text),
            Data::Buffer(bytes) => self.bytes(b's', bytes),
            Data::Array(items) if items.is_empty() => self.0.extend_from_slice(b"{0"),
            Data::Array(items) => self.items(items),
            Data::Map(entries) => self.dictionary(entries),
        }
    }

    fn items(&mut self, items: &[Data]) {
        self.head(b'[', items.len());
        items.iter().for_each(|item| self.value(item));
    }

    fn dictionary(&mut self, entries: &[(Key, Data)]) {
        self.0.push(b'{');
        for (key, value) in entries {
            match key {
                Key::Bool(true) => self.0.push(b'T'),
                Key::Bool(false) => self.0.push(b'F'),
                Key::Int(number) => self.int(*number),
                Key::Float(number) => self.float(*number),
                Key::Text(text) => self.bytes(if is_text(text) { b'u' } else { b's' }, text),
            }
            self.value(value);
        }
        self.0.push(b'0');
    }

    fn float(&mut self, number: f64) {
        self.0.push(b'g');
        self.0.extend_from_slice(&number.to_le_bytes());
    }

    fn int(&mut self, number: i64) {
        if let Ok(small) = i32::try_from(number) {
            self.0.push(b'i');
            return self.0.extend_from_slice(&small.to_le_bytes());
        }
        let mut rest = number.unsigned_abs();
        let count = (u64::BITS - rest.leading_zeros())
            .div_ceil(DIGIT_BITS)
            .cast_signed();
        self.0.push(b'l');
        self.0
            .extend_from_slice(&(if number < 0 { -count } else { count }).to_le_bytes());
        while rest != 0 {
            let [low, high, ..] = (rest & 0x7fff).to_le_bytes();
            self.0.extend([low, high]);
            rest >>= DIGIT_BITS;
        }
    }

    fn bytes(&mut self, kind: u8, bytes: &[u8]) {
        self.head(kind, bytes.len());
        self.0.extend_from_slice(bytes);
    }

    /// Lengths fit, since [`Data`] is bounded far below 2 GiB wherever it comes from.
    fn head(&mut self, kind: u8, length: usize) {
        self.0.push(kind);
        self.0
            .extend_from_slice(&i32::try_from(length).unwrap_or(i32::MAX).to_le_bytes());
    }
}

/// Whether a string without a declared type is text, by the rule of CoppeliaSim's CBOR library (spec: zmq-remote-api 8).
fn is_text(bytes: &[u8]) -> bool {
    let printable = |&byte: &u8| matches!(byte, 0x07..=0x0d | 0x20..=0x7e | 0x80..);
    bytes.iter().all(printable) && std::str::from_utf8(bytes).is_ok()
}

#[cfg(test)]
mod tests {
    use test_support::random::Random;

    use super::*;

    fn encoded(value: &Data) -> Vec<u8> {
        let mut encoder = Encoder::default();
        encoder.value(value);
        encoder.into_bytes()
    }

    #[test]
    fn values_come_back() {
        for number in [0, 1, -1, 1 << 31, -(1 << 31), i64::MAX, i64::MIN, 32768] {
            assert_eq!(decode(&encoded(&Data::Int(number))), Ok(Data::Int(number)));
        }
        let map = Data::map([
            ("a", Data::Array(vec![Data::Nil, Data::Bool(true)])),
            ("b", Data::Buffer(vec![0, 255])),
        ]);
        assert_eq!(decode(&encoded(&map)), Ok(map));
        assert_eq!(decode(&encoded(&Data::Float(0.1))), Ok(Data::Float(0.1)));
    }

    #[test]
    fn bytes_are_those_of_python() {
        // marshal.dumps([1, 2.5, 'ä', b'x', None, 1 << 40], 2)
        let expected =
            b"[\x06\0\0\0i\x01\0\0\0g\0\0\0\0\0\0\x04@u\x02\0\0\0\xc3\xa4s\x01\0\0\0xNl\x03\0\0\0\0\0\0\0\0\x04";
        let values = [
            Data::Int(1),
            Data::Float(2.5),
            Data::text("ä"),
            Data::Buffer(b"x".into()),
            Data::Nil,
        ];
        let values = [&values[..], &[Data::Int(1 << 40)]].concat();
        assert_eq!(encoded(&Data::Array(values.clone())), expected);
        assert_eq!(decode(expected), Ok(Data::Array(values)));
    }

    #[test]
    fn integers_that_are_too_large_are_floats() {
        // marshal.dumps(1 << 64, 2), marshal.dumps(-(1 << 63) - 1, 2)
        assert_eq!(
            decode(b"l\x05\0\0\0\0\0\0\0\0\0\0\0\x10\0"),
            Ok(Data::Float(2_f64.powi(64)))
        );
        assert_eq!(
            decode(b"l\xfb\xff\xff\xff\x01\0\0\0\0\0\0\0\x08\0"),
            Ok(Data::Float(-2_f64.powi(63)))
        );
        // 1 << 1500: the digits below the last one are zeros, some of them of places that are no finite numbers.
        let huge = [&b"l\x65\0\0\0"[..], &[0; 200], &[1, 0]].concat();
        assert_eq!(decode(&huge), Ok(Data::Float(f64::INFINITY)));
    }

    #[test]
    fn any_bytes_are_a_value_or_an_error() {
        let list = Data::Array(vec![
            Data::Int(1 << 40),
            Data::Float(0.5),
            Data::text("text"),
            Data::Buffer(vec![0; 4]),
            Data::Nil,
        ]);
        let whole = encoded(&Data::map([
            ("list", list),
            ("map", Data::map([("on", Data::Bool(true))])),
        ]));
        let mut random = Random::new(1);
        let mut below = |end| random.below(end);
        let mut read = 0;
        for _ in 0..20_000 {
            let mut bytes = whole.clone();
            bytes.truncate(if below(4) == 0 {
                below(whole.len()) + 1
            } else {
                whole.len()
            });
            for _ in 0..=below(3) {
                let place = below(bytes.len());
                bytes[place] = if below(2) == 0 {
                    below(256).to_le_bytes()[0]
                } else {
                    whole[below(whole.len())]
                };
            }
            if let Ok(value) = decode(&bytes) {
                let written = encoded(&value);
                assert_eq!(
                    encoded(&decode(&written).expect("what was written can be read")),
                    written
                );
                read += 1;
            }
        }
        assert!((100..19_000).contains(&read), "{read}");
        assert!(decode(b"[\xff\xff\xff\x7f").is_err());
        assert!(decode(&b"[\x01\0\0\0".repeat(1_000_000)).is_err());
    }

    #[test]
    fn declared_types_decide_what_lua_leaves_open() {
        let results = |values: &[Data], declared| {
            let mut encoder = Encoder::default();
            encoder.results(values, declared);
            encoder.into_bytes()
        };
        let empty = [Data::Array(Vec::new())];
        assert_eq!(results(&empty, Declared::default()), b"[\x01\0\0\0{0");
        assert_eq!(
            results(
                &empty,
                Declared {
                    results: true,
                    first: ""
                }
            ),
            b"[\x01\0\0\0[\0\0\0\0"
        );
        let text = [Data::text("\0")];
        assert_eq!(
            results(
                &text,
                Declared {
                    results: true,
                    first: "string"
                }
            ),
            b"[\x01\0\0\0u\x01\0\0\0\0"
        );
        assert_eq!(
            results(&text, Declared::default()),
            b"[\x01\0\0\0s\x01\0\0\0\0"
        );
        assert_eq!(
            results(
                &[Data::text("a")],
                Declared {
                    results: true,
                    first: "buffer"
                }
            ),
            b"[\x01\0\0\0s\x01\0\0\0a"
        );
    }

    #[test]
    fn what_is_no_value_is_refused() {
        let nested = b"[\x01\0\0\0".repeat(200);
        for (bytes, error) in [
            (&b""[..], MarshalError::Truncated),
            (b"NN", MarshalError::Trailing),
            (b"\xe9", MarshalError::UnknownType(0xe9)),
            (b"[\xff\xff\xff\xff", MarshalError::NegativeLength),
            (b"u\xff\xff\xff\x7fab", MarshalError::Truncated),
            (b"[\xff\xff\xff\x7fN", MarshalError::Truncated),
            (b"l\x01\0\0\0\xff\xff", MarshalError::Digit),
            (b"{NN0", MarshalError::Key),
            (b"{iN", MarshalError::Truncated),
            (&nested, MarshalError::TooNested),
        ] {
            assert_eq!(decode(bytes), Err(error), "{bytes:?}");
        }
    }
}
