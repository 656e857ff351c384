//! Any bytes as a file of state hashes, with or without its head: every step is read or refused.
//!
//! `cargo fuzz run hash_file`
#![no_main]
// The reader is private to the simulator; what it needs is at the same places here.
#![allow(dead_code)]

use libfuzzer_sys::fuzz_target;

#[path = "../../crates/simulator/src/hash_file/read.rs"]
mod read;

const HEAD: &str = "swanilda state hashes 1";

fuzz_target!(|bytes: &[u8]| {
    let mut file = Vec::new();
    let bytes = match bytes.split_first() {
        Some((0, rest)) => {
            file.extend(HEAD.bytes());
            file.push(b'\n');
            rest
        }
        _ => bytes,
    };
    file.extend(bytes);
    let Ok(mut reader) = read::Reader::new(&file[..]) else { return };
    while let Ok(Some(_)) = reader.next_step() {
        let known = |(target, property): &(usize, usize)| {
            *target < reader.targets.len() && *property < reader.properties.len()
        };
        assert!(reader.values.keys().all(known));
    }
});
