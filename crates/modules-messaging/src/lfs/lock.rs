//! Locks on files that scripts have opened with `io.open`, for the Lua module `lfs`.
//!
//! They are advisory, hold for the whole file, and end when it is closed.

use std::ffi::c_int;

use io::FileLock;
use script::{ApiError, ApiFn, ApiResult, Args, Param, needs_lua};

pub(super) const FUNCTIONS: &[ApiFn] = &[ApiFn {
    name: "lfs.lock",
    doc: "Locks an open file (`r`: shared, `w`: alone) or releases it (`u`), without waiting.",
    params: &[
        Param::required("file", "any"),
        Param::required("mode", "string"),
    ],
    returns: &[],
    mutates: false,
    call: lock,
    call_data: needs_lua,
}];

fn lock(args: &mut Args<'_>) -> ApiResult<c_int> {
    args.require(2)?;
    let stack = args.stack();
    let lock = match stack.with_bytes(2, |mode| mode.first().copied()).flatten() {
        Some(b'r') => FileLock::Shared,
        Some(b'w') => FileLock::Exclusive,
        Some(b'u') => FileLock::Released,
        _ => return Err(ApiError::Other("invalid mode.".into())),
    };
    let result = stack
        .lock_file(1, lock)
        .ok_or_else(|| ApiError::Other("not an open file.".into()))?;
    match result {
        Ok(()) => {
            stack.push_bool(true);
            Ok(1)
        }
        Err(error) => {
            stack.push_nil();
            stack.push_bytes(system_words(&error).as_bytes());
            stack.push_int(error.raw_os_error().unwrap_or_default().into());
            Ok(3)
        }
    }
}

/// Message of the operating system for an error, without the number that Rust appends.
pub(super) fn system_words(error: &std::io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error")
        .next()
        .unwrap_or_default()
        .to_owned()
}
