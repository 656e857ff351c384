//! Atomic writing of files.

use std::fs::{DirEntry, File};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use fs4::FileExt;
use tempfile::{NamedTempFile, TempPath};

/// The names of temporary files begin and end so.
const PREFIX: &str = ".swanilda-";
const SUFFIX: &str = ".part";

/// A younger temporary file may not be locked by its writer yet.
const TIME_TO_LOCK: Duration = Duration::from_secs(60);

/// Writes a file atomically: readers see the old or the new one. Pipes and devices are written directly. Temporary files in the folder
/// whose writer was killed are removed.
///
/// # Errors
/// When the folder is not there or cannot be written.
pub fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    if is_special(path) {
        return std::fs::write(path, bytes);
    }
    let path = link_target(path);
    let mut file = part_of(&path)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

/// A file that is written piece by piece, and appears under its name when it is complete. Pipes and devices are written directly.
pub struct WholeFile {
    file: File,
    /// None for pipes and devices.
    part: Option<(TempPath, PathBuf)>,
}

impl WholeFile {
    /// Begins a file; until it is complete it has another name in the same folder.
    ///
    /// # Errors
    /// When the folder is not there or cannot be written.
    pub fn create(path: &Path) -> std::io::Result<Self> {
        if is_special(path) {
            return Ok(Self {
                file: File::create(path)?,
                part: None,
            });
        }
        let path = link_target(path);
        let (file, part) = part_of(&path)?.into_parts();
        Ok(Self {
            file,
            part: Some((part, path)),
        })
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// When it cannot be renamed.
    pub fn finish(self) -> std::io::Result<()> {
        self.part
            .map_or(Ok(()), |(part, path)| Ok(part.persist(path)?))
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

impl Seek for WholeFile {
    fn seek(&mut self, place: SeekFrom) -> std::io::Result<u64> {
        self.file.seek(place)
    }
}

/// A temporary file beside `path`, locked, to be renamed to it.
///
/// # Errors
/// When the folder is not there or cannot be written.
pub fn part_of(path: &Path) -> std::io::Result<NamedTempFile> {
    let folder = path
        .parent()
        .filter(|folder| *folder != Path::new(""))
        .unwrap_or(Path::new("."));
    remove_abandoned(folder, TIME_TO_LOCK);
    let file = new_file().tempfile_in(folder)?;
    // Where files cannot be locked, this one may be taken for abandoned if writing lasts longer than a minute.
    let _ = FileExt::try_lock(file.as_file());
    Ok(file)
}

/// Whether this is a pipe or a device.
pub fn is_special(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|data| !data.is_file() && !data.is_dir())
}

/// Where a link leads: the link stays one.
pub fn link_target(path: &Path) -> PathBuf {
    std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

/// Removes temporary files older than `age` that nobody has locked. What cannot be looked at stays.
fn remove_abandoned(folder: &Path, age: Duration) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| is_abandoned(entry, age).unwrap_or(false)) {
        let _ = std::fs::remove_file(entry.path());
    }
}

fn is_abandoned(entry: &DirEntry, age: Duration) -> std::io::Result<bool> {
    let name = entry.file_name();
    let is_ours = name
        .to_str()
        .is_some_and(|name| name.starts_with(PREFIX) && name.ends_with(SUFFIX));
    if !is_ours || !entry.file_type()?.is_file() {
        return Ok(false);
    }
    let is_old = entry
        .metadata()?
        .modified()?
        .elapsed()
        .is_ok_and(|elapsed| elapsed >= age);
    Ok(is_old && FileExt::try_lock(&File::open(entry.path())?).is_ok())
}

/// A temporary file whose rights are those of any new file.
fn new_file() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_there_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.ttt");
        write_whole(&path, b"old").unwrap();
        write_whole(&path, b"new").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        assert!(write_whole(&folder.path().join("missing/scene.ttt"), b"").is_err());
    }

    #[test]
    fn temporary_files_of_killed_writers_are_removed() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| File::create(folder.path().join(name)).unwrap();
        let names = || {
            let mut names: Vec<_> = std::fs::read_dir(folder.path())
                .unwrap()
                .map(|e| e.unwrap().file_name())
                .collect();
            names.sort();
            names
        };
        for name in [".swanilda-1.part", ".swanilda-mine", "other.part"] {
            file(name);
        }
        let in_use = file(".swanilda-2.part");
        FileExt::try_lock(&in_use).unwrap();
        remove_abandoned(folder.path(), TIME_TO_LOCK);
        assert_eq!(names().len(), 4);
        remove_abandoned(folder.path(), Duration::ZERO);
        assert_eq!(
            names(),
            [".swanilda-2.part", ".swanilda-mine", "other.part"]
        );
        drop(in_use);
        remove_abandoned(folder.path(), Duration::ZERO);
        assert_eq!(names(), [".swanilda-mine", "other.part"]);
    }
}
