//! Files of Lua's io library.

use std::ffi::c_int;
use std::io;

use mlua::ffi;

use super::stack::Stack;

/// What to do with the lock of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FileLock {
    Shared,
    Exclusive,
    Released,
}

/// Lua's `luaL_Stream`.
#[repr(C)]
struct Stream {
    file: *mut std::ffi::c_void,
    /// Null once the file is closed.
    close: Option<unsafe extern "C" fn()>,
}

impl Stack<'_> {
    /// Changes the lock of the file at `index`, without waiting; None when that is not an open file.
    pub(crate) fn lock_file(self, index: c_int, lock: FileLock) -> Option<io::Result<()>> {
        // SAFETY: userdata with that metatable are streams of Lua's io library.
        let stream = unsafe { ffi::luaL_testudata(self.raw(), index, c"FILE*".as_ptr()).cast::<Stream>().as_ref() }?;
        stream.close?;
        Some(apply(stream.file, lock))
    }
}

#[cfg(unix)]
fn apply(file: *mut std::ffi::c_void, lock: FileLock) -> io::Result<()> {
    unsafe extern "C" {
        fn fileno(file: *mut std::ffi::c_void) -> c_int;
        fn flock(descriptor: c_int, operation: c_int) -> c_int;
    }
    const NO_WAIT: c_int = 4;
    let operation = match lock {
        FileLock::Shared => 1 | NO_WAIT,
        FileLock::Exclusive => 2 | NO_WAIT,
        FileLock::Released => 8,
    };
    // SAFETY: an open C file; both calls report failures.
    let status = unsafe { flock(fileno(file), operation) };
    if status == 0 { Ok(()) } else { Err(io::Error::last_os_error()) }
}

#[cfg(not(unix))]
fn apply(_: *mut std::ffi::c_void, _: FileLock) -> io::Result<()> {
    Err(io::Error::new(io::ErrorKind::Unsupported, "not implemented in Swanilda on this system: lfs.lock"))
}
