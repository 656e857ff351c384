//! Signals of the operating system: which one asks for the end, and one that interrupts a thread in the middle of what it does.
//!
//! Elsewhere than on Unix there are none: the end is asked for by ctrl-c, and threads cannot be interrupted.

#[cfg(not(unix))]
pub use elsewhere::{
    InterruptibleThread, last_request, note_requests, reserve_standard_output, run_on_crash,
    standard_output_is_closed,
};
#[cfg(unix)]
pub use unix::{
    InterruptibleThread, last_request, note_requests, reserve_standard_output, run_on_crash,
    standard_output_is_closed,
};

/// The number of the signal that ctrl-c sends.
pub const INTERRUPT: i32 = 2;
/// The number of the signal for writing to a pipe that nobody reads.
pub const CLOSED_PIPE: i32 = 13;

#[cfg(unix)]
mod unix {
    use std::ffi::{CString, OsString};
    use std::fs::File;
    use std::mem::MaybeUninit;
    use std::os::fd::AsFd;
    use std::os::unix::ffi::OsStringExt;
    use std::ptr;
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicI32, AtomicUsize, Ordering};
    use std::time::Duration;

    use libc::c_int;
    use rustix::event::{PollFd, PollFlags, Timespec, poll};

    /// Signals that request termination.
    const REQUESTS: [c_int; 3] = [libc::SIGINT, libc::SIGTERM, libc::SIGHUP];
    /// A signal that is ignored where nobody handles it.
    const WAKE: c_int = libc::SIGURG;

    static LAST: AtomicI32 = AtomicI32::new(super::INTERRUPT);
    /// The handlers that were there before, in the order of `REQUESTS`.
    static NEXT: [AtomicUsize; 3] = [const { AtomicUsize::new(0) }; 3];
    static ON_WAKE: OnceLock<fn()> = OnceLock::new();

    /// From now on remembers which signal asked for the end, and calls the handlers that are there already.
    pub fn note_requests() {
        for (next, &signal) in NEXT.iter().zip(&REQUESTS) {
            if let Some(before) = handle(signal, note, libc::SA_RESTART)
                && before != note as *const () as usize
            {
                next.store(before, Ordering::Relaxed);
            }
        }
    }

    /// The number of the signal that asked for the end last.
    pub fn last_request() -> i32 {
        LAST.load(Ordering::Relaxed)
    }

    extern "C" fn note(signal: c_int) {
        LAST.store(signal, Ordering::Relaxed);
        let Some(next) = REQUESTS.iter().position(|&request| request == signal) else {
            return;
        };
        let next = NEXT[next].load(Ordering::Relaxed);
        if next != libc::SIG_DFL && next != libc::SIG_IGN {
            // SAFETY: the system had this address as a handler without `SA_SIGINFO`.
            let next = unsafe { std::mem::transmute::<usize, extern "C" fn(c_int)>(next) };
            next(signal);
        }
    }

    /// Sets a handler; returns the address of the one before, if it is one of a number only.
    fn handle(signal: c_int, handler: extern "C" fn(c_int), flags: c_int) -> Option<usize> {
        let mut before = MaybeUninit::<libc::sigaction>::zeroed();
        // SAFETY: records of zeros are valid, and the handlers only do what is allowed in one.
        unsafe {
            let mut action = MaybeUninit::<libc::sigaction>::zeroed().assume_init();
            action.sa_sigaction = handler as *const () as usize;
            action.sa_flags = flags;
            if libc::sigaction(signal, &raw const action, before.as_mut_ptr()) != 0 {
                return None;
            }
            let before = before.assume_init();
            (before.sa_flags & libc::SA_SIGINFO == 0).then_some(before.sa_sigaction)
        }
    }

    /// A thread that another one can interrupt.
    #[derive(Debug, Clone, Copy)]
    pub struct InterruptibleThread(libc::pthread_t);

    impl InterruptibleThread {
        /// The running thread, which lives as long as the process. `on_wake` runs in a signal handler, so it neither allocates nor waits; it
        /// is the same one for all threads.
        pub fn current(on_wake: fn()) -> Self {
            ON_WAKE.get_or_init(|| on_wake);
            // Without `SA_RESTART`: what waits in the system is to return.
            handle(WAKE, wake, 0);
            // SAFETY: it has no conditions.
            Self(unsafe { libc::pthread_self() })
        }

        /// Runs `on_wake` in the middle of what the thread does.
        pub fn wake(self) {
            // SAFETY: the thread lives as long as the process.
            unsafe { libc::pthread_kill(self.0, WAKE) };
        }
    }

    impl InterruptibleThread {
        /// How long the thread has used a processor; None where the system does not say.
        #[cfg(target_os = "linux")]
        pub fn processor_time(self) -> Option<Duration> {
            let mut clock = 0;
            let mut time = MaybeUninit::<libc::timespec>::zeroed();
            // SAFETY: the thread lives as long as the process, and both records are there to be filled.
            let time = unsafe {
                if libc::pthread_getcpuclockid(self.0, &raw mut clock) != 0
                    || libc::clock_gettime(clock, time.as_mut_ptr()) != 0
                {
                    return None;
                }
                time.assume_init()
            };
            Some(Duration::new(
                time.tv_sec.try_into().ok()?,
                time.tv_nsec.try_into().ok()?,
            ))
        }

        /// How long the thread has used a processor: the system does not say.
        #[cfg(not(target_os = "linux"))]
        pub fn processor_time(self) -> Option<Duration> {
            None
        }
    }

    extern "C" fn wake(_: c_int) {
        if let Some(on_wake) = ON_WAKE.get() {
            on_wake();
        }
    }

    /// Signals of faults in native code.
    const CRASHES: [c_int; 5] = [
        libc::SIGSEGV,
        libc::SIGBUS,
        libc::SIGILL,
        libc::SIGFPE,
        libc::SIGABRT,
    ];

    /// A program to run after a crash, in the form that the system takes.
    struct Successor {
        /// Printed to standard error before.
        message: String,
        args: Vec<CString>,
    }

    static SUCCESSOR: OnceLock<Successor> = OnceLock::new();
    /// The most arguments that can be passed on: a handler cannot allocate.
    const MAX_ARGS: usize = 256;

    /// When native code crashes, prints `message` and replaces this process by the program `args[0]`, which has no crash handler then. Does
    /// nothing where the arguments are too many, or cannot be passed on.
    pub fn run_on_crash(message: String, args: Vec<OsString>) {
        let args: Result<Vec<_>, _> = args
            .into_iter()
            .map(|arg| CString::new(arg.into_vec()))
            .collect();
        let Some(args) = args.ok().filter(|args| (1..MAX_ARGS).contains(&args.len())) else {
            return;
        };
        SUCCESSOR.get_or_init(|| Successor { message, args });
        for signal in CRASHES {
            // A fault may be a stack that is full: the handler has one of its own, which Rust gives to each thread.
            handle(
                signal,
                succeed,
                libc::SA_ONSTACK | libc::SA_RESETHAND | libc::SA_NODEFER,
            );
        }
    }

    /// Only calls that are allowed in a handler.
    extern "C" fn succeed(signal: c_int) {
        if let Some(Successor { message, args }) = SUCCESSOR.get() {
            let mut pointers = [ptr::null(); MAX_ARGS];
            for (pointer, arg) in pointers.iter_mut().zip(args) {
                *pointer = arg.as_ptr();
            }
            // SAFETY: the texts live as long as the process, and the list of pointers ends with a null pointer, being longer than `args`.
            unsafe {
                libc::write(libc::STDERR_FILENO, message.as_ptr().cast(), message.len());
                libc::execv(pointers[0], pointers.as_ptr());
            }
        }
        // SAFETY: the handler is the system's again, which ends the process.
        unsafe { libc::raise(signal) };
    }

    /// Standard output for lines of the program's own. What native code and scripts write there by themselves goes to standard error from now
    /// on. None where that is not possible.
    pub fn reserve_standard_output() -> Option<&'static File> {
        static RESERVED: OnceLock<Option<File>> = OnceLock::new();
        let reserve = || {
            // Processes that are started do not get it.
            let own = rustix::io::fcntl_dupfd_cloexec(std::io::stdout(), 3).ok()?;
            rustix::stdio::dup2_stdout(std::io::stderr()).ok()?;
            Some(File::from(own))
        };
        RESERVED.get_or_init(reserve).as_ref()
    }

    /// Whether nobody reads standard output any more, or that which was reserved.
    pub fn standard_output_is_closed(reserved: Option<&File>) -> bool {
        let stdout = std::io::stdout();
        let output = reserved.map_or_else(|| stdout.as_fd(), AsFd::as_fd);
        let mut polled = [PollFd::from_borrowed_fd(output, PollFlags::empty())];
        let at_once = Timespec {
            tv_sec: 0,
            tv_nsec: 0,
        };
        poll(&mut polled, Some(&at_once)).is_ok() && polled[0].revents().contains(PollFlags::ERR)
    }
}

#[cfg(not(unix))]
mod elsewhere {
    use std::fs::File;

    /// Does nothing: there are no signals.
    pub fn note_requests() {}

    /// The number of the signal that ctrl-c would be.
    pub fn last_request() -> i32 {
        super::INTERRUPT
    }

    /// Does nothing: crashes are not noticed.
    pub fn run_on_crash(_: String, _: Vec<std::ffi::OsString>) {}

    /// Reserves nothing.
    pub fn reserve_standard_output() -> Option<&'static File> {
        None
    }

    /// Whether nobody reads standard output any more: unknown, so false.
    pub fn standard_output_is_closed(_: Option<&File>) -> bool {
        false
    }

    /// A thread that cannot be interrupted here.
    #[derive(Debug, Clone, Copy)]
    pub struct InterruptibleThread;

    impl InterruptibleThread {
        /// The running thread.
        pub fn current(_: fn()) -> Self {
            Self
        }

        /// Does nothing.
        pub fn wake(self) {}

        /// Unknown.
        pub fn processor_time(self) -> Option<std::time::Duration> {
            None
        }
    }
}
