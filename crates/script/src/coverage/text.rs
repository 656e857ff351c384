//! Reading the texts of files.

use std::path::Path;

/// Larger files are not programs.
const MAX_FILE: u64 = 16 << 20;

/// The text of a Lua file; None if it is not a readable regular file, or too large.
pub fn read_text(path: &Path) -> Option<Vec<u8>> {
    // Lua code can name any path, such as an endless device.
    let is_file =
        std::fs::metadata(path).is_ok_and(|found| found.is_file() && found.len() <= MAX_FILE);
    if is_file {
        std::fs::read(path).ok()
    } else {
        None
    }
}
