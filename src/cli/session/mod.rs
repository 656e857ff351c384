//! What `swanilda run` does while a simulation runs: it shows progress, rests, and listens for ctrl-c.

pub(super) mod interrupt;
pub(super) mod output;
pub(super) mod permissions;
pub(super) mod progress;
pub(super) mod setup;

use std::time::Duration;

use interrupt::Interrupt;
use output::Output;
use progress::Progress;

use crate::{Onlooker, Simulator};

/// Sleep between polls of the wall clock in real-time mode.
const REAL_TIME_NAP: Duration = Duration::from_millis(1);

/// The command line as an observer of the run.
pub(super) struct Session<'a> {
    pub interrupt: &'a Interrupt,
    pub progress: Progress,
    pub output: &'a Output,
}

impl Onlooker for Session<'_> {
    fn wants_end(&self, _: &Simulator) -> bool {
        self.interrupt.is_requested()
    }

    fn iterated(&mut self, sim: &Simulator, stepped: bool) {
        if !stepped {
            rest(sim);
        }
        self.progress.show(sim);
    }

    fn gives_up(&mut self, sim: &Simulator) {
        self.output.note("The simulation is paused and nobody resumes it: it is stopped.", sim.time());
    }
}

/// Sleeps after a loop iteration without a step: the next step is not due yet, or a remote client delays it.
fn rest(sim: &Simulator) {
    if !sim.wait_for_request(REAL_TIME_NAP) && sim.scene().settings().real_time {
        std::thread::sleep(REAL_TIME_NAP);
    }
}
