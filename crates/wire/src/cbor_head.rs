//! The heads of CBOR items (RFC 8949 section 3): what kind of item follows, with which number. Nothing of their contents.

use ciborium_ll::{Encoder, Header};

/// Major types, as the first byte of an item has them.
pub mod major {
    /// An integer from 0 up.
    pub const UNSIGNED: u8 = 0x00;
    /// A negative integer: -1 minus the argument.
    pub const NEGATIVE: u8 = 0x20;
    /// A string of bytes.
    pub const BYTES: u8 = 0x40;
    /// A string of UTF-8 text.
    pub const TEXT: u8 = 0x60;
    /// A list; the argument counts its items.
    pub const ARRAY: u8 = 0x80;
    /// Pairs of key and value; the argument counts the pairs.
    pub const MAP: u8 = 0xa0;
    /// A number that says what the item after it means.
    pub const TAG: u8 = 0xc0;
    /// Floats, booleans, null, and the break.
    pub const SIMPLE: u8 = 0xe0;
}

/// `info` of an item without a length, and of the break that ends it.
pub const INDEFINITE: u8 = 31;

/// Items of one byte.
pub const FALSE: u8 = major::SIMPLE | 20;
/// The item `true`.
pub const TRUE: u8 = major::SIMPLE | 21;
/// The item `null`.
pub const NULL: u8 = major::SIMPLE | 22;
/// Byte that ends an item without a length.
pub const BREAK: u8 = major::SIMPLE | INDEFINITE;

/// The beginning of an item.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Head {
    /// One of [`major`].
    pub major: u8,
    /// The lower five bits of the first byte.
    pub info: u8,
    /// The number that follows, or `info` itself where it says the number; 0 for [`INDEFINITE`].
    pub argument: u64,
}

/// Why there is no head.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum HeadError {
    /// The bytes end before the head does.
    #[error("no more input")]
    NoMoreInput,
    /// The byte is reserved by RFC 8949, or has no meaning.
    #[error("invalid data: byte {0:#04x}")]
    Reserved(u8),
}

impl Head {
    /// The head at `at`, and where it ends.
    ///
    /// # Errors
    /// When the bytes end before the head does, or when it is none.
    pub fn read(bytes: &[u8], at: usize) -> Result<(Self, usize), HeadError> {
        let first = *bytes.get(at).ok_or(HeadError::NoMoreInput)?;
        let (major, info) = (first & 0xe0, first & 0x1f);
        let next = at + 1;
        let (argument, end) = match info {
            0..24 => (u64::from(info), next),
            24 => (
                u64::from(*bytes.get(next).ok_or(HeadError::NoMoreInput)?),
                next + 1,
            ),
            25 => (u64::from(u16::from_be_bytes(fixed(bytes, next)?)), next + 2),
            26 => (u64::from(u32::from_be_bytes(fixed(bytes, next)?)), next + 4),
            27 => (u64::from_be_bytes(fixed(bytes, next)?), next + 8),
            INDEFINITE if !matches!(major, major::UNSIGNED | major::NEGATIVE | major::TAG) => {
                (0, next)
            }
            _ => return Err(HeadError::Reserved(first)),
        };
        Ok((
            Self {
                major,
                info,
                argument,
            },
            end,
        ))
    }

    /// Whether this is the break that ends an item of indefinite length.
    pub fn is_break(self) -> bool {
        self.major == major::SIMPLE && self.info == INDEFINITE
    }

    /// The number, of a head that is a float.
    pub fn float(self) -> Option<f64> {
        if self.major != major::SIMPLE {
            return None;
        }
        match self.info {
            25 => u16::try_from(self.argument).ok().map(half),
            26 => {
                let bits = u32::try_from(self.argument).ok()?;
                Some(f64::from(f32::from_bits(bits)))
            }
            27 => Some(f64::from_bits(self.argument)),
            _ => None,
        }
    }
}

fn fixed<const N: usize>(bytes: &[u8], at: usize) -> Result<[u8; N], HeadError> {
    bytes
        .get(at..)
        .and_then(|rest| rest.first_chunk())
        .copied()
        .ok_or(HeadError::NoMoreInput)
}

/// A half-precision number (IEEE 754 binary16).
fn half(bits: u16) -> f64 {
    let fraction = f64::from(bits & 0x3ff);
    let magnitude = match (bits >> 10) & 0x1f {
        0 => fraction * 2f64.powi(-24),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        exponent => (1024.0 + fraction) * 2f64.powi(i32::from(exponent) - 25),
    };
    if bits & 0x8000 == 0 {
        magnitude
    } else {
        -magnitude
    }
}

/// Appends a head in as few bytes as hold `argument`.
pub fn push_head(out: &mut Vec<u8>, major: u8, argument: u64) {
    let bytes = argument.to_be_bytes();
    match argument {
        0..24 => out.push(major | bytes[7]),
        24..=0xff => out.extend([major | 24, bytes[7]]),
        0x100..=0xffff => extend(out, major | 25, &bytes[6..]),
        0x1_0000..=0xffff_ffff => extend(out, major | 26, &bytes[4..]),
        _ => extend(out, major | 27, &bytes),
    }
}

fn extend(out: &mut Vec<u8>, first: u8, rest: &[u8]) {
    out.push(first);
    out.extend_from_slice(rest);
}

/// Appends an integer.
pub fn push_int(out: &mut Vec<u8>, value: i64) {
    if value < 0 {
        push_head(out, major::NEGATIVE, (!value).cast_unsigned());
    } else {
        push_head(out, major::UNSIGNED, value.cast_unsigned());
    }
}

/// Appends a float in the shortest of the three precisions that keeps its value.
pub fn push_float(out: &mut Vec<u8>, value: f64) {
    Encoder::from(out)
        .push(Header::Float(value))
        .expect("writing to memory cannot fail");
}

/// Whether CoppeliaSim's library writes these bytes as text: UTF-8 without most control characters. Others become a byte string.
/// The library does not know the last plane of Unicode, U+100000 and up.
pub fn is_text(bytes: &[u8]) -> bool {
    let is_character = |c: char| matches!(c, '\x07'..='\r' | ' '..='~' | '\u{80}'..'\u{100000}');
    std::str::from_utf8(bytes).is_ok_and(|text| text.chars().all(is_character))
}

#[cfg(test)]
mod tests {
    use super::{Head, HeadError, is_text, major, push_float, push_head, push_int};

    #[test]
    fn heads_come_back() {
        for argument in [
            0,
            23,
            24,
            255,
            256,
            65535,
            65536,
            u64::from(u32::MAX),
            1 << 32,
            u64::MAX,
        ] {
            let mut bytes = Vec::new();
            push_head(&mut bytes, major::ARRAY, argument);
            let (head, end) = Head::read(&bytes, 0).expect("just written");
            assert_eq!(
                (head.major, head.argument, end),
                (major::ARRAY, argument, bytes.len())
            );
        }
    }

    #[test]
    fn what_is_no_head_is_refused() {
        for bytes in [
            &b""[..],
            b"\x18",
            b"\x19\x01",
            b"\x1b\x01\x02\x03\x04\x05\x06\x07",
        ] {
            assert_eq!(Head::read(bytes, 0), Err(HeadError::NoMoreInput));
        }
        for first in [0x1c, 0x1f, 0x3f, 0x5e, 0xdf, 0xfd] {
            assert_eq!(Head::read(&[first], 0), Err(HeadError::Reserved(first)));
        }
    }

    #[test]
    fn floats_take_the_shortest_exact_form() {
        let written = |value| {
            let mut bytes = Vec::new();
            push_float(&mut bytes, value);
            bytes
        };
        assert_eq!(written(-0.0), [0xf9, 0x80, 0]);
        assert_eq!(written(65505.0), [0xfa, 0x47, 0x7f, 0xe1, 0]);
        assert_eq!(written(0.1).len(), 9);
        for value in [
            0.0,
            1.5,
            -65504.0,
            2f64.powi(-24),
            1e300,
            f64::INFINITY,
            f64::NEG_INFINITY,
        ] {
            let (head, _) = Head::read(&written(value), 0).expect("just written");
            assert_eq!(head.float(), Some(value));
        }
        let (nan, _) = Head::read(&[0xf9, 0x7e, 0], 0).expect("three bytes");
        assert!(nan.float().expect("a float").is_nan());
    }

    #[test]
    fn integers_are_exact() {
        for (value, expected) in [
            (i64::MAX, b"\x1b\x7f\xff\xff\xff\xff\xff\xff\xff"),
            (i64::MIN, b"\x3b\x7f\xff\xff\xff\xff\xff\xff\xff"),
        ] {
            let mut bytes = Vec::new();
            push_int(&mut bytes, value);
            assert_eq!(bytes, expected);
        }
    }

    #[test]
    fn texts_are_printable() {
        for text in ["", "a\tb\n", "é", "\u{1f600}", "\u{7ff}\u{ffff}"] {
            assert!(is_text(text.as_bytes()), "{text:?}");
        }
        for bytes in [
            &b"a\0b"[..],
            b"\x1b[0m",
            b"\x7f",
            b"\xff",
            b"\xf4\x8f\xbf\xbf",
            b"\x06",
            b"\x0e",
        ] {
            assert!(!is_text(bytes), "{bytes:?}");
        }
    }
}
