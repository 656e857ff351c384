//! Machine-wide semaphores (`sim.systemSemaphore`): each name is held by at most one program.
//!
//! Each is a locked file in the folder for temporary files, so that it is free again when its holder dies.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::PathBuf;

use fs4::{FileExt, TryLockError};

use crate::{ApiError, Cx, Result};

/// File names are not longer, in bytes of the key.
const MAX_KEY_LENGTH: usize = 100;

/// The semaphores that this simulator holds, by key.
#[derive(Default)]
struct Held(RefCell<BTreeMap<Vec<u8>, File>>);

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
        let failed = |error| format!("cannot use {}: {error}", path.display());
        let file = File::options()
            .create(true)
            .truncate(false)
            .write(true)
            .open(&path)
            .map_err(failed)?;
        match FileExt::try_lock(&file) {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Ok(None),
            Err(TryLockError::Error(error)) => return Err(failed(error)),
        }
        self.0.borrow_mut().insert(key.to_vec(), file);
        Ok(Some(()))
    }
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
    use super::{Held, MAX_KEY_LENGTH};

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
}
