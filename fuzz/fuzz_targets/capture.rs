//! Any bytes as a capture: it is refused, or read to its end or to damage, without more memory than it says it has.
//!
//! The last byte says what the others are. 0: the file itself. 1: the records of a frame, whose checksum other bytes would hardly guess.
//!
//! `cargo fuzz run capture`
#![no_main]

use std::io::Write;

use capture::{Input, Reader, Record, Recorded};
use flate2::Compression;
use flate2::write::DeflateEncoder;
use libfuzzer_sys::fuzz_target;

fn read(bytes: &[u8]) {
    let Ok(mut reader) = Reader::new(bytes) else { return };
    for _ in 0..100_000 {
        match reader.next_record() {
            Ok(Some(record)) => {
                let mut written = Vec::new();
                record.write(&mut written);
                let again = Record::read(&mut Input::new(&written));
                assert_eq!(again, Some(record), "what is written is read");
            }
            Ok(None) | Err(_) => return,
        }
    }
}

/// A file with one frame.
fn file_of(records: &[u8]) -> Vec<u8> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(records).expect("memory takes everything");
    let packed = encoder.finish().expect("memory takes everything");
    let mut file = b"SWANCAPT".to_vec();
    let words = [1, packed.len() as u32, records.len() as u32, crc32fast::hash(&packed)];
    words.iter().for_each(|word| file.extend(word.to_le_bytes()));
    file.extend(packed);
    file
}

fuzz_target!(|bytes: &[u8]| {
    let Some((kind, bytes)) = bytes.split_last() else { return };
    match kind & 1 {
        0 => read(bytes),
        _ => read(&file_of(bytes)),
    }
});
