//! Requests to end: ctrl-c, SIGTERM, SIGHUP, and a reader of standard output that is gone.
//!
//! The first one asks for a clean end, the second one ends at once. A script that does not end by itself is interrupted after a short time, and
//! one that cannot be interrupted ends with the process, which prints where it was.

use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::time::{Duration, Instant};

use super::watchdog::Watchdog;
use io::signals::{self, InterruptibleThread};
use script::{calls_begun, interrupt_running_code, place_of_interruption};

/// A call into a script that takes longer than this after the request is interrupted.
const INTERRUPT_TIMEOUT: Duration = Duration::from_millis(300);
/// The process ends when a call takes longer than this.
const EXIT_TIMEOUT: Duration = Duration::from_millis(700);
/// Interval between checks of the running call.
const POLL_INTERVAL: Duration = Duration::from_millis(25);
/// Time between interruptions, for what still has to run after the first one, such as `sysCall_cleanup`.
const INTERRUPT_INTERVAL: Duration = Duration::from_millis(150);

/// Set when the program shall end. Cheap to clone.
#[derive(Clone)]
pub(in crate::cli) struct Interrupt {
    requested: Arc<AtomicBool>,
    /// The number of the signal, or 0.
    signal: Arc<AtomicI32>,
    /// Where scripts run, unless somebody else watches them.
    scripts: Option<InterruptibleThread>,
}

impl Interrupt {
    /// Listens; `code` is the exit code after a second request.
    pub(in crate::cli) fn install(code: u8) -> Self {
        Self::listen(None, Some(code))
    }

    /// The same for scripts that run on this thread, which are interrupted.
    pub(in crate::cli) fn of_scripts_here() -> Self {
        Self::listen(
            Some(InterruptibleThread::current(interrupt_running_code)),
            None,
        )
    }

    /// Nobody listens: ctrl-c does what the system does by default.
    pub(in crate::cli) fn none() -> Self {
        Self {
            requested: Arc::default(),
            signal: Arc::default(),
            scripts: None,
        }
    }

    /// Watches the scripts that are interrupted. `is_told`: standard error is told of calls that take long.
    pub(in crate::cli) fn watchdog(&self, is_told: bool) -> Watchdog {
        self.scripts
            .map(|scripts| Watchdog::start(scripts, is_told))
            .unwrap_or_default()
    }

    fn listen(scripts: Option<InterruptibleThread>, code: Option<u8>) -> Self {
        let interrupt = Self {
            requested: Arc::default(),
            signal: Arc::default(),
            scripts,
        };
        let handler = interrupt.clone();
        let listening = ctrlc::set_handler(move || {
            if handler.is_requested() {
                std::process::exit(i32::from(code.unwrap_or_else(|| handler.exit_code())));
            }
            handler.request(signals::last_request());
        });
        match listening {
            Ok(()) => signals::note_requests(),
            // Then ctrl-c does what the system does by default.
            Err(error) => super::super::complain(&format!("cannot listen for ctrl-c: {error}")),
        }
        interrupt
    }

    /// Nobody reads standard output any more: a clean end without messages.
    pub(in crate::cli) fn request_quietly(&self) {
        if !self.is_requested() {
            self.request(signals::CLOSED_PIPE);
        }
    }

    fn request(&self, signal: i32) {
        self.signal.store(signal, Ordering::Relaxed);
        self.requested.store(true, Ordering::Relaxed);
        if let Some(scripts) = self.scripts {
            let interrupt = self.clone();
            // Without a thread, a second request is what ends a script.
            let _ = std::thread::Builder::new().spawn(move || interrupt.watch(scripts));
        }
    }

    /// Interrupts scripts that go on, until the process ends.
    fn watch(&self, scripts: InterruptibleThread) -> ! {
        let (mut calls, mut begun) = (calls_begun(), Instant::now());
        let mut due = INTERRUPT_TIMEOUT;
        loop {
            std::thread::sleep(POLL_INTERVAL);
            if calls_begun() != calls {
                (calls, begun, due) = (calls_begun(), Instant::now(), INTERRUPT_TIMEOUT);
            }
            if begun.elapsed() > EXIT_TIMEOUT {
                self.end_at_once();
            }
            if begun.elapsed() > due {
                scripts.wake();
                due += INTERRUPT_INTERVAL;
            }
        }
    }

    fn end_at_once(&self) -> ! {
        if !self.is_quiet() {
            let place = place_of_interruption();
            super::super::complain(&match place {
                Some(place) => format!("ended in the middle of a script, at {place}"),
                None => "ended in the middle of a script".into(),
            });
        }
        std::process::exit(i32::from(self.exit_code()));
    }

    /// Becomes true on the first request.
    pub(in crate::cli) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.requested)
    }

    pub(in crate::cli) fn is_requested(&self) -> bool {
        self.requested.load(Ordering::Relaxed)
    }

    /// Whether nobody is left to read what the program says.
    pub(in crate::cli) fn is_quiet(&self) -> bool {
        self.signal.load(Ordering::Relaxed) == signals::CLOSED_PIPE
    }

    /// The exit code that shells expect after the signal.
    pub(in crate::cli) fn exit_code(&self) -> u8 {
        let signal = self.signal.load(Ordering::Relaxed);
        u8::try_from(128 + signal).unwrap_or(u8::MAX)
    }

    /// How a program ends that goes on until somebody ends it: well, unless it was by a signal.
    pub(in crate::cli) fn outcome(&self) -> ExitCode {
        if self.is_requested() {
            return ExitCode::from(self.exit_code());
        }
        ExitCode::SUCCESS
    }
}
