//! A position in the body of a file: bounded reads, and errors with positions.

use std::cell::RefCell;

use super::error::{FileError, FileResult};

/// Three letters that name a chunk.
pub type Tag = [u8; 3];

/// Streams within streams: compound shapes are trees of any depth, a file that lies about it has its end here.
const MAX_DEPTH: usize = 100;

/// How wide the real numbers of a chunk are: files up to serialization 24 have chunks with single precision.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Real {
    Single,
    Double,
}

/// An unknown chunk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Skipped {
    /// Bytes from the beginning of the uncompressed body.
    pub offset: usize,
    /// The tags on the way to it, such as `SHP/Ge2/Gst`.
    pub path: String,
    /// Bytes of its payload.
    pub size: usize,
}

/// The tags that lead to a place, from the inside out.
#[derive(Clone, Copy)]
struct Trail<'a> {
    tag: Tag,
    depth: usize,
    outer: Option<&'a Trail<'a>>,
}

impl Trail<'_> {
    fn path(&self) -> String {
        let tag = String::from_utf8_lossy(&self.tag);
        self.outer.map_or_else(
            || tag.to_string(),
            |outer| format!("{}/{tag}", outer.path()),
        )
    }
}

/// The payload of one chunk, or the whole body, read from the front.
pub struct Reader<'a> {
    bytes: &'a [u8],
    offset: usize,
    trail: Trail<'a>,
    skipped: &'a RefCell<Vec<Skipped>>,
}

impl<'a> Reader<'a> {
    pub fn new(body: &'a [u8], skipped: &'a RefCell<Vec<Skipped>>) -> Self {
        Self {
            bytes: body,
            offset: 0,
            trail: Trail {
                tag: *b"TOP",
                depth: 0,
                outer: None,
            },
            skipped,
        }
    }

    /// The tag of the chunk this is the payload of.
    pub fn tag(&self) -> Tag {
        self.trail.tag
    }

    pub fn left(&self) -> usize {
        self.bytes.len()
    }

    pub fn error(&self, what: impl Into<String>) -> FileError {
        FileError::Chunk {
            offset: self.offset,
            path: self.trail.path(),
            what: what.into(),
        }
    }

    /// The next bytes.
    pub fn take(&mut self, count: usize) -> FileResult<&'a [u8]> {
        let (head, tail) = self.bytes.split_at_checked(count).ok_or_else(|| {
            self.error(format!(
                "{count} bytes are announced, {} are left",
                self.bytes.len()
            ))
        })?;
        self.bytes = tail;
        self.offset += count;
        Ok(head)
    }

    pub fn take_rest(&mut self) -> &'a [u8] {
        self.offset += self.bytes.len();
        std::mem::take(&mut self.bytes)
    }

    pub fn int(&mut self) -> FileResult<i32> {
        let bytes = self.take(4)?;
        Ok(i32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
    }

    /// A number of things of `size` bytes each, checked against what is left: safe to allocate.
    pub fn count(&mut self, size: usize) -> FileResult<usize> {
        let count = self.int()?;
        let fits = usize::try_from(count)
            .ok()
            .filter(|n| n.saturating_mul(size) <= self.bytes.len());
        fits.ok_or_else(|| {
            self.error(format!(
                "{count} items of at least {size} bytes do not fit into what is left"
            ))
        })
    }

    /// The next chunk: its payload, or nothing where the stream ends with `end`.
    pub fn chunk(&mut self, end: Tag) -> FileResult<Option<Reader<'_>>> {
        let offset = self.offset;
        let tag = self.take(3)?;
        let tag = [tag[0], tag[1], tag[2]];
        if tag == end {
            return Ok(None);
        }
        let depth = self.trail.depth + 1;
        if depth > MAX_DEPTH {
            return Err(self.error("chunks are nested too deeply"));
        }
        let size = self.count(1)?;
        let bytes = self.take(size)?;
        let trail = Trail {
            tag,
            depth,
            outer: Some(&self.trail),
        };
        Ok(Some(Reader {
            bytes,
            offset: offset + 7,
            trail,
            skipped: self.skipped,
        }))
    }

    /// True where the payload is a scene object, of a type known or not: it begins with a chunk `3do` of 57, 58, 59.
    pub fn is_object(&self) -> bool {
        self.bytes.starts_with(b"3do\x03\0\0\0\x39\x3a\x3b")
    }

    /// Records an unknown chunk.
    pub fn skip(&self) {
        let note = Skipped {
            offset: self.offset,
            path: self.trail.path(),
            size: self.bytes.len(),
        };
        self.skipped.borrow_mut().push(note);
    }

    /// Where the payload begins.
    pub fn offset(&self) -> usize {
        self.offset
    }

    /// An error if something is left.
    pub fn finish(&self) -> FileResult<()> {
        if self.bytes.is_empty() {
            Ok(())
        } else {
            Err(self.error(format!("{} bytes too many", self.bytes.len())))
        }
    }
}
