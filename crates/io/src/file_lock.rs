//! Locks of open files, shared with other programs.

use std::io;
#[cfg(unix)]
use std::os::fd::BorrowedFd;

/// Operation on the lock of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileLock {
    /// Held together with other shared locks: nobody has an exclusive one.
    Shared,
    /// Held alone.
    Exclusive,
    /// Not held.
    Released,
}

/// Changes the lock of an open file, without waiting.
#[cfg(unix)]
pub fn lock_file(file: BorrowedFd<'_>, lock: FileLock) -> io::Result<()> {
    use rustix::fs::{FlockOperation, flock};
    let operation = match lock {
        FileLock::Shared => FlockOperation::NonBlockingLockShared,
        FileLock::Exclusive => FlockOperation::NonBlockingLockExclusive,
        FileLock::Released => FlockOperation::Unlock,
    };
    Ok(flock(file, operation)?)
}
