//! The file around the records: a head, then frames with their lengths and a checksum.

use std::io::{self, Read, Write};

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;

/// The first bytes of a capture.
pub(crate) const MAGIC: [u8; 8] = *b"SWANCAPT";
/// The version of the format.
pub(crate) const VERSION: u32 = 1;
/// Bytes of the head: magic and version.
pub(crate) const HEAD: usize = 12;
/// Bytes in front of a frame: its length in the file, the length of its records, the checksum of what is in the file.
pub(crate) const FRAME_HEAD: usize = 12;
/// The longest frame, without compression: more than any record that is written, and no more than can be allocated at once.
pub(crate) const MAX_FRAME: usize = 1 << 30;

/// The head of a file.
pub(crate) fn head() -> [u8; HEAD] {
    let mut head = [0; HEAD];
    head[..8].copy_from_slice(&MAGIC);
    head[8..].copy_from_slice(&VERSION.to_le_bytes());
    head
}

/// The lengths and the checksum in front of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FrameHead {
    pub(crate) packed: usize,
    pub(crate) plain: usize,
    pub(crate) sum: u32,
}

impl FrameHead {
    pub(crate) fn from_bytes(bytes: [u8; FRAME_HEAD]) -> Self {
        let word = |at: usize| {
            let word = [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
            u32::from_le_bytes(word)
        };
        Self {
            packed: word(0) as usize,
            plain: word(4) as usize,
            sum: word(8),
        }
    }

    /// Whether lengths like these are written.
    pub(crate) fn is_possible(self) -> bool {
        self.plain <= MAX_FRAME && self.packed <= MAX_FRAME + MAX_FRAME / 16
    }
}

/// A frame with those records.
pub(crate) fn frame(records: &[u8]) -> io::Result<Vec<u8>> {
    let mut out = vec![0; FRAME_HEAD];
    let mut encoder = DeflateEncoder::new(&mut out, Compression::fast());
    encoder.write_all(records)?;
    encoder.finish()?;
    let packed = &out[FRAME_HEAD..];
    let words = [
        packed.len() as u32,
        records.len() as u32,
        crc32fast::hash(packed),
    ];
    for (place, word) in out[..FRAME_HEAD].chunks_exact_mut(4).zip(words) {
        place.copy_from_slice(&word.to_le_bytes());
    }
    Ok(out)
}

/// The records of a frame whose checksum is right; None when they are not as many bytes as it says.
pub(crate) fn unpack(packed: &[u8], plain: usize) -> Option<Vec<u8>> {
    let mut records = Vec::new();
    let mut decoder = DeflateDecoder::new(packed).take(plain as u64 + 1);
    decoder.read_to_end(&mut records).ok()?;
    (records.len() == plain).then_some(records)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_comes_back_and_lies_about_nothing() {
        let records = vec![7; 100_000];
        let written = frame(&records).unwrap();
        let head = FrameHead::from_bytes(written[..FRAME_HEAD].try_into().unwrap());
        let packed = &written[FRAME_HEAD..];
        assert!(packed.len() < 2000 && head.is_possible());
        assert_eq!((head.packed, head.plain), (packed.len(), records.len()));
        assert_eq!(unpack(packed, records.len()), Some(records));
        assert_eq!(unpack(packed, 99_999), None);
        assert_eq!(unpack(&packed[1..], 100_000), None);
    }
}
