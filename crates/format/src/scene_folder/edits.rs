//! Whether the files of an unpacked scene were changed since they were written, so that nothing of them is lost.

use std::io;
use std::path::{Path, PathBuf};

use super::{PARTS, TREE};

/// The file with the checksum of all others.
const NOTE: &str = ".unpacked";

/// What becomes of the files of a folder that was unpacked before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Edits {
    /// A folder whose files were changed stays as it is: an error.
    #[default]
    Keep,
    /// They are replaced.
    Discard,
}

/// Remembers the files as they are: they can be made again from a scene file.
///
/// # Errors
/// When the folder cannot be read or written.
pub fn note(folder: &Path) -> io::Result<()> {
    std::fs::write(folder.join(NOTE), checksum(folder)?)
}

/// Whether the files are those that were noted last. None: none were.
pub(super) fn are_as_noted(folder: &Path) -> io::Result<Option<bool>> {
    match std::fs::read_to_string(folder.join(NOTE)) {
        Ok(noted) => Ok(Some(noted.trim() == checksum(folder)?)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// A number for the names and contents of the files of a scene (FNV-1a).
pub(super) fn checksum(folder: &Path) -> io::Result<String> {
    let mut sum = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |bytes: &[u8]| {
        for byte in bytes {
            sum = (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for file in files(folder)? {
        let content = std::fs::read(&file)?;
        let name = file.strip_prefix(folder).unwrap_or(&file);
        add(name.to_string_lossy().as_bytes());
        add(&content.len().to_le_bytes());
        add(&content);
    }
    Ok(format!("{sum:016x}"))
}

/// The tree, and what is in the folders beside it, sorted.
fn files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = vec![folder.join(TREE)];
    let mut pending: Vec<PathBuf> = PARTS.iter().map(|part| folder.join(part)).collect();
    while let Some(below) = pending.pop() {
        if !below.is_dir() {
            continue;
        }
        for entry in std::fs::read_dir(below)? {
            let entry = entry?;
            // By their own type: a link could lead back here.
            if entry.file_type()?.is_dir() {
                pending.push(entry.path());
            } else if entry.path().is_file() {
                found.push(entry.path());
            }
        }
    }
    found.sort();
    Ok(found)
}
