//! Atomic writing of files.

use std::fs::{DirEntry, File};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use fs4::{FileExt, TryLockError};
use tempfile::{NamedTempFile, TempPath};

/// The names of temporary files begin and end so.
const PREFIX: &str = ".swanilda-";
const SUFFIX: &str = ".part";

/// How often a file is made anew that another program took for abandoned before it was locked.
const ATTEMPTS: usize = 100;

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
    remove_abandoned(folder);
    for _ in 1..ATTEMPTS {
        let file = new_file().tempfile_in(folder)?;
        if is_locked_in_time(&file) {
            return Ok(file);
        }
    }
    new_file().tempfile_in(folder)
}

/// Locks a new file; false when another program has taken it for abandoned before. Where files cannot be locked, none is taken for that.
fn is_locked_in_time(file: &NamedTempFile) -> bool {
    !matches!(
        FileExt::try_lock(file.as_file()),
        Err(TryLockError::WouldBlock)
    ) && file.path().exists()
}

/// Whether this is a pipe or a device.
pub fn is_special(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|data| !data.is_file() && !data.is_dir())
}

/// Where a link leads: the link stays one.
pub fn link_target(path: &Path) -> PathBuf {
    std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

/// Removes temporary files that nobody has locked: their writers were killed. What cannot be looked at stays.
fn remove_abandoned(folder: &Path) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries {
        // The lock is held until the file is gone, so that a writer who has just made it notices.
        if let Ok(Some(_lock)) = lock_abandoned(&entry) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// A temporary file of a writer that is gone, locked.
fn lock_abandoned(entry: &DirEntry) -> std::io::Result<Option<File>> {
    let name = entry.file_name();
    let is_ours = name
        .to_str()
        .is_some_and(|name| name.starts_with(PREFIX) && name.ends_with(SUFFIX));
    if !is_ours || !entry.file_type()?.is_file() {
        return Ok(None);
    }
    let file = File::open(entry.path())?;
    Ok(FileExt::try_lock(&file).is_ok().then_some(file))
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
    fn a_file_appears_when_it_is_complete() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("film.bin");
        let mut file = WholeFile::create(&path).unwrap();
        assert_eq!(file.write(b"12345").unwrap(), 5);
        assert_eq!(file.seek(SeekFrom::Start(1)).unwrap(), 1);
        file.write_all(b"ab").unwrap();
        file.flush().unwrap();
        assert!(!path.exists());
        file.finish().unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"1ab45");
    }

    #[test]
    #[cfg(unix)]
    fn devices_are_written_to_and_stay() {
        let (device, folder) = (Path::new("/dev/null"), tempfile::tempdir().unwrap());
        assert!(is_special(device) && !is_special(folder.path()));
        write_whole(device, b"nothing").unwrap();
        WholeFile::create(device).unwrap().finish().unwrap();
        assert!(is_special(device));
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
        write_whole(&folder.path().join(".swanilda-mine"), b"").unwrap();
        assert_eq!(
            names(),
            [".swanilda-2.part", ".swanilda-mine", "other.part"]
        );
        drop(in_use);
        remove_abandoned(folder.path());
        assert_eq!(names(), [".swanilda-mine", "other.part"]);
    }

    #[test]
    fn writers_beside_each_other_do_not_lose_their_files() {
        let folder = tempfile::tempdir().unwrap();
        std::thread::scope(|scope| {
            for writer in 0..4 {
                let path = folder.path().join(format!("{writer}.txt"));
                scope.spawn(move || {
                    for round in 0..200 {
                        let text = format!("{writer} {round}");
                        write_whole(&path, text.as_bytes()).unwrap();
                        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
                    }
                });
            }
        });
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 4);
    }
}
