//! The body of a file under construction.

use super::read::Tag;

/// Bytes with chunks around them.
#[derive(Default)]
pub struct Writer {
    pub bytes: Vec<u8>,
}

impl Writer {
    /// A chunk around what `payload` writes.
    pub fn chunk(&mut self, tag: Tag, payload: impl FnOnce(&mut Self)) {
        self.bytes.extend(tag);
        let start = self.bytes.len();
        self.int(0);
        payload(self);
        let size = numbers::count_i32(self.bytes.len() - start - 4);
        self.bytes[start..start + 4].copy_from_slice(&size.to_le_bytes());
    }

    /// The tag that ends a stream; it has no size.
    pub fn end(&mut self, tag: Tag) {
        self.bytes.extend(tag);
    }

    pub fn int(&mut self, value: i32) {
        self.bytes.extend(value.to_le_bytes());
    }
}
