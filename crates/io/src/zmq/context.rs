//! Contexts of sockets, and their termination.

use std::ffi::c_int;
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use zmq_sys as ffi;

use heap::resource::Resource;
use heap::{Outer, outside};

use super::libzmq::{RawContext, RawSocket};
use super::{Errno, ZmqResult};

/// More threads serve no purpose, and libzmq aborts the program when the system refuses one.
const MAX_IO_THREADS: c_int = 32;
/// The limit that libzmq itself reports. It allocates room for so many at once.
const MAX_SOCKETS: c_int = 65_535;

/// Default time that a termination waits for unsent messages.
const TIMEOUT: Duration = Duration::from_secs(2);

/// A context. It is terminated when it is dropped; its sockets are closed by then, since a [`super::Socket`] holds its context.
pub struct Context {
    /// None only while it is dropped.
    raw: Option<RawContext>,
    /// None for one that lasts.
    _resource: Option<Resource>,
}

impl Context {
    /// # Errors
    /// When there are too many of them.
    pub fn new() -> ZmqResult<Self> {
        Ok(Self {
            raw: Some(RawContext::new()?),
            _resource: Some(Resource::new(|| "a ZeroMQ context".to_owned())),
        })
    }

    /// One that ends with the simulator, so that snapshots may have it.
    ///
    /// # Errors
    /// When there are too many of them.
    pub fn lasting() -> ZmqResult<Self> {
        Ok(Self {
            raw: Some(RawContext::new()?),
            _resource: None,
        })
    }

    fn raw(&self) -> &RawContext {
        self.raw
            .as_ref()
            .expect("only dropping a context takes it away")
    }

    pub(super) fn socket(&self, kind: c_int) -> ZmqResult<RawSocket> {
        self.raw().socket(kind)
    }

    /// An option of the context, by its number `ZMQ_*`.
    pub fn get(&self, option: c_int) -> ZmqResult<c_int> {
        self.raw().get(option)
    }

    /// # Errors
    /// Also for values with which libzmq aborts the program if the system refuses them: many threads, and how they are scheduled.
    pub fn set(&self, option: c_int, value: c_int) -> ZmqResult<()> {
        let is_dangerous = match option as u32 {
            ffi::ZMQ_IO_THREADS => value > MAX_IO_THREADS,
            ffi::ZMQ_MAX_SOCKETS => value > MAX_SOCKETS,
            ffi::ZMQ_THREAD_PRIORITY | ffi::ZMQ_THREAD_SCHED_POLICY => value >= 0,
            _ => false,
        };
        if is_dangerous {
            Err(Errno::INVALID)
        } else {
            self.raw().set(option, value)
        }
    }

    /// From now on every call on its sockets fails with `ETERM`.
    pub fn shutdown(&self) -> ZmqResult<()> {
        self.raw().shutdown()
    }

    /// Starts its termination, which unsent messages of closed sockets can delay.
    pub fn terminate(mut self) -> Termination {
        Termination::start(self.raw.take())
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        if let Some(raw) = self.raw.take() {
            Termination::start(Some(raw)).wait(TIMEOUT);
        }
    }
}

/// A termination in progress. Its thread may outlive what the memory of a simulator is now.
pub struct Termination {
    done: Outer<Receiver<()>>,
}

impl Termination {
    /// On a separate thread, so that callers need not wait until all messages are sent.
    fn start(context: Option<RawContext>) -> Self {
        let (sender, done) = outside(mpsc::channel);
        outside(|| {
            let thread = std::thread::Builder::new()
                .name("zmq end".into())
                .spawn(move || {
                    if let Some(context) = context {
                        context.terminate();
                    }
                    // The caller may have stopped waiting for the result.
                    let _ = sender.send(());
                });
            // Without a thread the context stays: its sockets are closed all the same.
            drop(thread);
        });
        Self {
            done: Outer::new(done),
        }
    }

    /// Waits for the end, at most so long; returns whether it was reached.
    pub fn wait(&self, timeout: Duration) -> bool {
        let end = self.done.with(|done| done.recv_timeout(timeout));
        end != Err(mpsc::RecvTimeoutError::Timeout)
    }

    /// Waits for several, altogether as long as for one.
    pub fn wait_for_all(all: impl IntoIterator<Item = Self>) {
        let mut timeout = TIMEOUT;
        for termination in all.into_iter().collect::<Vec<_>>() {
            if !termination.wait(timeout) {
                timeout = Duration::ZERO;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_option_that_would_abort_the_program_is_refused() {
        let context = Context::new().expect("a context");
        for (option, value) in [(1, 1 << 20), (2, i32::MAX), (3, 99), (4, 1)] {
            assert_eq!(context.set(option, value), Err(Errno::INVALID));
        }
        assert_eq!((context.set(1, 2), context.get(1)), (Ok(()), Ok(2)));
        assert!(context.terminate().wait(Duration::from_secs(30)));
    }
}
