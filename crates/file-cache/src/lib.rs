//! Results of long computations, kept in the files of a folder for the next process that needs them.
//!
//! A file holds one result and is named by the [`Key`], the SHA-256 of all that the result depends on. So a result never becomes stale.
//!
//! - Processes may share a folder: a file is written under another name and renamed, so that readers find all of it or nothing.
//! - A file that is damaged, incomplete or of something else counts as missing: its length and its SHA-256 are checked.
//! - The folder has a largest size: after each writing the files that were written first are removed, down to three quarters of it.
//! - Nothing is an error: what cannot be read is missing, and what cannot be written (a full disk, a folder of others) is not kept.
//!
//! ```
//! use file_cache::{FileCache, Key};
//!
//! let folder = tempfile::tempdir()?;
//! let cache = FileCache::new(folder.path().join("squares"), 1 << 20);
//! let key = Key::of(&[b"squares, version 1", b"12"]);
//! assert!(cache.get(&key).is_none());
//! cache.put(&[(key, b"144".to_vec())]);
//! assert_eq!(cache.get(&key).as_deref(), Some(b"144".as_slice()));
//! # Ok::<(), std::io::Error>(())
//! ```

#![forbid(unsafe_code)]

mod entry;
mod key;

use std::fs::{self, DirBuilder, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

pub use key::Key;

/// A folder with results; see the [crate](crate).
#[derive(Debug, Clone)]
pub struct FileCache {
    folder: PathBuf,
    /// Bytes of all files together.
    limit: u64,
    is_read_only: bool,
}

impl FileCache {
    /// The results in `folder`, which is made when it is needed; its files have up to `limit` bytes together. No other files may lie there.
    pub fn new(folder: PathBuf, limit: u64) -> Self {
        Self {
            folder,
            limit,
            is_read_only: false,
        }
    }

    /// The same, but nothing is written.
    #[must_use]
    pub fn read_only(self) -> Self {
        Self {
            is_read_only: true,
            ..self
        }
    }

    /// A result that was put here, maybe by another process.
    pub fn get(&self, key: &Key) -> Option<Vec<u8>> {
        let bytes = read(&self.path(key), self.limit)?;
        entry::open(key, bytes)
    }

    /// Keeps results, as far as that is possible.
    pub fn put(&self, results: &[(Key, Vec<u8>)]) {
        if self.is_read_only || results.is_empty() || make_folder(&self.folder).is_err() {
            return;
        }
        // What cannot be kept is computed again: only slower.
        let _ = results
            .iter()
            .try_for_each(|(key, result)| self.write(key, result));
        let _ = self.remove_oldest();
    }

    fn path(&self, key: &Key) -> PathBuf {
        self.folder.join(key.to_string())
    }

    fn write(&self, key: &Key, result: &[u8]) -> io::Result<()> {
        if result.len() as u64 > self.limit / 4 {
            return Ok(());
        }
        // Files of this kind can be read by the user only.
        let mut file = tempfile::NamedTempFile::new_in(&self.folder)?;
        file.write_all(&entry::seal(key, result))?;
        file.persist(self.path(key))?;
        Ok(())
    }

    /// Removes what was written first, where the files are larger than the limit.
    fn remove_oldest(&self) -> io::Result<()> {
        let mut files = self.files()?;
        let mut size: u64 = files.iter().map(|file| file.size).sum();
        if size <= self.limit {
            return Ok(());
        }
        files.sort();
        for file in files {
            if size <= self.limit / 4 * 3 {
                break;
            }
            // Another process may have removed it.
            let _ = fs::remove_file(&file.path);
            size -= file.size;
        }
        Ok(())
    }

    /// All files, those of writers that were interrupted too.
    fn files(&self) -> io::Result<Vec<Kept>> {
        let mut files = Vec::new();
        for entry in fs::read_dir(&self.folder)?.flatten() {
            // One that another process has just removed has no metadata.
            let Ok(metadata) = entry.metadata() else {
                continue;
            };
            if metadata.is_file() {
                files.push(Kept {
                    written: metadata.modified()?,
                    path: entry.path(),
                    size: metadata.len(),
                });
            }
        }
        Ok(files)
    }
}

/// A file of the folder; ordered by when it was written.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Kept {
    written: SystemTime,
    path: PathBuf,
    size: u64,
}

/// The bytes of a file, unless it has more than `limit` or is none: a pipe could keep a reader waiting.
fn read(path: &Path, limit: u64) -> Option<Vec<u8>> {
    if !fs::symlink_metadata(path).ok()?.is_file() {
        return None;
    }
    let file = File::open(path).ok()?;
    let size = file.metadata().ok()?.len();
    if size > limit {
        return None;
    }
    let mut bytes = Vec::with_capacity(usize::try_from(size).ok()?);
    file.take(size).read_to_end(&mut bytes).ok()?;
    Some(bytes)
}

/// Makes the folder, for the user only.
fn make_folder(folder: &Path) -> io::Result<()> {
    let mut builder = DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.recursive(true).create(folder)
}

#[cfg(test)]
mod tests;
