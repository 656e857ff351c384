//! Any bytes as a recording: it is opened or refused, and every chunk and blob of what is opened is read or refused.
//!
//! The last byte says what the others are. Bit 0: the file itself, or parts of one with its sums, separated by `|SWR|`, which other bytes would
//! hardly guess. Bit 1: whether the last part is the index.
//!
//! `cargo fuzz run recording`
#![no_main]
// The reader is private to the viewer; what it needs is at the same places here.
#![allow(dead_code)]

use std::io::Cursor;

use libfuzzer_sys::fuzz_target;

#[path = "../../crates/view/src/recording/chunk.rs"]
mod chunk;
#[path = "../../crates/view/src/recording/format.rs"]
mod format;
#[path = "../../crates/view/src/hash.rs"]
mod hash;
#[path = "../../crates/view/src/recording/index.rs"]
mod index;
#[path = "../../crates/view/src/recording/reader.rs"]
mod reader;

mod blobs {
    pub(crate) use crate::hash::Hash;
}

use format::{CHUNK_HEAD, END, FILE_END, FILE_HEAD, MAX_CHUNK, MAGIC, RecordingError, VERSION};
use index::{ChunkPlace, Index, Mark, MarkKind};
use reader::Recording;

const SEPARATOR: &[u8] = b"|SWR|";

/// The bytes between separators.
fn parts(mut bytes: &[u8]) -> Vec<&[u8]> {
    let mut parts = Vec::new();
    while let Some(at) = bytes.windows(SEPARATOR.len()).position(|five| five == SEPARATOR) {
        parts.push(&bytes[..at]);
        bytes = &bytes[at + SEPARATOR.len()..];
    }
    parts.push(bytes);
    parts
}

fn push_part(file: &mut Vec<u8>, time: f64, part: &[u8]) {
    let packed = chunk::compress(part);
    file.extend((packed.len() as u32).to_le_bytes());
    file.extend(crc32fast::hash(&packed).to_le_bytes());
    file.extend(time.to_le_bytes());
    file.extend(packed);
}

/// A file whose chunks contain these parts; the last may be the index.
fn file_of(parts: &[&[u8]], has_index: bool) -> Vec<u8> {
    let mut file = [&MAGIC[..], &VERSION.to_le_bytes(), &[0; 4]].concat();
    let (index, chunks) = match parts.split_last() {
        Some((index, chunks)) if has_index => (Some(index), chunks),
        _ => (None, parts),
    };
    for (second, part) in chunks.iter().enumerate() {
        push_part(&mut file, second as f64, part);
    }
    if let Some(index) = index {
        file.extend([0; 4]);
        let place = file.len() as u64;
        push_part(&mut file, 0.0, index);
        file.extend(place.to_le_bytes());
        file.extend(END);
    }
    file
}

/// Reads all of it.
fn read(bytes: &[u8]) {
    let Ok(mut recording) = Recording::open(Cursor::new(bytes)) else { return };
    let index = recording.index().clone();
    assert!(!index.chunks.is_empty());
    let ends = index.chunks.iter().map(|chunk| chunk.place + CHUNK_HEAD + u64::from(chunk.length));
    assert!(ends.is_sorted() && index.chunks.iter().all(|chunk| chunk.place >= FILE_HEAD && chunk.place < bytes.len() as u64));
    for number in 0..index.chunks.len().min(20) {
        if let Ok(chunk) = recording.chunk(number) {
            // Either everything is read, or an error ends it.
            let messages: Vec<_> = chunk::messages(&chunk).collect();
            assert!(messages.iter().rev().skip(1).all(Result::is_ok));
        }
    }
    assert!(recording.chunk(index.chunks.len()).is_err());
    for (hash, number) in index.blobs.iter().take(20) {
        assert!(*number < index.chunks.len());
        assert_eq!(hash::Hash::from_text(&hash.to_string()), Some(*hash));
        let _ = recording.blob(*hash);
    }
    let written = index.to_bytes();
    let again = Index::from_bytes(&written, bytes.len() as u64).expect("what is written is read");
    assert_eq!(again, index);
}

fuzz_target!(|bytes: &[u8]| {
    let Some((kind, bytes)) = bytes.split_last() else { return };
    match kind & 1 {
        0 => read(bytes),
        _ => read(&file_of(&parts(bytes), kind & 2 != 0)),
    }
});
