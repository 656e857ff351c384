//! The numbers after the header, in any of the three encodings.

use super::header::{Element, Encoding, Header, Kind, Scalar};
use crate::bytes::Bytes;
use crate::error::{Location, ReadError, Result};
use crate::text::{Words, no_number};

pub(super) enum Values<'a> {
    /// With the number of lines before, and how many bytes there were.
    Text(Words<'a>, usize, usize),
    Binary(Bytes<'a>, Encoding),
}

impl<'a> Values<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> Self {
        let body = &bytes[header.end..];
        match header.encoding {
            Encoding::Text => Self::Text(Words::new(body), header.lines, body.len()),
            binary => Self::Binary(Bytes::new(body, header.end), binary),
        }
    }

    pub(super) fn place(&self) -> Location {
        match self {
            Self::Text(words, lines, _) => match words.place() {
                Location::Line(line) => Location::Line(line + lines),
                other => other,
            },
            Self::Binary(bytes, _) => bytes.place(),
        }
    }

    /// The announced number of elements must fit into the file.
    pub(super) fn check_room(&self, element: &Element) -> Result<()> {
        match self {
            // Each number has a digit and a space after it.
            Self::Text(_, _, length) => {
                match element.count.checked_mul(2 * element.properties.len()) {
                    Some(least) if least <= length + 1 => Ok(()),
                    _ => Err(ReadError::new(
                        self.place(),
                        &element.name,
                        format!("{} are announced, the file is shorter", element.count),
                    )),
                }
            }
            Self::Binary(bytes, _) => {
                let size = element
                    .properties
                    .iter()
                    .map(|property| property.kind.least_bytes())
                    .sum();
                bytes.check_room(element.count, size, &element.name)
            }
        }
    }

    fn scalar(&mut self, scalar: Scalar, element: &str) -> Result<f64> {
        let (bytes, encoding) = match self {
            Self::Binary(bytes, encoding) => (bytes, *encoding),
            Self::Text(words, ..) => {
                let word = words.next();
                let value = word.and_then(|word| std::str::from_utf8(word).ok()?.parse().ok());
                return value.ok_or_else(|| ReadError::new(self.place(), element, no_number(word)));
            }
        };
        let mut array = [0; 8];
        let used = &mut array[..scalar.bytes()];
        used.copy_from_slice(bytes.take(scalar.bytes(), element)?);
        if encoding == Encoding::BigEndian {
            used.reverse();
        }
        Ok(decode(scalar, array))
    }

    /// A property that must be a single number.
    pub(super) fn scalar_of(&mut self, kind: &Kind, element: &str) -> Result<f64> {
        match kind {
            Kind::Scalar(scalar) => self.scalar(*scalar, element),
            Kind::List { .. } => {
                self.skip(kind, element)?;
                Ok(f64::NAN)
            }
        }
    }

    /// A property that must be a list.
    pub(super) fn list(&mut self, kind: &Kind, element: &str, list: &mut Vec<f64>) -> Result<()> {
        list.clear();
        let Kind::List { count, item } = kind else {
            return Err(ReadError::new(self.place(), element, "a list was expected"));
        };
        let length = self.scalar(*count, element)?;
        if !(length >= 0.0 && length.fract() == 0.0) {
            return Err(ReadError::new(
                self.place(),
                element,
                format!("a list of {length} items"),
            ));
        }
        if let Self::Binary(bytes, _) = self {
            bytes.check_room(numbers::index(length), item.bytes(), element)?;
        }
        for _ in 0..numbers::index(length) {
            list.push(self.scalar(*item, element)?);
        }
        Ok(())
    }

    pub(super) fn skip(&mut self, kind: &Kind, element: &str) -> Result<()> {
        match kind {
            Kind::Scalar(scalar) => self.scalar(*scalar, element).map(drop),
            Kind::List { .. } => self.list(kind, element, &mut Vec::new()),
        }
    }
}

/// The first bytes of the array, little endian.
fn decode(scalar: Scalar, [a, b, c, d, e, f, g, h]: [u8; 8]) -> f64 {
    match scalar {
        Scalar::I8 => f64::from(a.cast_signed()),
        Scalar::U8 => f64::from(a),
        Scalar::I16 => f64::from(i16::from_le_bytes([a, b])),
        Scalar::U16 => f64::from(u16::from_le_bytes([a, b])),
        Scalar::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
        Scalar::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
        Scalar::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
        Scalar::F64 => f64::from_le_bytes([a, b, c, d, e, f, g, h]),
    }
}
