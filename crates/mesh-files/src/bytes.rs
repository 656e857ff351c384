//! Numbers of binary formats, with the bytes they are at.

use crate::error::{Location, ReadError, Result};

/// Reads from a slice that begins at `start` of its file. Little endian.
#[derive(Clone)]
pub(crate) struct Bytes<'a> {
    rest: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    pub(crate) fn new(bytes: &'a [u8], start: usize) -> Self {
        Self {
            rest: bytes,
            at: start,
        }
    }

    /// The next byte of the file.
    pub(crate) fn place(&self) -> Location {
        Location::Byte(self.at)
    }

    pub(crate) fn at(&self) -> usize {
        self.at
    }

    pub(crate) fn len(&self) -> usize {
        self.rest.len()
    }

    /// The next bytes.
    pub(crate) fn take(&mut self, count: usize, element: &str) -> Result<&'a [u8]> {
        let Some((bytes, rest)) = self.rest.split_at_checked(count) else {
            let problem = format!(
                "{count} bytes are needed, the file has {} more",
                self.rest.len()
            );
            return Err(ReadError::new(self.place(), element, problem));
        };
        self.rest = rest;
        self.at += count;
        Ok(bytes)
    }

    pub(crate) fn array<const N: usize>(&mut self, element: &str) -> Result<[u8; N]> {
        let bytes = self.take(N, element)?;
        Ok(bytes
            .try_into()
            .expect("take returns as many bytes as asked for"))
    }

    pub(crate) fn u16(&mut self, element: &str) -> Result<u16> {
        self.array(element).map(u16::from_le_bytes)
    }

    pub(crate) fn u32(&mut self, element: &str) -> Result<u32> {
        self.array(element).map(u32::from_le_bytes)
    }

    pub(crate) fn f32(&mut self, element: &str) -> Result<f32> {
        self.array(element).map(f32::from_le_bytes)
    }

    /// Three coordinates.
    pub(crate) fn vector(&mut self, element: &str) -> Result<[f64; 3]> {
        let place = self.place();
        let vector = [self.f32(element)?, self.f32(element)?, self.f32(element)?];
        if vector.iter().all(|x| x.is_finite()) {
            return Ok(vector.map(f64::from));
        }
        Err(ReadError::new(
            place,
            element,
            "a coordinate that is not finite",
        ))
    }

    /// A text that a zero byte ends.
    pub(crate) fn text(&mut self, element: &str) -> Result<String> {
        let Some(end) = self.rest.iter().position(|&byte| byte == 0) else {
            return Err(ReadError::new(
                self.place(),
                element,
                "a text without an end",
            ));
        };
        let bytes = self.take(end + 1, element)?;
        Ok(crate::text::name(&bytes[..end]))
    }

    /// `count` elements of `size` bytes must fit into what is left.
    pub(crate) fn check_room(&self, count: usize, size: usize, element: &str) -> Result<()> {
        match count.checked_mul(size) {
            Some(need) if need <= self.len() => Ok(()),
            _ => {
                let problem = format!(
                    "{count} of {size} bytes each are announced, the file has {} bytes more",
                    self.len()
                );
                Err(ReadError::new(self.place(), element, problem))
            }
        }
    }
}
