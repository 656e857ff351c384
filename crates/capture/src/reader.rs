//! Reading a capture, frame by frame.

use std::fs::File;
use std::io::{self, BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::Arc;

use crate::frame::{FRAME_HEAD, FrameHead, HEAD, MAGIC, VERSION, unpack};
use crate::record::{Header, Record};
use crate::value::{Input, Recorded};

/// Why a file cannot be read as a capture.
#[derive(Debug, thiserror::Error)]
pub enum CaptureError {
    /// The system refuses to read or write it.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// It is another file.
    #[error("it is no capture")]
    NoCapture,
    /// Another version of Swanilda wrote it, in another format.
    #[error(
        "it has version {0} of the format of captures, and this program reads version {VERSION}"
    )]
    Version(u32),
    /// Bytes of it were changed.
    #[error("it is damaged {0} bytes from its start")]
    Damaged(u64),
}

/// A capture that is being read.
pub struct Reader<R = BufReader<File>> {
    file: R,
    header: Header,
    /// Bytes of the file that were read.
    place: u64,
    /// Records of the present frame, and how many of their bytes were read.
    frame: Arc<Vec<u8>>,
    read: usize,
}

/// A place between two records of a capture.
#[derive(Debug, Clone)]
pub(crate) struct Bookmark {
    place: u64,
    frame: Arc<Vec<u8>>,
    read: usize,
}

impl Reader {
    /// Opens a file.
    ///
    /// # Errors
    /// When it cannot be read, or is no capture.
    pub fn open(path: &Path) -> Result<Self, CaptureError> {
        Self::new(BufReader::new(File::open(path)?))
    }
}

impl<R: Read> Reader<R> {
    /// A capture in a stream of bytes.
    ///
    /// # Errors
    /// When it cannot be read, or is no capture.
    pub fn new(mut file: R) -> Result<Self, CaptureError> {
        let mut head = [0; HEAD];
        if fill(&mut file, &mut head)? < HEAD || head[..8] != MAGIC {
            return Err(CaptureError::NoCapture);
        }
        let version = u32::from_le_bytes([head[8], head[9], head[10], head[11]]);
        if version != VERSION {
            return Err(CaptureError::Version(version));
        }
        let mut reader = Self {
            file,
            header: Header::default(),
            place: HEAD as u64,
            frame: Arc::default(),
            read: 0,
        };
        match reader.next_record()? {
            Some(Record::Header(header)) => reader.header = header,
            _ => return Err(CaptureError::NoCapture),
        }
        Ok(reader)
    }

    /// How the run was started.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The next record; None where the file ends, which may be before the end of the run.
    ///
    /// # Errors
    /// When the file cannot be read, or is damaged before its last frame.
    pub fn next_record(&mut self) -> Result<Option<Record>, CaptureError> {
        while self.read == self.frame.len() {
            if !self.next_frame()? {
                return Ok(None);
            }
        }
        let mut input = Input::new(&self.frame[self.read..]);
        let damaged = CaptureError::Damaged(self.place);
        let record = Record::read(&mut input).ok_or(damaged)?;
        self.read = self.frame.len() - input.left();
        Ok(Some(record))
    }

    /// Reads a frame; false where there is no whole one any more.
    fn next_frame(&mut self) -> Result<bool, CaptureError> {
        let mut head = [0; FRAME_HEAD];
        if fill(&mut self.file, &mut head)? < FRAME_HEAD {
            return Ok(false);
        }
        let head = FrameHead::from_bytes(head);
        if !head.is_possible() {
            return Err(CaptureError::Damaged(self.place));
        }
        let mut packed = Vec::new();
        let mut limited = (&mut self.file).take(head.packed as u64);
        limited.read_to_end(&mut packed)?;
        if packed.len() < head.packed {
            return Ok(false);
        }
        let is_right = crc32fast::hash(&packed) == head.sum;
        match unpack(&packed, head.plain).filter(|_| is_right) {
            Some(records) => (self.frame, self.read) = (Arc::new(records), 0),
            // The last one may have been on its way to the disk.
            None if fill(&mut self.file, &mut [0])? == 0 => return Ok(false),
            None => return Err(CaptureError::Damaged(self.place)),
        }
        self.place += (FRAME_HEAD + head.packed) as u64;
        Ok(true)
    }
}

impl<R: Read + Seek> Reader<R> {
    /// The place of the next record.
    pub(crate) fn bookmark(&self) -> Bookmark {
        Bookmark {
            place: self.place,
            frame: Arc::clone(&self.frame),
            read: self.read,
        }
    }

    /// Goes on with the record that was the next one there.
    ///
    /// # Errors
    /// When the system refuses it.
    pub(crate) fn go_to(&mut self, bookmark: &Bookmark) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(bookmark.place))?;
        self.place = bookmark.place;
        self.frame = Arc::clone(&bookmark.frame);
        self.read = bookmark.read;
        Ok(())
    }
}

/// Reads until the buffer is full or the file ends; how many bytes there were.
fn fill(file: &mut impl Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut filled = 0;
    while filled < buffer.len() {
        match file.read(&mut buffer[filled..]) {
            Ok(0) => break,
            Ok(count) => filled += count,
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(filled)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{frame, head};

    fn file(frames: &[&[Record]]) -> Vec<u8> {
        let mut file = head().to_vec();
        for records in frames {
            let mut bytes = Vec::new();
            records.iter().for_each(|record| record.write(&mut bytes));
            file.extend(frame(&bytes).unwrap());
        }
        file
    }

    fn records(bytes: &[u8]) -> Result<Vec<Record>, CaptureError> {
        let mut reader = Reader::new(bytes)?;
        let mut records = Vec::new();
        while let Some(record) = reader.next_record()? {
            records.push(record);
        }
        Ok(records)
    }

    fn step(step: u64) -> Record {
        Record::Step { step, hash: step }
    }

    fn header() -> Record {
        Record::Header(Header::default())
    }

    #[test]
    fn a_file_that_was_cut_ends_before_the_cut() {
        let whole = file(&[&[header(), step(1)], &[step(2)], &[step(3), Record::End]]);
        assert_eq!(
            records(&whole).unwrap(),
            [step(1), step(2), step(3), Record::End]
        );
        let mut most = 0;
        for length in 0..whole.len() {
            match records(&whole[..length]) {
                Ok(found) => {
                    assert!(found.len() >= most && found.len() < 4);
                    most = found.len();
                }
                Err(error) => assert!(matches!(error, CaptureError::NoCapture), "{error}"),
            }
        }
        assert_eq!(most, 2);
    }

    #[test]
    fn damage_is_found() {
        let whole = file(&[&[header(), step(1)], &[step(2)], &[Record::End]]);
        let last = whole.len() - file(&[&[Record::End]]).len() + HEAD;
        for at in 0..last {
            let mut changed = whole.clone();
            changed[at] ^= 0x55;
            if let Ok(found) = records(&changed) {
                // A length that was changed may lead beyond the end of the file.
                assert!(found.len() < 3, "byte {at}");
            }
        }
        let mut changed = whole.clone();
        changed[last - 1] ^= 1;
        assert!(matches!(records(&changed), Err(CaptureError::Damaged(_))));
        let mut later = whole;
        later[8] = 9;
        assert!(matches!(records(&later), Err(CaptureError::Version(9))));
        assert!(matches!(
            records(b"#!/bin/sh\necho"),
            Err(CaptureError::NoCapture)
        ));
    }

    #[test]
    fn lengths_that_lie_cost_no_memory() {
        let mut bytes = file(&[&[header()]]);
        bytes.extend([0xff; FRAME_HEAD]);
        assert!(matches!(records(&bytes), Err(CaptureError::Damaged(_))));
        let mut bytes = file(&[&[header()]]);
        bytes.extend((1_u32 << 29).to_le_bytes());
        bytes.extend([0; 20]);
        assert_eq!(records(&bytes).unwrap(), []);
    }
}
