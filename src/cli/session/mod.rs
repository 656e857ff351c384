//! The loop of `swanilda run` during a simulation: shows progress, waits for real time, and listens for ctrl-c.

pub(super) mod capture;
pub(super) mod debugging;
pub(super) mod fallen;
pub(super) mod graphs;
pub(super) mod hashes;
pub(super) mod interrupt;
pub(super) mod launch;
pub(super) mod live;
pub(super) mod output;
pub(super) mod permissions;
pub(super) mod progress;
pub(super) mod recording;
pub(super) mod resources;
pub(super) mod ros;
pub(super) mod setup;
pub(super) mod video;
pub(super) mod watchdog;

use std::time::{Duration, Instant};

use fallen::Fallen;
use hashes::Hashes;
use interrupt::Interrupt;
use output::Output;
use progress::Progress;

use simulator::{RunObserver, Simulator};

/// Interval between polls of the wall clock in real-time mode.
const REAL_TIME_POLL_INTERVAL: Duration = Duration::from_millis(1);

/// Wall time after which a run without an end mentions that.
const REMINDER_DELAY: Duration = Duration::from_secs(2);

/// What a request to end the program is called in a capture.
pub(super) const END: &str = "a request to end the program";

/// The command line as an observer of the run.
pub(super) struct Session<'a> {
    pub interrupt: &'a Interrupt,
    pub progress: Progress,
    pub output: &'a Output,
    pub reminder: Reminder,
    pub fallen: Fallen,
    pub hashes: Hashes,
}

/// Says once how to end a run that has no end of its own.
pub(super) struct Reminder {
    /// None when nothing is left to say.
    begun: Option<Instant>,
}

impl Reminder {
    /// A run that `has_end` needs none.
    pub(super) fn new(has_end: bool) -> Self {
        Self {
            begun: (!has_end).then(Instant::now),
        }
    }

    fn remind(&mut self, output: &Output, time: f64) {
        if self
            .begun
            .is_some_and(|begun| begun.elapsed() > REMINDER_DELAY)
        {
            self.begun = None;
            output.note(
                "This run has no end so far: ctrl-c stops it, --time and --steps limit it.",
                time,
            );
        }
    }
}

impl RunObserver for Session<'_> {
    fn should_stop(&self, sim: &Simulator) -> bool {
        let wants_end = || {
            self.interrupt.is_requested()
                || sim.video_failure().is_some()
                || self.hashes.end_the_run()
        };
        sim.tape().signal(END, wants_end)
    }

    fn iterated(&mut self, sim: &Simulator, stepped: bool) {
        if !stepped {
            rest(sim);
        }
        if stepped {
            self.hashes.observe(sim, self.progress.is_at_end(sim));
        }
        if stepped && let Some(text) = self.fallen.observe(sim) {
            self.output.note(&text, sim.time());
        }
        self.progress.show(sim);
        self.reminder.remind(self.output, sim.time());
    }

    fn stops_paused(&mut self, sim: &Simulator) {
        self.output.stops_paused(sim.time());
    }
}

/// Sleeps after a loop iteration without a step: the next step is not due yet, or a remote client delays it.
pub(super) fn rest(sim: &Simulator) {
    if sim.tape().is_replaying() {
        return;
    }
    if !sim.wait_for_request(REAL_TIME_POLL_INTERVAL) && sim.scene().settings().real_time {
        std::thread::sleep(REAL_TIME_POLL_INTERVAL);
    }
}
