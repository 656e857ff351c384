//! What is known and read of files, on the tape of the simulator: a replay gets it from the capture, and reads no file.

use std::io;
use std::path::{Path, PathBuf};

use super::{Permissions, read_bounded};

impl Permissions {
    /// The bytes of a file, which is checked first.
    ///
    /// # Errors
    /// When it may not or cannot be read.
    pub fn read_file(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.check_read(path)?;
        self.read_checked(path)
    }

    /// The bytes of a file that was checked before.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn read_checked(&self, path: &Path) -> io::Result<Vec<u8>> {
        if !self.tape().is_on() {
            return read_bounded(path);
        }
        let kind = format!("the file {}", path.display());
        self.tape().content(&kind, || read_bounded(path))
    }

    /// Whether there is something at a path.
    pub fn exists(&self, path: &Path) -> bool {
        self.look("whether there is", path, Path::exists)
    }

    /// Whether there is a file at a path.
    pub fn is_file(&self, path: &Path) -> bool {
        self.look("whether there is a file", path, Path::is_file)
    }

    /// Whether there is a folder at a path.
    pub fn is_dir(&self, path: &Path) -> bool {
        self.look("whether there is a folder", path, Path::is_dir)
    }

    fn look(&self, what: &str, path: &Path, look: fn(&Path) -> bool) -> bool {
        if !self.tape().is_on() {
            return look(path);
        }
        let kind = format!("{what} {}", path.display());
        self.tape().input(&kind, || look(path)).unwrap_or_default()
    }

    /// A path from the root of the file system on: relative ones begin in the folder the program is in.
    ///
    /// # Errors
    /// When the path is empty, or that folder is gone.
    pub fn absolute(&self, path: &Path) -> io::Result<PathBuf> {
        if !self.tape().is_on() {
            return std::path::absolute(path);
        }
        let text = |path: PathBuf| path.to_string_lossy().into_owned();
        let kind = format!("where {} is", path.display());
        let read = || std::path::absolute(path).map(text);
        self.tape().input(&kind, read)?.map(PathBuf::from)
    }

    /// Writes something outside, unless a run is replayed: then it is said how that went.
    ///
    /// # Errors
    /// Those of `write`.
    pub fn write(&self, path: &Path, write: impl FnOnce() -> io::Result<()>) -> io::Result<()> {
        if !self.tape().is_on() {
            return write();
        }
        let kind = format!("writing {}", path.display());
        self.tape().input(&kind, write)?
    }
}
