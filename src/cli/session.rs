//! The loop of `swanilda run`: passes until a script, a limit or ctrl-c ends the run.

use std::time::Duration;

use super::interrupt::Interrupt;
use super::output::Output;
use super::progress::Progress;
use crate::{SimulationState, Simulator};

/// How long to sleep between two looks at the wall clock in real-time mode.
const REAL_TIME_NAP: Duration = Duration::from_millis(1);

/// When the end is asked for from outside.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Passes of the main script.
    pub steps: Option<u64>,
    /// Simulated time, seconds.
    pub time: Option<f64>,
}

impl Limits {
    /// Whether the end of the run is known.
    pub(super) fn are_set(self) -> bool {
        self.steps.is_some() || self.time.is_some()
    }

    fn are_reached(self, sim: &Simulator) -> bool {
        // Time is a sum of steps; it may fall short of a round number by its rounding errors.
        let late = |limit: f64| sim.time() * (1.0 + 1e-12) >= limit;
        self.steps.is_some_and(|limit| sim.steps() >= limit) || self.time.is_some_and(late)
    }
}

/// One use of a simulator from the command line.
pub(super) struct Session<'a> {
    sim: &'a mut Simulator,
    limits: Limits,
    /// Passes the simulator may idle.
    loops: u64,
    interrupt: &'a Interrupt,
    progress: Progress,
    output: &'a Output,
    steps: u64,
    time: f64,
}

impl<'a> Session<'a> {
    pub(super) fn new(
        sim: &'a mut Simulator,
        limits: Limits,
        loops: u64,
        interrupt: &'a Interrupt,
        progress: Progress,
        output: &'a Output,
    ) -> Self {
        Self { sim, limits, loops, interrupt, progress, output, steps: 0, time: 0.0 }
    }

    /// Starts the simulation and runs it to its end.
    pub(super) fn run_simulation(&mut self) {
        self.sim.start();
        let mut idle = 0;
        let mut asked = false;
        while self.is_on() {
            if self.sim.state() == SimulationState::Paused {
                idle += 1;
            }
            if asked || self.limits.are_reached(self.sim) || self.interrupt.is_requested() {
                asked = true;
                self.sim.request_stop();
            } else if idle > self.loops {
                self.output.note("The simulation is paused and nobody resumes it: it is stopped.", self.sim.time());
                self.sim.request_stop();
                idle = 0;
            }
            let steps = self.sim.steps();
            self.pass();
            if asked && self.sim.steps() < steps {
                // A script has started the next run; the one that was asked for is over.
                break;
            }
        }
        self.pass();
        self.progress.finish();
    }

    /// Passes in whatever state the scripts bring the simulation into.
    pub(super) fn loop_freely(&mut self) {
        for _ in 0..self.loops {
            if self.sim.quit_requested() || self.interrupt.is_requested() {
                break;
            }
            self.pass();
        }
        if self.interrupt.is_requested() {
            self.sim.stop();
        }
    }

    fn is_on(&self) -> bool {
        self.sim.state() != SimulationState::Stopped && !self.sim.quit_requested()
    }

    fn pass(&mut self) {
        let before = (self.sim.state(), self.sim.steps(), self.sim.time());
        self.sim.pass();
        if before.0.is_advancing() {
            if self.sim.steps() == before.1 {
                self.rest();
            }
            self.steps += self.sim.steps().saturating_sub(before.1);
            self.time += (self.sim.time() - before.2).max(0.0);
            self.progress.show(self.sim);
        }
    }

    /// Rests after a pass without a step: the next one is not due yet, or somebody outside holds it up.
    fn rest(&self) {
        if !self.sim.wait_for_request(REAL_TIME_NAP) && self.sim.scene().settings().real_time {
            std::thread::sleep(REAL_TIME_NAP);
        }
    }

    /// Steps made and seconds simulated, over all runs of the session.
    pub(super) fn totals(&self) -> (u64, f64) {
        (self.steps, self.time)
    }
}
