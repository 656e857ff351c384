//! Files of Lua's io library.

use std::ffi::{c_int, c_void};
use std::io;
use std::marker::PhantomData;
#[cfg(unix)]
use std::os::fd::BorrowedFd;
use std::ptr::NonNull;
use std::sync::OnceLock;

use mlua::ffi;

use super::calls::guard::{Next, guarded, install};
use super::stack::{Stack, Type};
use ::io::FileLock;

/// Lua's `luaL_Stream`.
#[repr(C)]
struct Stream {
    file: Option<NonNull<c_void>>,
    /// None once the file is closed.
    close: Option<NonNull<c_void>>,
}

impl Stack<'_> {
    /// Changes the lock of the file at `index`, without waiting; None when that is not an open file.
    pub fn lock_file(self, index: c_int, lock: FileLock) -> Option<io::Result<()>> {
        let _room = self.large_room();
        // SAFETY: userdata with that metatable are streams of Lua's io library. There is room for the metatables that are compared.
        let stream = unsafe {
            ffi::luaL_testudata(self.raw(), index, c"FILE*".as_ptr())
                .cast::<Stream>()
                .as_ref()
        }?;
        stream.close?;
        Some(apply(File(stream.file?, PhantomData), lock))
    }
}

/// C's number for writing to a pipe that nobody reads.
const CLOSED_PIPE: i64 = 32;

/// What learns of a write to a pipe that nobody reads.
pub(crate) type OnClosedPipe = fn(Stack<'_>);

/// The one of the process: there is one host implementation, so a static suffices.
static ON_CLOSED_PIPE: OnceLock<OnClosedPipe> = OnceLock::new();

/// From now on the host learns when a script writes to a pipe that nobody reads, which Lua's functions only return.
pub(crate) fn report_closed_pipes(stack: Stack<'_>, on_closed_pipe: OnClosedPipe) {
    ON_CLOSED_PIPE.get_or_init(|| on_closed_pipe);
    stack.push_global("io");
    install::<{ guarded::IO_WRITE }, _>(stack, "write", |_| Next::OriginalThen(report_closed_pipe));
    stack.raw_get_field(-1, "stdout");
    if stack.push_metatable(-1) {
        stack.raw_get_field(-1, "__index");
        install::<{ guarded::FILE_WRITE }, _>(stack, "write", |_| {
            Next::OriginalThen(report_closed_pipe)
        });
        stack.pop(2);
    }
    stack.pop(2);
}

/// The results of a failed call are on top: nil, a text, the number.
fn report_closed_pipe(stack: Stack<'_>) {
    if stack.kind(-3) == Type::Nil
        && stack.kind(-1) == Type::Number
        && stack.integer(-1) == Some(CLOSED_PIPE)
        && let Some(on_closed_pipe) = ON_CLOSED_PIPE.get()
    {
        on_closed_pipe(stack);
    }
}

/// An open file of C's library.
#[repr(transparent)]
struct File<'a>(NonNull<c_void>, PhantomData<&'a Stream>);

#[cfg(unix)]
fn apply(file: File<'_>, lock: FileLock) -> io::Result<()> {
    // SAFETY: as declared in stdio.h. It reads the descriptor of an open file, or returns -1, which is None.
    unsafe extern "C" {
        safe fn fileno<'a>(file: File<'a>) -> Option<BorrowedFd<'a>>;
    }
    ::io::lock_file(fileno(file).ok_or_else(io::Error::last_os_error)?, lock)
}

#[cfg(not(unix))]
fn apply(_: File<'_>, _: FileLock) -> io::Result<()> {
    Err(io::Error::new(
        io::ErrorKind::Unsupported,
        "not implemented in Swanilda on this system: lfs.lock",
    ))
}
