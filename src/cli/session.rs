//! What `swanilda run` does while a simulation runs: it shows progress, rests, and listens for ctrl-c.

use std::time::Duration;

use super::interrupt::Interrupt;
use super::output::Output;
use super::progress::Progress;
use crate::{Onlooker, Simulator};

/// How long to sleep between two looks at the wall clock in real-time mode.
const REAL_TIME_NAP: Duration = Duration::from_millis(1);

/// The command line as it looks on.
pub(super) struct Session<'a> {
    pub interrupt: &'a Interrupt,
    pub progress: Progress,
    pub output: &'a Output,
}

impl Onlooker for Session<'_> {
    fn wants_end(&self, _: &Simulator) -> bool {
        self.interrupt.is_requested()
    }

    fn passed(&mut self, sim: &Simulator, stepped: bool) {
        if !stepped {
            rest(sim);
        }
        self.progress.show(sim);
    }

    fn gives_up(&mut self, sim: &Simulator) {
        self.output.note("The simulation is paused and nobody resumes it: it is stopped.", sim.time());
    }
}

/// Rests after a pass without a step: the next one is not due yet, or somebody outside holds it up.
fn rest(sim: &Simulator) {
    if !sim.wait_for_request(REAL_TIME_NAP) && sim.scene().settings().real_time {
        std::thread::sleep(REAL_TIME_NAP);
    }
}
