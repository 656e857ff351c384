//! Numbers and texts in the byte order of a client.

use super::Violation;

/// The byte order of a client.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ByteOrder {
    /// Least significant byte first.
    #[default]
    Little,
    /// Most significant byte first.
    Big,
}

/// Reads fields one after the other.
pub struct FieldReader<'a> {
    bytes: &'a [u8],
    order: ByteOrder,
}

impl<'a> FieldReader<'a> {
    /// Reads `bytes`, whose numbers are in that order.
    pub fn new(bytes: &'a [u8], order: ByteOrder) -> Self {
        Self { bytes, order }
    }

    /// The next `count` bytes.
    ///
    /// # Errors
    /// When there are fewer.
    pub fn take(&mut self, count: usize) -> Result<&'a [u8], Violation> {
        let (taken, rest) = self
            .bytes
            .split_at_checked(count)
            .ok_or(Violation::Malformed)?;
        self.bytes = rest;
        Ok(taken)
    }

    /// All bytes that are left.
    pub fn rest(&mut self) -> &'a [u8] {
        std::mem::take(&mut self.bytes)
    }

    /// Whether nothing is left to read.
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Violation> {
        let mut array: [u8; N] = self.take(N)?.try_into().map_err(|_| Violation::Malformed)?;
        if self.order == ByteOrder::Big {
            array.reverse();
        }
        Ok(array)
    }

    /// The next byte.
    ///
    /// # Errors
    /// When there are not enough bytes.
    pub fn byte(&mut self) -> Result<u8, Violation> {
        self.array().map(u8::from_le_bytes)
    }

    /// # Errors
    /// When there are not enough bytes.
    pub(crate) fn short(&mut self) -> Result<u16, Violation> {
        self.array().map(u16::from_le_bytes)
    }

    /// The next integer of 32 bits.
    ///
    /// # Errors
    /// When there are not enough bytes.
    pub fn int(&mut self) -> Result<i32, Violation> {
        self.array().map(i32::from_le_bytes)
    }

    /// The next size or count, an integer of 32 bits.
    ///
    /// # Errors
    /// When there are not enough bytes, or the number is negative.
    pub fn size(&mut self) -> Result<usize, Violation> {
        usize::try_from(self.int()?).map_err(|_| Violation::Malformed)
    }

    /// The next float of 32 bits.
    ///
    /// # Errors
    /// When there are not enough bytes.
    pub fn float(&mut self) -> Result<f32, Violation> {
        self.array().map(f32::from_le_bytes)
    }

    /// The bytes up to the next zero, which is skipped.
    ///
    /// # Errors
    /// When there is no zero.
    pub fn text(&mut self) -> Result<&'a [u8], Violation> {
        let end = self
            .bytes
            .iter()
            .position(|&byte| byte == 0)
            .ok_or(Violation::Malformed)?;
        let text = self.take(end)?;
        self.take(1)?;
        Ok(text)
    }
}

/// Writes fields one after the other.
#[derive(Default)]
pub struct FieldWriter {
    bytes: Vec<u8>,
    order: ByteOrder,
}

impl FieldWriter {
    /// An empty message, whose numbers are going to be in that order.
    pub fn new(order: ByteOrder) -> Self {
        Self {
            bytes: Vec::new(),
            order,
        }
    }

    /// What was written.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// Appends bytes as they are.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    fn array<const N: usize>(&mut self, mut array: [u8; N]) {
        if self.order == ByteOrder::Big {
            array.reverse();
        }
        self.bytes(&array);
    }

    /// Appends one byte.
    pub fn byte(&mut self, value: u8) {
        self.bytes.push(value);
    }

    pub(crate) fn short(&mut self, value: u16) {
        self.array(value.to_le_bytes());
    }

    /// Appends an integer of 32 bits.
    pub fn int(&mut self, value: i32) {
        self.array(value.to_le_bytes());
    }

    /// A size or a count. What is too large for the protocol becomes the largest number, which no client accepts.
    pub fn size(&mut self, value: usize) {
        self.int(i32::try_from(value).unwrap_or(i32::MAX));
    }

    /// Appends a float of 32 bits.
    pub fn float(&mut self, value: f32) {
        self.array(value.to_le_bytes());
    }

    /// A text up to its first zero, and a zero.
    pub fn text(&mut self, text: &[u8]) {
        self.bytes(text.split(|&byte| byte == 0).next().unwrap_or_default());
        self.byte(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_in_both_orders() {
        for order in [ByteOrder::Little, ByteOrder::Big] {
            let mut writer = FieldWriter::new(order);
            writer.byte(7);
            writer.short(0x1234);
            writer.int(-2);
            writer.float(0.5);
            writer.text(b"ab\0c");
            writer.bytes(b"rest");
            let bytes = writer.into_bytes();
            let mut reader = FieldReader::new(&bytes, order);
            assert_eq!(
                (reader.byte(), reader.short(), reader.int()),
                (Ok(7), Ok(0x1234), Ok(-2))
            );
            assert_eq!((reader.float(), reader.text()), (Ok(0.5), Ok(&b"ab"[..])));
            assert_eq!((reader.rest(), reader.is_empty()), (&b"rest"[..], true));
        }
    }

    #[test]
    fn the_order_is_that_of_the_bytes() {
        let mut writer = FieldWriter::new(ByteOrder::Big);
        writer.int(5);
        assert_eq!(writer.into_bytes(), [0, 0, 0, 5]);
    }

    #[test]
    fn what_is_not_there_is_an_error() {
        assert_eq!(
            FieldReader::new(&[1, 2, 3], ByteOrder::Little).int(),
            Err(Violation::Malformed)
        );
        assert_eq!(
            FieldReader::new(b"no end", ByteOrder::Little).text(),
            Err(Violation::Malformed)
        );
        assert_eq!(
            FieldReader::new(&[0xff; 4], ByteOrder::Little).size(),
            Err(Violation::Malformed)
        );
    }
}
