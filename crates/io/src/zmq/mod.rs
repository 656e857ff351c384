//! libzmq in safe Rust: contexts, sockets, messages, and waiting for them.
//!
//! libzmq aborts the program when it finds itself misused. That cannot happen through this module: a message is always initialised, an
//! address has no NUL, and values that abort libzmq are errors (`Context::set`, `Socket::set`). No call blocks,
//! except `poll` and `Termination::wait`, which have a time limit.

#[forbid(unsafe_code)]
mod context;
#[expect(unsafe_code, reason = "an edge to C")]
mod libzmq;
#[forbid(unsafe_code)]
mod message;
#[forbid(unsafe_code)]
mod monitor;
#[forbid(unsafe_code)]
mod socket;

use std::ffi::{CString, c_int};

use zmq_sys as ffi;

pub use context::{Context, Termination};
pub use libzmq::{has, strerror, version, z85_decode, z85_encode};
pub use message::Message;
pub use socket::{Socket, poll};

/// Why libzmq failed: one of [`ERRORS`], or a number of the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Errno(pub c_int);

/// The result of a call to libzmq.
pub type ZmqResult<T> = Result<T, Errno>;

impl Errno {
    /// A signal or the end of the simulator interrupted the call.
    pub const INTERRUPTED: Self = Self(ffi::errno::EINTR);
    const INVALID: Self = Self(ffi::errno::EINVAL);
    const NO_MEMORY: Self = Self(ffi::errno::ENOMEM);
    const NO_PROTOCOL: Self = Self(ffi::errno::EPROTONOSUPPORT);
    const NO_MESSAGE: Self = Self(ffi::errno::EFAULT);
}

/// The errors with names, and their numbers on this system.
pub const ERRORS: &[(&str, c_int)] = &[
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
        assert_eq!(
            (
                z85_encode(b"abc"),
                z85_decode(b"abcd"),
                z85_decode(b"ab\xff\x01d")
            ),
            (None, None, None)
        );
    }

    #[test]
    fn errors_have_texts() {
        assert_eq!(
            strerror(ffi::errno::EFSM),
            "Operation cannot be accomplished in current state"
        );
    }
}
