//! Ctrl-c while a script runs that does not end by itself.
//!
//! Python notes signals, and raises `KeyboardInterrupt` when its main thread returns to it. A call into the simulator that takes longer is
//! ended here: a thread is notified of each ctrl-c beside Python, waits for a delay, and then interrupts the script on the main thread.

use std::cell::Cell;
use std::sync::Once;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::thread;
use std::time::Duration;

use io::signals::{INTERRUPT, InterruptibleThread};
use pyo3::marker::Ungil;
use pyo3::prelude::*;
use script::interrupt_running_code;
use signal_hook::iterator::Signals;

/// Delay between ctrl-c and the first interruption of the script: most calls have ended by then.
const DELAY: Duration = Duration::from_millis(300);
/// Time between interruptions, for scripts that catch the first one.
const INTERVAL: Duration = Duration::from_millis(150);

/// The number of the main thread's present call into simulators where it is odd; even between calls.
static CALLS: AtomicU64 = AtomicU64::new(0);
static WATCHES: Once = Once::new();

thread_local! {
    /// Calls that this thread is in, one inside of the other, where it is the one that is watched.
    static DEPTH: Cell<Option<u32>> = const { Cell::new(None) };
}

/// Calls into a simulator, which ctrl-c ends; other threads of Python run meanwhile.
pub fn detached<T: Ungil>(py: Python<'_>, work: impl Ungil + FnOnce() -> T) -> T {
    let _call = Call::begin();
    py.detach(work)
}

/// A call into a simulator, until it is dropped.
struct Call(());

impl Call {
    fn begin() -> Self {
        if let Some(depth) = DEPTH.get() {
            CALLS.fetch_add(u64::from(depth == 0), Relaxed);
            DEPTH.set(Some(depth + 1));
        }
        Self(())
    }
}

impl Drop for Call {
    fn drop(&mut self) {
        if let Some(depth) = DEPTH.get() {
            CALLS.fetch_add(u64::from(depth == 1), Relaxed);
            DEPTH.set(Some(depth - 1));
        }
    }
}

/// From now on ctrl-c ends scripts of this thread, if it is Python's main one, which signals are for, and Python handles them.
pub fn watch(py: Python<'_>) -> PyResult<()> {
    if WATCHES.is_completed() {
        return Ok(());
    }
    let threading = py.import("threading")?;
    let main = threading.call_method0("main_thread")?.getattr("ident")?;
    let signal = py.import("signal")?;
    let handler = signal.call_method1("getsignal", (INTERRUPT,))?;
    if !handler.is_callable() || !main.eq(threading.call_method0("get_ident")?)? {
        return Ok(());
    }
    WATCHES.call_once(|| {
        // Without a thread, ctrl-c waits for the end of the call.
        if let Ok(mut signals) = Signals::new([INTERRUPT]) {
            DEPTH.set(Some(0));
            let scripts = InterruptibleThread::current(interrupt_running_code);
            let watch = move || signals.forever().for_each(|_| interrupt(scripts));
            let _ = thread::Builder::new().name("ctrl-c".into()).spawn(watch);
        }
    });
    Ok(())
}

/// Interrupts scripts until the present call is over, if there is one.
#[expect(
    clippy::disallowed_methods,
    reason = "on a thread of its own, after ctrl-c"
)]
fn interrupt(scripts: InterruptibleThread) {
    let call = CALLS.load(Relaxed);
    thread::sleep(DELAY);
    while call % 2 == 1 && CALLS.load(Relaxed) == call {
        scripts.wake();
        thread::sleep(INTERVAL);
    }
}
