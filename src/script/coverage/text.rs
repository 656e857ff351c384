//! Reading the texts of files.

use std::path::Path;

/// Files that are larger are no programs.
const MAX_FILE: u64 = 16 << 20;

/// The text of a Lua file; None when that is no readable file of sensible size.
pub fn read_text(path: &Path) -> Option<Vec<u8>> {
    // Lua code can name anything, such as a device that never ends.
    let is_file = std::fs::metadata(path).is_ok_and(|found| found.is_file() && found.len() <= MAX_FILE);
    if is_file { std::fs::read(path).ok() } else { None }
}
