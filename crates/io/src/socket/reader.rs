//! The buffered reader of a stream: lines, counted bytes, everything.

use memchr::{memchr, memchr_iter};

use super::Failure;

/// Size of the blocks that are read from the system.
const BUFFER_SIZE: usize = 8192;
/// The most one call receives: what a Lua string may hold. LuaSocket's limit is the memory.
const MAX_TEXT: usize = 1 << 29;

/// The pattern of `receive`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pattern {
    /// Up to the next LF, which is dropped with every CR.
    Line,
    /// Until the other side closes.
    All,
    /// That many bytes.
    Count(usize),
}

/// Data that have arrived and were not read.
#[derive(Default)]
pub(super) struct Reader {
    buffer: Vec<u8>,
    start: usize,
    /// Bytes given out so far.
    pub(super) received: u64,
}

impl Reader {
    pub(super) fn is_empty(&self) -> bool {
        self.start == self.buffer.len()
    }

    /// Appends what `pattern` requests to `out`. `fill` reads at least one byte into its buffer, or fails; what came before a
    /// failure is in `out`.
    pub(super) fn read(
        &mut self,
        pattern: Pattern,
        out: &mut Vec<u8>,
        fill: impl FnMut(&mut [u8]) -> Result<usize, Failure>,
    ) -> Result<(), Failure> {
        match pattern {
            Pattern::Line => self.read_line(out, fill),
            Pattern::All => self.read_all(out, fill),
            Pattern::Count(count) => self.read_count(count.saturating_sub(out.len()), out, fill),
        }
    }

    fn read_line(
        &mut self,
        out: &mut Vec<u8>,
        mut fill: impl FnMut(&mut [u8]) -> Result<usize, Failure>,
    ) -> Result<(), Failure> {
        loop {
            self.ensure(&mut fill)?;
            let waiting = &self.buffer[self.start..];
            let end = memchr(b'\n', waiting);
            let taken = &waiting[..end.unwrap_or(waiting.len())];
            push_without_cr(taken, out);
            let count = taken.len() + usize::from(end.is_some());
            self.skip(count);
            if end.is_some() {
                return Ok(());
            }
            within_bounds(out)?;
        }
    }

    fn read_all(
        &mut self,
        out: &mut Vec<u8>,
        mut fill: impl FnMut(&mut [u8]) -> Result<usize, Failure>,
    ) -> Result<(), Failure> {
        let before = out.len();
        loop {
            match self.ensure(&mut fill) {
                Ok(()) => {}
                Err(Failure::Closed) if out.len() > before => return Ok(()),
                Err(failure) => return Err(failure),
            }
            self.take(usize::MAX, out);
            within_bounds(out)?;
        }
    }

    /// For no bytes, too, something must be there: it is how scripts ask whether the other side still is.
    fn read_count(
        &mut self,
        count: usize,
        out: &mut Vec<u8>,
        mut fill: impl FnMut(&mut [u8]) -> Result<usize, Failure>,
    ) -> Result<(), Failure> {
        let end = out.len().saturating_add(count);
        loop {
            self.ensure(&mut fill)?;
            self.take(end - out.len(), out);
            if out.len() == end {
                return Ok(());
            }
            within_bounds(out)?;
        }
    }

    /// Moves at most `count` waiting bytes.
    fn take(&mut self, count: usize, out: &mut Vec<u8>) {
        let waiting = &self.buffer[self.start..];
        let taken = &waiting[..count.min(waiting.len())];
        out.extend_from_slice(taken);
        let count = taken.len();
        self.skip(count);
    }

    fn skip(&mut self, count: usize) {
        self.start += count;
        self.received += count as u64;
    }

    /// Has something waiting.
    fn ensure(
        &mut self,
        fill: &mut impl FnMut(&mut [u8]) -> Result<usize, Failure>,
    ) -> Result<(), Failure> {
        if !self.is_empty() {
            return Ok(());
        }
        self.start = 0;
        self.buffer.resize(BUFFER_SIZE, 0);
        let filled = fill(&mut self.buffer);
        self.buffer
            .truncate(filled.as_ref().map_or(0, |&count| count));
        filled.map(drop)
    }
}

fn within_bounds(out: &[u8]) -> Result<(), Failure> {
    if out.len() > MAX_TEXT {
        Err(Failure::TooLong)
    } else {
        Ok(())
    }
}

fn push_without_cr(bytes: &[u8], out: &mut Vec<u8>) {
    let mut start = 0;
    for at in memchr_iter(b'\r', bytes) {
        out.extend_from_slice(&bytes[start..at]);
        start = at + 1;
    }
    out.extend_from_slice(&bytes[start..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads from a peer that sends `parts` and closes.
    fn read(
        reader: &mut Reader,
        parts: &mut Vec<&[u8]>,
        pattern: Pattern,
    ) -> (Vec<u8>, Result<(), Failure>) {
        let mut out = Vec::new();
        let result = reader.read(pattern, &mut out, |space| {
            if parts.is_empty() {
                return Err(Failure::Closed);
            }
            let part = parts.remove(0);
            space[..part.len()].copy_from_slice(part);
            Ok(part.len())
        });
        (out, result)
    }

    #[test]
    fn lines_lose_their_end_and_every_cr() {
        let (mut reader, mut parts) = (Reader::default(), vec![&b"ab\rc"[..], b"d\r", b"\n\nrest"]);
        assert_eq!(
            read(&mut reader, &mut parts, Pattern::Line),
            (b"abcd".to_vec(), Ok(()))
        );
        assert_eq!(
            read(&mut reader, &mut parts, Pattern::Line),
            (Vec::new(), Ok(()))
        );
        assert_eq!(
            read(&mut reader, &mut parts, Pattern::Line),
            (b"rest".to_vec(), Err(Failure::Closed))
        );
        assert_eq!(reader.received, 12);
    }

    #[test]
    fn counts_and_rests_end_where_they_should() {
        let (mut reader, mut parts) = (Reader::default(), vec![&b"abc"[..], b"def"]);
        assert_eq!(
            read(&mut reader, &mut parts, Pattern::Count(4)),
            (b"abcd".to_vec(), Ok(()))
        );
        assert_eq!(
            read(&mut reader, &mut parts, Pattern::Count(0)),
            (Vec::new(), Ok(()))
        );
        assert!(!reader.is_empty());
        assert_eq!(
            read(&mut reader, &mut parts, Pattern::All),
            (b"ef".to_vec(), Ok(()))
        );
        assert_eq!(
            read(&mut reader, &mut parts, Pattern::All),
            (Vec::new(), Err(Failure::Closed))
        );
        assert_eq!(
            read(&mut reader, &mut parts, Pattern::Count(usize::MAX)),
            (Vec::new(), Err(Failure::Closed))
        );
    }
}
