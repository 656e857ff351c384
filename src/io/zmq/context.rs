//! Contexts of sockets, and their termination.

use std::ffi::{c_int, c_void};
use std::mem;
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use zmq_sys as ffi;

use super::{Errno, ZmqResult, check};

/// More threads serve no purpose, and libzmq ends the program when the system refuses one.
const MAX_IO_THREADS: c_int = 32;
/// What libzmq gives as its limit. It makes room for that many at once.
const MAX_SOCKETS: c_int = 65_535;

/// Default time that terminating a context waits for unsent messages.
const PATIENCE: Duration = Duration::from_secs(2);

/// A context. It ends when it is dropped, and its sockets must be closed by then; [`super::Socket`] sees to that.
pub(crate) struct Context {
    raw: *mut c_void,
}

impl Context {
    /// # Errors
    /// When there are too many of them.
    pub(crate) fn new() -> ZmqResult<Self> {
        // SAFETY: asks for nothing.
        let raw = unsafe { ffi::zmq_ctx_new() };
        if raw.is_null() { Err(Errno::last()) } else { Ok(Self { raw }) }
    }

    pub(super) fn raw(&self) -> *mut c_void {
        self.raw
    }

    pub(crate) fn get(&self, option: c_int) -> ZmqResult<c_int> {
        // SAFETY: the context lives.
        check(unsafe { ffi::zmq_ctx_get(self.raw, option) })
    }

    /// # Errors
    /// Also for values that end the program where the system does not like them: many threads, and how they are scheduled.
    pub(crate) fn set(&self, option: c_int, value: c_int) -> ZmqResult<()> {
        let dangerous = match option as u32 {
            ffi::ZMQ_IO_THREADS => value > MAX_IO_THREADS,
            ffi::ZMQ_MAX_SOCKETS => value > MAX_SOCKETS,
            ffi::ZMQ_THREAD_PRIORITY | ffi::ZMQ_THREAD_SCHED_POLICY => value >= 0,
            _ => false,
        };
        if dangerous {
            return Err(Errno::INVALID);
        }
        // SAFETY: the context lives.
        check(unsafe { ffi::zmq_ctx_set(self.raw, option, value) }).map(drop)
    }

    /// From now on its sockets answer `ETERM` to everything.
    pub(crate) fn shutdown(&self) -> ZmqResult<()> {
        // SAFETY: the context lives.
        check(unsafe { ffi::zmq_ctx_shutdown(self.raw) }).map(drop)
    }

    /// Begins its end: messages of closed sockets that are still on their way may hold it up.
    pub(crate) fn terminate(self) -> Termination {
        let termination = Termination::begin(self.raw);
        mem::forget(self);
        termination
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        Termination::begin(self.raw).wait(PATIENCE);
    }
}

/// The end of a context that has begun.
pub(crate) struct Termination {
    done: Receiver<()>,
}

/// A context on its way to the thread that ends it.
struct Ending(*mut c_void);

// SAFETY: libzmq's contexts may be used from any thread.
unsafe impl Send for Ending {}

impl Ending {
    fn finish(self) {
        // SAFETY: all its sockets are closed, so only this waits for it. A signal may interrupt it.
        while unsafe { ffi::zmq_ctx_term(self.0) } == -1 && Errno::last() == Errno::INTERRUPTED {}
    }
}

impl Termination {
    /// On a separate thread, so that callers need not wait until all messages are sent.
    fn begin(context: *mut c_void) -> Self {
        let (tell, done) = mpsc::channel();
        let ending = Ending(context);
        let started = std::thread::Builder::new().name("zmq end".into()).spawn(move || {
            ending.finish();
            // Whether anybody still listens does not matter.
            let _ = tell.send(());
        });
        // Without a thread the context is left as it is: its sockets are closed all the same.
        drop(started);
        Self { done }
    }

    /// Waits for the end, at most that long; whether it has come.
    pub(crate) fn wait(&self, patience: Duration) -> bool {
        self.done.recv_timeout(patience) != Err(mpsc::RecvTimeoutError::Timeout)
    }

    /// Waits for several, as long as for one.
    pub(crate) fn wait_for_all(all: impl IntoIterator<Item = Self>) {
        let mut patience = PATIENCE;
        for termination in all.into_iter().collect::<Vec<_>>() {
            if !termination.wait(patience) {
                patience = Duration::ZERO;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_option_that_would_end_the_program_is_refused() {
        let context = Context::new().expect("a context");
        for (option, value) in [(1, 1 << 20), (2, i32::MAX), (3, 99), (4, 1)] {
            assert_eq!(context.set(option, value), Err(Errno::INVALID));
        }
        assert_eq!((context.set(1, 2), context.get(1)), (Ok(()), Ok(2)));
        assert!(context.terminate().wait(Duration::from_secs(30)));
    }
}
