//! Machine-wide semaphores (`sim.systemSemaphore`): each name is held by at most one program.
//!
//! Each is a locked file in the folder for temporary files, so that it is free again when its holder dies.

use std::collections::BTreeMap;
use std::fs::File;

use fs4::{FileExt, TryLockError};

use crate::script::error::{ApiError, ApiResult};
use crate::script::sim::Sim;

/// File names are not longer, in bytes of the key.
const LONGEST_KEY: usize = 100;

/// Those this simulator holds, by key.
#[derive(Default)]
pub(crate) struct SystemSemaphores(BTreeMap<Vec<u8>, File>);

impl SystemSemaphores {
    /// Acquires the semaphore, unless this simulator holds it already; None while another program holds it.
    ///
    /// # Errors
    /// When the key is too long or its file cannot be made.
    fn try_acquire(&mut self, key: &[u8]) -> Result<Option<()>, String> {
        if self.0.contains_key(key) {
            return Ok(Some(()));
        }
        if key.len() > LONGEST_KEY {
            return Err(format!("the key is longer than {LONGEST_KEY} bytes."));
        }
        let hex: String = key.iter().map(|byte| format!("{byte:02x}")).collect();
        let path = std::env::temp_dir().join(format!("swanilda-semaphore-{hex}"));
        let failed = |error| format!("cannot use {}: {error}", path.display());
        let file = File::options().create(true).truncate(false).write(true).open(&path).map_err(failed)?;
        match FileExt::try_lock(&file) {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Ok(None),
            Err(TryLockError::Error(error)) => return Err(failed(error)),
        }
        self.0.insert(key.to_vec(), file);
        Ok(Some(()))
    }

    /// Releases a semaphore, if it is held.
    pub(crate) fn release(&mut self, key: &[u8]) {
        self.0.remove(key);
    }
}

impl Sim {
    /// Waits until no other program holds the semaphore; at once if this simulator does already.
    ///
    /// # Errors
    /// When the key is too long, its file cannot be made, or the user wants the program to end.
    pub(crate) fn acquire_semaphore(&self, key: &[u8]) -> ApiResult<()> {
        let attempt = || self.channels.semaphores.borrow_mut().try_acquire(key).transpose();
        let acquired = self.wait_for(None, attempt)?;
        acquired.transpose().map(drop).map_err(ApiError::Other)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::Ordering;
    use std::time::Duration;

    use crate::script::{ApiError, Languages, Options, Registry, Silent, Sim};

    /// Runs with a simulator of its own.
    fn with_sim<R>(options: Options, test: impl FnOnce(&Sim) -> R) -> R {
        test(&Sim::new(options, Registry::without_functions(), Box::new(Silent), Languages::default()))
    }

    #[test]
    fn a_wait_ends_when_the_program_is_to_end() {
        let key = format!("test of {}", std::process::id()).into_bytes();
        with_sim(Options::default(), |holder| {
            assert_eq!(holder.acquire_semaphore(&key), Ok(()));
            assert_eq!(holder.acquire_semaphore(&key), Ok(()), "it has it already");
            let options = Options::default();
            let stop = options.stop.clone();
            let waiting = {
                let key = key.clone();
                std::thread::spawn(move || with_sim(options, |sim| sim.acquire_semaphore(&key)))
            };
            assert!(!waiting.is_finished());
            stop.store(true, Ordering::Relaxed);
            assert_eq!(waiting.join().expect("it does not panic"), Err(ApiError::Interrupted));
            holder.channels.semaphores.borrow_mut().release(&key);
        });
        with_sim(Options::default(), |next| assert_eq!(next.acquire_semaphore(&key), Ok(()), "it is free"));
    }

    #[test]
    fn a_wait_with_a_limit_ends() {
        with_sim(Options::default(), |sim| {
            assert_eq!(sim.wait_for(Some(Duration::from_millis(2)), || None::<()>), Ok(None));
            assert_eq!(sim.wait_for(Some(Duration::ZERO), || Some(1)), Ok(Some(1)), "the answer is asked for first");
        });
    }
}
