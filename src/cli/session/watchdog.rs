//! Watches for scripts that do not end: the log and the pages say which callback runs, and where.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::super::complain;
use io::signals::InterruptibleThread;
use script::{
    ask_running_code, calls_begun, is_call, only_ask, place_is_exact, place_of_interruption,
    running_callback,
};
use view::BusySign;

/// A call that takes longer is reported.
const FIRST_REPORT: Duration = Duration::from_secs(3);
/// Each further report of a call comes after this many times as long.
const NEXT_REPORT: u32 = 10;
/// Interval between checks.
const POLL_INTERVAL: Duration = Duration::from_millis(200);
/// For so long is measured whether a thread computes.
const SAMPLE: Duration = Duration::from_millis(50);
/// Longest wait for a thread that is asked where it is.
const PLACE_TIMEOUT: Duration = Duration::from_millis(100);

/// Where reports go, besides standard error.
#[derive(Clone, Default)]
pub(in crate::cli) struct Watchdog {
    sign: Arc<Mutex<Option<BusySign>>>,
    /// Whether standard error is told.
    is_told: bool,
}

impl Watchdog {
    /// Watches the scripts of a thread as long as the process lives. Without a thread of its own, nothing is reported.
    pub(in crate::cli) fn start(scripts: InterruptibleThread, is_told: bool) -> Self {
        let watchdog = Self {
            is_told,
            ..Self::default()
        };
        let watching = watchdog.clone();
        let _ = std::thread::Builder::new().spawn(move || watching.watch(scripts));
        watchdog
    }

    /// Reports to the pages of a viewer as well.
    pub(in crate::cli) fn show_on(&self, sign: BusySign) {
        *self.sign.lock().unwrap_or_else(PoisonError::into_inner) = Some(sign);
    }

    fn watch(&self, scripts: InterruptibleThread) -> ! {
        let mut call = Call::now();
        loop {
            std::thread::sleep(POLL_INTERVAL);
            let sign = self
                .sign
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .clone();
            let waits_for_person = sign.as_ref().is_some_and(BusySign::is_asking);
            if calls_begun() != call.number || waits_for_person {
                call = Call::now();
            } else if is_call(call.number) && sign.as_ref().is_some_and(BusySign::wants_attention) {
                // Code that goes on for long lets the debugger answer in its midst.
                ask_running_code();
                scripts.wake();
            }
            call.check(scripts, sign.as_ref(), self.is_told);
        }
    }
}

/// The call that was in progress when the watchdog last looked, if there was one.
struct Call {
    number: u64,
    seen: Instant,
    report_due: Duration,
    sentence: Option<String>,
}

impl Call {
    fn now() -> Self {
        Self {
            number: calls_begun(),
            seen: Instant::now(),
            report_due: FIRST_REPORT,
            sentence: None,
        }
    }

    /// Reports it when it is time, and ends it when a page wants that.
    fn check(&mut self, scripts: InterruptibleThread, sign: Option<&BusySign>, is_told: bool) {
        if is_call(self.number) && self.seen.elapsed() >= self.report_due {
            self.report(scripts, is_told);
        }
        let Some(sign) = sign else {
            return;
        };
        sign.show(
            self.sentence
                .as_ref()
                .map(|what| format!("{what}. Stop ends it.")),
        );
        if self.sentence.is_some() && sign.stop_is_requested() {
            scripts.wake();
        }
    }

    fn report(&mut self, scripts: InterruptibleThread, is_told: bool) {
        let seconds = self.report_due.as_secs();
        self.report_due *= NEXT_REPORT;
        let callback = running_callback().map_or("A script", |call| call.name());
        // A thread that waits in the system is left alone: what it waits for would return an error.
        if !is_computing(scripts) {
            self.sentence = Some(format!("{callback} has been waiting for {seconds} s"));
            return;
        }
        let place = place(scripts).map_or_else(
            || ", in a function that is not written in Lua".to_owned(),
            |place| format!(", at {place}"),
        );
        let sentence = format!("{callback} has been running for {seconds} s{place}");
        if is_told {
            complain(&format!("{sentence}; ctrl-c ends it"));
        }
        self.sentence = Some(sentence);
    }
}

/// Whether a thread uses the processor, rather than that it waits for something; measured for a moment.
fn is_computing(thread: InterruptibleThread) -> bool {
    let Some(before) = thread.processor_time() else {
        return true;
    };
    std::thread::sleep(SAMPLE);
    thread
        .processor_time()
        .is_none_or(|after| after.saturating_sub(before) > SAMPLE / 20)
}

/// Where the code of a thread is.
fn place(scripts: InterruptibleThread) -> Option<String> {
    only_ask();
    scripts.wake();
    let asked = Instant::now();
    while !place_is_exact() && asked.elapsed() < PLACE_TIMEOUT {
        std::thread::sleep(Duration::from_millis(1));
    }
    // Lua names texts of scripts so: `[string "/robot/script"]`.
    let place = place_of_interruption().filter(|_| place_is_exact());
    place.map(|place| place.replace("[string \"", "").replace("\"]", ""))
}
