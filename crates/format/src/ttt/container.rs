//! The header of a file and its body, uncompressed.

use super::error::{FileError, FileResult};
use super::huffman;

const MAGIC: [u8; 4] = *b"VREP";

/// The oldest files whose shapes can be read.
const OLDEST: i32 = 16;

/// The serialization this program writes, and the newest it knows.
pub const CURRENT: i32 = 25;

/// Since this serialization the header is of full length.
const LONG_HEADER_SINCE: i32 = 13;
const SHORT_HEADER: usize = 17;
const HEADER: usize = 1021;

/// The release whose files this program writes: 4.10.0.
const PROGRAM_VERSION: u16 = 41_000;

/// Content of a file according to its header. Old programs wrote nothing there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    Scene = 1,
    Model = 2,
}

/// Header of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Header {
    /// The number of the format, 16 to 25.
    pub serialization: i32,
    /// The program that wrote it: 40100 is 4.1.0, 30303 is 3.3.3. Zero where the header does not tell.
    pub version: u16,
    /// Revision of the program that wrote it.
    pub revision: i8,
    /// The file type as stored; not reliable in files up to 3.x.
    pub kind: u8,
}

impl Header {
    /// Of a file this program writes.
    pub fn current(kind: FileKind) -> Self {
        Self {
            serialization: CURRENT,
            version: PROGRAM_VERSION,
            revision: 0,
            kind: kind as u8,
        }
    }

    /// The version as people write it, such as 4.1.0.
    pub fn version_text(&self) -> String {
        format!(
            "{}.{}.{}",
            self.version / 10000,
            self.version / 100 % 100,
            self.version % 100
        )
    }
}

/// True where the bytes begin as scenes and models do.
pub fn is_binary(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

/// Header and uncompressed body of a file.
pub fn unpack(file: &[u8]) -> FileResult<(Header, Vec<u8>)> {
    if !is_binary(file) {
        return Err(FileError::NotAScene);
    }
    let serialization = int(file, 4)?;
    let oldest_reader = int(file, 8)?;
    let long = serialization >= LONG_HEADER_SINCE;
    let body = file
        .get(if long { HEADER } else { SHORT_HEADER }..)
        .ok_or(FileError::ShortHeader)?;
    if serialization < OLDEST {
        return Err(FileError::TooOld(serialization));
    }
    if oldest_reader > CURRENT {
        return Err(FileError::TooNew(oldest_reader));
    }
    let size = usize::try_from(int(file, 13)?)
        .map_err(|_| FileError::Inflate("their size is negative"))?;
    let header = Header {
        serialization,
        version: u16::from_le_bytes([file[21], file[22]]),
        revision: file[27].cast_signed(),
        kind: file[28],
    };
    let body = match file[12] {
        0 => body.to_vec(),
        1 => huffman::inflate(body, size)?,
        other => return Err(FileError::Compression(other)),
    };
    Ok((header, body))
}

/// A file out of its body.
pub fn pack(header: &Header, body: &[u8]) -> Vec<u8> {
    let mut file = vec![0; HEADER];
    file[..4].copy_from_slice(&MAGIC);
    file[4..8].copy_from_slice(&header.serialization.to_le_bytes());
    file[8..12].copy_from_slice(&(CURRENT - 1).to_le_bytes());
    file[12] = 1;
    file[13..17].copy_from_slice(&numbers::count_i32(body.len()).to_le_bytes());
    file[21..23].copy_from_slice(&header.version.to_le_bytes());
    file[27] = header.revision.cast_unsigned();
    file[28] = header.kind;
    file.extend(huffman::deflate(body));
    file
}

fn int(file: &[u8], at: usize) -> FileResult<i32> {
    let bytes = file.get(at..at + 4).ok_or(FileError::ShortHeader)?;
    Ok(i32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_comes_back() {
        let header = Header::current(FileKind::Model);
        let file = pack(&header, b"body of a file");
        assert_eq!(unpack(&file).unwrap(), (header, b"body of a file".to_vec()));
    }

    #[test]
    fn every_shortened_file_is_an_error() {
        let file = pack(&Header::current(FileKind::Scene), b"body of a file");
        for end in 0..file.len() {
            assert!(unpack(&file[..end]).is_err(), "{end}");
        }
    }

    #[test]
    fn what_is_not_a_scene_is_said() {
        assert_eq!(
            unpack(b"sim = require 'sim'").unwrap_err(),
            FileError::NotAScene
        );
        let mut file = pack(&Header::current(FileKind::Scene), b"body");
        file[4] = 15;
        assert_eq!(unpack(&file).unwrap_err(), FileError::TooOld(15));
        (file[4], file[8]) = (30, 26);
        assert_eq!(unpack(&file).unwrap_err(), FileError::TooNew(26));
        (file[8], file[12]) = (24, 7);
        assert_eq!(unpack(&file).unwrap_err(), FileError::Compression(7));
    }
}
