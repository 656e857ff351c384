//! Reading and writing of numbers in bytes, in either order. Reading beyond the end is `None`.

/// Larger sequence numbers are damage: so what is computed of them, such as the next one, fits into 64 bits.
const LAST_SEQUENCE: i64 = i64::MAX / 2;

/// Bytes that are read from the front.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Input<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) little: bool,
}

impl<'a> Input<'a> {
    pub(crate) fn new(bytes: &'a [u8], little: bool) -> Self {
        Self { bytes, little }
    }

    pub(crate) fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (head, tail) = self.bytes.split_at_checked(count)?;
        self.bytes = tail;
        Some(head)
    }

    pub(crate) fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    pub(crate) fn u16(&mut self) -> Option<u16> {
        let bytes = self.array()?;
        Some(if self.little {
            u16::from_le_bytes(bytes)
        } else {
            u16::from_be_bytes(bytes)
        })
    }

    pub(crate) fn u32(&mut self) -> Option<u32> {
        let bytes = self.array()?;
        Some(if self.little {
            u32::from_le_bytes(bytes)
        } else {
            u32::from_be_bytes(bytes)
        })
    }

    pub(crate) fn i32(&mut self) -> Option<i32> {
        self.u32().map(u32::cast_signed)
    }

    /// A sequence number: its high half first, whatever the order of bytes. `None` for one that no writer reaches.
    pub(crate) fn sequence(&mut self) -> Option<i64> {
        let (high, low) = (self.i32()?, self.u32()?);
        Some(i64::from(high) << 32 | i64::from(low)).filter(|sequence| *sequence <= LAST_SEQUENCE)
    }
}

/// Appends a sequence number in little-endian order.
pub(crate) fn push_sequence(out: &mut Vec<u8>, sequence: i64) {
    out.extend_from_slice(&((sequence >> 32) as i32).to_le_bytes());
    out.extend_from_slice(&(sequence as u32).to_le_bytes());
}

/// Appends zeros until the length is a multiple of four.
pub(crate) fn pad4(out: &mut Vec<u8>) {
    out.resize(out.len().next_multiple_of(4), 0);
}
