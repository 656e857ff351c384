//! Any bytes as a compressed image of somebody else: they are read or refused, and what is read fits its size and the bound.
//!
//! `cargo fuzz run compressed_image`
#![no_main]

use format::picture::{Layout, Picture};
use libfuzzer_sys::fuzz_target;

const MAX_BYTES: u64 = 1 << 20;

fuzz_target!(|file: &[u8]| {
    if let Ok(picture) = Picture::decode_within(file, Layout::Rgb, MAX_BYTES) {
        let [width, height] = picture.resolution();
        let bytes = picture.into_bytes();
        assert_eq!(bytes.len() as i64, width * height * 3);
        assert!(bytes.len() as u64 <= MAX_BYTES);
    }
});
