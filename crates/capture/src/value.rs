//! Values of inputs as bytes. Numbers have as many bytes as they need; floats keep all their bits.

use std::io::{self, ErrorKind};

/// A value that can be captured.
pub trait Recorded: Sized {
    /// Appends the bytes of the value.
    fn write(&self, out: &mut Vec<u8>);

    /// The value whose bytes come next; None when they are none of this type.
    fn read(input: &mut Input<'_>) -> Option<Self>;

    /// Appends the bytes of values, one after the other.
    fn write_all(list: &[Self], out: &mut Vec<u8>) {
        list.iter().for_each(|item| item.write(out));
    }

    /// The values whose bytes come next.
    fn read_all(count: usize, input: &mut Input<'_>) -> Option<Vec<Self>> {
        (0..count).map(|_| Self::read(input)).collect()
    }
}

/// The bytes of an input that were not read yet.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a>(&'a [u8]);

impl<'a> Input<'a> {
    /// All of `bytes`.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    /// How many bytes were not read yet.
    pub fn left(&self) -> usize {
        self.0.len()
    }

    /// Whether everything was read.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The next byte.
    pub fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    /// The next so many bytes.
    pub fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    /// A number in groups of seven bits, the lowest first.
    pub fn number(&mut self) -> Option<u64> {
        let mut number = 0_u64;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            let bits = u64::from(byte & 0x7f);
            if shift == 63 && bits > 1 {
                return None;
            }
            number |= bits << shift;
            if byte & 0x80 == 0 {
                return Some(number);
            }
        }
        None
    }

    /// Bytes with their number in front.
    pub fn bytes(&mut self) -> Option<&'a [u8]> {
        let length = self.number()?;
        self.take(usize::try_from(length).ok()?)
    }
}

/// Appends a number in groups of seven bits, the lowest first.
pub(crate) fn write_number(mut number: u64, out: &mut Vec<u8>) {
    while number > 0x7f {
        out.push(number as u8 | 0x80);
        number >>= 7;
    }
    out.push(number as u8);
}

/// Appends bytes with their number in front.
pub(crate) fn write_bytes(bytes: &[u8], out: &mut Vec<u8>) {
    write_number(bytes.len() as u64, out);
    out.extend_from_slice(bytes);
}

impl Recorded for () {
    fn write(&self, _: &mut Vec<u8>) {}

    fn read(_: &mut Input<'_>) -> Option<Self> {
        Some(())
    }
}

impl Recorded for bool {
    fn write(&self, out: &mut Vec<u8>) {
        out.push(u8::from(*self));
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        match input.byte()? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

impl Recorded for u64 {
    fn write(&self, out: &mut Vec<u8>) {
        write_number(*self, out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        input.number()
    }
}

macro_rules! smaller_numbers {
    ($($ty:ty),*) => { $(
        impl Recorded for $ty {
            fn write(&self, out: &mut Vec<u8>) {
                u64::from(*self).write(out);
            }

            fn read(input: &mut Input<'_>) -> Option<Self> {
                input.number()?.try_into().ok()
            }
        }
    )* };
}
smaller_numbers!(u16, u32);

/// One byte, so that lists of them are written as bytes.
impl Recorded for u8 {
    fn write(&self, out: &mut Vec<u8>) {
        out.push(*self);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        input.byte()
    }

    fn write_all(list: &[Self], out: &mut Vec<u8>) {
        out.extend_from_slice(list);
    }

    fn read_all(count: usize, input: &mut Input<'_>) -> Option<Vec<Self>> {
        Some(input.take(count)?.to_vec())
    }
}

impl Recorded for usize {
    fn write(&self, out: &mut Vec<u8>) {
        write_number(*self as u64, out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        input.number()?.try_into().ok()
    }
}

/// Small negative numbers are as short as positive ones.
impl Recorded for i64 {
    fn write(&self, out: &mut Vec<u8>) {
        write_number(((self << 1) ^ (self >> 63)).cast_unsigned(), out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        let number = input.number()?;
        Some((number >> 1).cast_signed() ^ -(number & 1).cast_signed())
    }
}

impl Recorded for i32 {
    fn write(&self, out: &mut Vec<u8>) {
        i64::from(*self).write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        i64::read(input)?.try_into().ok()
    }
}

impl Recorded for f64 {
    fn write(&self, out: &mut Vec<u8>) {
        out.extend_from_slice(&self.to_bits().to_le_bytes());
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        let bytes = input.take(8)?.try_into().ok()?;
        Some(Self::from_bits(u64::from_le_bytes(bytes)))
    }
}

impl Recorded for String {
    fn write(&self, out: &mut Vec<u8>) {
        write_bytes(self.as_bytes(), out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        Some(std::str::from_utf8(input.bytes()?).ok()?.to_owned())
    }
}

impl<T: Recorded> Recorded for Vec<T> {
    fn write(&self, out: &mut Vec<u8>) {
        write_number(self.len() as u64, out);
        T::write_all(self, out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        let count = usize::try_from(input.number()?).ok()?;
        // Items without bytes could be as many as a number says.
        if count > input.0.len() {
            return None;
        }
        T::read_all(count, input)
    }
}

impl<T: Recorded> Recorded for Option<T> {
    fn write(&self, out: &mut Vec<u8>) {
        self.is_some().write(out);
        if let Some(value) = self {
            value.write(out);
        }
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        if bool::read(input)? {
            T::read(input).map(Some)
        } else {
            Some(None)
        }
    }
}

impl<T: Recorded, E: Recorded> Recorded for Result<T, E> {
    fn write(&self, out: &mut Vec<u8>) {
        self.is_ok().write(out);
        match self {
            Ok(value) => value.write(out),
            Err(error) => error.write(out),
        }
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        if bool::read(input)? {
            T::read(input).map(Ok)
        } else {
            E::read(input).map(Err)
        }
    }
}

impl<A: Recorded, B: Recorded> Recorded for (A, B) {
    fn write(&self, out: &mut Vec<u8>) {
        self.0.write(out);
        self.1.write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        Some((A::read(input)?, B::read(input)?))
    }
}

impl<A: Recorded, B: Recorded, C: Recorded> Recorded for (A, B, C) {
    fn write(&self, out: &mut Vec<u8>) {
        self.0.write(out);
        self.1.write(out);
        self.2.write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        Some((A::read(input)?, B::read(input)?, C::read(input)?))
    }
}

/// The kinds of errors that callers distinguish; all others become `Other`.
const KINDS: &[ErrorKind] = &[
    ErrorKind::Other,
    ErrorKind::NotFound,
    ErrorKind::PermissionDenied,
    ErrorKind::AlreadyExists,
    ErrorKind::InvalidInput,
    ErrorKind::InvalidData,
    ErrorKind::TimedOut,
    ErrorKind::WouldBlock,
    ErrorKind::Interrupted,
    ErrorKind::UnexpectedEof,
    ErrorKind::Unsupported,
    ErrorKind::AddrInUse,
    ErrorKind::AddrNotAvailable,
    ErrorKind::ConnectionRefused,
    ErrorKind::IsADirectory,
    ErrorKind::NotADirectory,
];

/// The system's number, or kind and text.
impl Recorded for io::Error {
    fn write(&self, out: &mut Vec<u8>) {
        let kind = KINDS.iter().position(|&kind| kind == self.kind());
        self.raw_os_error().write(out);
        kind.unwrap_or_default().write(out);
        self.to_string().write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        let number = Option::<i32>::read(input)?;
        let kind = *KINDS.get(usize::read(input)?)?;
        let text = String::read(input)?;
        Some(number.map_or_else(|| Self::new(kind, text), Self::from_raw_os_error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round<T: Recorded>(value: &T) -> T {
        let mut bytes = Vec::new();
        value.write(&mut bytes);
        let mut input = Input::new(&bytes);
        let read = T::read(&mut input).expect("what is written can be read");
        assert!(input.is_empty());
        for length in 0..bytes.len() {
            assert!(
                T::read(&mut Input::new(&bytes[..length])).is_none(),
                "a part of a value is none"
            );
        }
        read
    }

    #[test]
    fn values_come_back() {
        for number in [0, 1, 127, 128, 1 << 35, u64::MAX] {
            assert_eq!(round(&number), number);
        }
        for number in [0, -1, 1, i64::MIN, i64::MAX] {
            assert_eq!(round(&number), number);
        }
        assert_eq!(
            round(&f64::from_bits(0x7ff8_dead_beef_0001)).to_bits(),
            0x7ff8_dead_beef_0001
        );
        assert_eq!(
            round(&Some((1_u8, "a".to_owned(), true))),
            Some((1, "a".into(), true))
        );
        assert_eq!(round(&vec![None, Some(3_i64)]), vec![None, Some(3)]);
        assert_eq!(round(&b"a\xff".to_vec()), b"a\xff");
        let failed = round(&Err::<(), _>(io::Error::from_raw_os_error(2)));
        assert_eq!(failed.unwrap_err().kind(), ErrorKind::NotFound);
        let failed = round(&Err::<(), _>(io::Error::new(ErrorKind::TimedOut, "late")));
        assert_eq!(failed.unwrap_err().to_string(), "late");
    }

    #[test]
    fn lengths_are_checked_before_anything_is_allocated() {
        let claims_all = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1];
        assert!(Vec::<u8>::read(&mut Input::new(&claims_all)).is_none());
        assert!(Vec::<()>::read(&mut Input::new(&claims_all)).is_none());
        assert!(String::read(&mut Input::new(&claims_all)).is_none());
        assert!(u64::read(&mut Input::new(&[0xff; 10])).is_none());
        assert!(u16::read(&mut Input::new(&[0x80, 0x80, 0x04])).is_none());
    }
}
