//! libzmq in safe Rust: contexts, sockets, messages, and waiting for them.
//!
//! The only place that calls libzmq. It keeps what libzmq answers with the end of the program, where it finds it misused, from
//! happening: a message is always initialised, an address has no NUL, and numbers that abort it are refused here (`Context::set`,
//! `Socket::set`). Every call that could wait is told not to, except `poll` and `Termination::wait`, which have a limit.

mod context;
mod message;
mod monitor;
mod socket;

use std::ffi::{CStr, CString, c_int};

use zmq_sys as ffi;

pub(crate) use context::{Context, Termination};
pub(crate) use message::Message;
pub(crate) use socket::{Socket, poll};

/// Why libzmq failed: one of [`ERRORS`], or a number of the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Errno(pub c_int);

pub(crate) type ZmqResult<T> = Result<T, Errno>;

impl Errno {
    pub(crate) const INTERRUPTED: Self = Self(ffi::errno::EINTR);
    const INVALID: Self = Self(ffi::errno::EINVAL);
    const NO_MEMORY: Self = Self(ffi::errno::ENOMEM);
    const NO_PROTOCOL: Self = Self(ffi::errno::EPROTONOSUPPORT);
    const NO_MESSAGE: Self = Self(ffi::errno::EFAULT);

    /// What went wrong in the call of libzmq this thread made last.
    fn last() -> Self {
        // SAFETY: reads a number of this thread.
        Self(unsafe { ffi::zmq_errno() })
    }
}

/// The errors that have names, as this system numbers them.
pub(crate) const ERRORS: &[(&str, c_int)] = &[
    ("EADDRINUSE", ffi::errno::EADDRINUSE),
    ("EADDRNOTAVAIL", ffi::errno::EADDRNOTAVAIL),
    ("EAGAIN", ffi::errno::EAGAIN),
    ("EFAULT", ffi::errno::EFAULT),
    ("EFSM", ffi::errno::EFSM),
    ("EHOSTUNREACH", ffi::errno::EHOSTUNREACH),
    ("EINTR", ffi::errno::EINTR),
    ("EINVAL", ffi::errno::EINVAL),
    ("EMFILE", ffi::errno::EMFILE),
    ("EMTHREAD", ffi::errno::EMTHREAD),
    ("ENOCOMPATPROTO", ffi::errno::ENOCOMPATPROTO),
    ("ENODEV", ffi::errno::ENODEV),
    ("ENOENT", ffi::errno::ENOENT),
    ("ENOMEM", ffi::errno::ENOMEM),
    ("ENOTSOCK", ffi::errno::ENOTSOCK),
    ("ENOTSUP", ffi::errno::ENOTSUP),
    ("EPROTONOSUPPORT", ffi::errno::EPROTONOSUPPORT),
    ("ETERM", ffi::errno::ETERM),
];

/// The text of an error.
pub(crate) fn strerror(errno: c_int) -> String {
    // SAFETY: libzmq knows a text for every number; it is copied before the next call.
    let text = unsafe { CStr::from_ptr(ffi::zmq_strerror(errno)) };
    text.to_string_lossy().into_owned()
}

/// Major, minor and patch number of libzmq.
pub(crate) fn version() -> (c_int, c_int, c_int) {
    let (mut major, mut minor, mut patch) = (0, 0, 0);
    // SAFETY: writes three numbers.
    unsafe { ffi::zmq_version(&raw mut major, &raw mut minor, &raw mut patch) };
    (major, minor, patch)
}

/// Whether libzmq was built with a capability.
pub(crate) fn has(capability: &str) -> bool {
    // SAFETY: the text ends with NUL.
    CString::new(capability).is_ok_and(|capability| unsafe { ffi::zmq_has(capability.as_ptr()) } != 0)
}

/// Bytes as printable text, five characters for four bytes (ZeroMQ RFC 32). None unless their number is divisible by 4.
pub(crate) fn z85_encode(bytes: &[u8]) -> Option<Vec<u8>> {
    if bytes.is_empty() || !bytes.len().is_multiple_of(4) {
        return None;
    }
    let mut text = vec![0; bytes.len() / 4 * 5 + 1];
    // SAFETY: libzmq writes five characters for four bytes, and NUL.
    let done = unsafe { ffi::zmq_z85_encode(text.as_mut_ptr().cast(), bytes.as_ptr(), bytes.len()) };
    text.pop();
    (!done.is_null()).then_some(text)
}

/// The bytes `z85_encode` made text of. None when it is no such text.
pub(crate) fn z85_decode(text: &[u8]) -> Option<Vec<u8>> {
    if text.is_empty() || !text.len().is_multiple_of(5) {
        return None;
    }
    let mut bytes = vec![0; text.len() / 5 * 4];
    let text = CString::new(text).ok()?;
    // SAFETY: libzmq writes four bytes for five characters.
    let done = unsafe { ffi::zmq_z85_decode(bytes.as_mut_ptr(), text.as_ptr()) };
    (!done.is_null()).then_some(bytes)
}

/// What a call returned, which is -1 when it failed.
fn check(returned: c_int) -> ZmqResult<c_int> {
    if returned == -1 { Err(Errno::last()) } else { Ok(returned) }
}

/// An address or a name as libzmq reads it.
fn c_text(text: &str) -> ZmqResult<CString> {
    CString::new(text).map_err(|_| Errno::INVALID)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn z85_is_that_of_the_standard() {
        let bytes = [0x86, 0x4f, 0xd2, 0x6f, 0xb5, 0x59, 0xf7, 0x5b];
        assert_eq!(z85_encode(&bytes).as_deref(), Some(&b"HelloWorld"[..]));
        assert_eq!(z85_decode(b"HelloWorld").as_deref(), Some(&bytes[..]));
        assert_eq!((z85_encode(b"abc"), z85_decode(b"abcd"), z85_decode(b"ab\xff\x01d")), (None, None, None));
    }

    #[test]
    fn errors_have_texts() {
        assert_eq!(strerror(ffi::errno::EFSM), "Operation cannot be accomplished in current state");
    }
}
