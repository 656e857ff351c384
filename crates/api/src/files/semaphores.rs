//! Machine-wide semaphores (`sim.systemSemaphore`): each name is held by at most one program.
//!
//! Each is a locked file in the folder for temporary files, so that it is free again when its holder dies. Whoever releases it removes the
//! file; one that a killed holder has left behind is taken over by the next one.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use fs4::{FileExt, TryLockError};

use crate::{ApiError, Cx, Result};

/// File names are not longer, in bytes of the key.
const MAX_KEY_LENGTH: usize = 100;

/// The semaphores that this simulator holds, by key.
#[derive(Default)]
struct Held(RefCell<BTreeMap<Vec<u8>, Semaphore>>);

/// A semaphore that is held: its file, locked.
struct Semaphore {
    path: PathBuf,
    _file: File,
}

impl Drop for Semaphore {
    fn drop(&mut self) {
        // While it is locked: whoever waits for it notices, and makes a new one.
        let _ = std::fs::remove_file(&self.path);
    }
}

impl Held {
    /// Acquires the semaphore, unless this simulator holds it already; None while another program holds it.
    ///
    /// # Errors
    /// When the key is too long or its file cannot be made.
    fn try_acquire(&self, key: &[u8]) -> std::result::Result<Option<()>, String> {
        if self.0.borrow().contains_key(key) {
            return Ok(Some(()));
        }
        if key.len() > MAX_KEY_LENGTH {
            return Err(format!("the key is longer than {MAX_KEY_LENGTH} bytes."));
        }
        let path = path_of(key);
        let locked =
            lock(&path).map_err(|error| format!("cannot use {}: {error}", path.display()))?;
        let Some(file) = locked else {
            return Ok(None);
        };
        let semaphore = Semaphore { path, _file: file };
        self.0.borrow_mut().insert(key.to_vec(), semaphore);
        Ok(Some(()))
    }
}

/// Makes and locks a file; None while another program has it, or has just removed it.
fn lock(path: &Path) -> io::Result<Option<File>> {
    let file = File::options()
        .create(true)
        .truncate(false)
        .write(true)
        .open(path)?;
    match FileExt::try_lock(&file) {
        Ok(()) => Ok(is_at(&file, path).then_some(file)),
        Err(TryLockError::WouldBlock) => Ok(None),
        Err(TryLockError::Error(error)) => Err(error),
    }
}

/// Whether the path leads to this file, and not to one that was made since.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let number = |data: std::fs::Metadata| (data.dev(), data.ino());
    match (file.metadata(), std::fs::metadata(path)) {
        (Ok(ours), Ok(there)) => number(ours) == number(there),
        _ => false,
    }
}

/// Elsewhere a file that is open keeps its name.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

fn path_of(key: &[u8]) -> PathBuf {
    let hex: String = key.iter().map(|byte| format!("{byte:02x}")).collect();
    std::env::temp_dir().join(format!("swanilda-semaphore-{hex}"))
}

/// Waits until no other program holds the semaphore; at once if this simulator does already.
///
/// # Errors
/// When the key is too long, its file cannot be made, or the program is being stopped.
pub(crate) fn acquire(cx: &mut Cx, key: &[u8]) -> Result<()> {
    cx.permissions().check_write(&path_of(key))?;
    let held = cx.module_state::<Held>();
    let acquired = cx.wait_for(None, || held.try_acquire(key).transpose())?;
    acquired.transpose().map(drop).map_err(ApiError::Other)
}

/// Releases a semaphore, if it is held.
pub(crate) fn release(cx: &mut Cx, key: &[u8]) {
    cx.module_state::<Held>().0.borrow_mut().remove(key);
}

#[cfg(test)]
mod tests {
    use super::{Held, MAX_KEY_LENGTH, path_of};

    #[test]
    fn one_simulator_holds_it_at_a_time() {
        let key = format!("test of {}", std::process::id()).into_bytes();
        let (first, second) = (Held::default(), Held::default());
        assert_eq!(first.try_acquire(&key), Ok(Some(())));
        assert_eq!(
            first.try_acquire(&key),
            Ok(Some(())),
            "the holder acquires it again"
        );
        assert_eq!(second.try_acquire(&key), Ok(None));
        first.0.borrow_mut().clear();
        assert_eq!(second.try_acquire(&key), Ok(Some(())));
        assert!(second.try_acquire(&[0; MAX_KEY_LENGTH + 1]).is_err());
    }

    #[test]
    fn no_file_is_left_of_one_that_was_released_or_whose_holder_was_killed() {
        let key = format!("left of {}", std::process::id()).into_bytes();
        let path = path_of(&key);
        std::fs::write(&path, "").expect("a killed holder's file");
        let held = Held::default();
        assert_eq!(held.try_acquire(&key), Ok(Some(())));
        assert!(path.exists());
        held.0.borrow_mut().remove(&key);
        assert!(!path.exists(), "it was released");
        assert_eq!(held.try_acquire(&key), Ok(Some(())));
        drop(held);
        assert!(!path.exists(), "the simulator has ended");
    }

    #[test]
    #[cfg(unix)]
    fn a_file_that_its_holder_removes_meanwhile_is_no_semaphore() {
        let path = path_of(format!("removed of {}", std::process::id()).as_bytes());
        let old = std::fs::File::create(&path).expect("a file");
        assert!(super::is_at(&old, &path));
        std::fs::remove_file(&path).expect("it is there");
        assert!(!super::is_at(&old, &path));
        std::fs::write(&path, "").expect("a file");
        assert!(!super::is_at(&old, &path), "another one has its name");
        std::fs::remove_file(&path).expect("it is there");
    }
}
