//! The loop of a simulator that is controlled by remote clients, pages of the viewer, or its own scripts.

use std::process::ExitCode;
use std::time::Duration;

use super::END;
use super::interrupt::Interrupt;
use simulator::{RunLimits, RunTotals, SimulationState, Simulator};
use view::{ReplayedRequests, Viewer};

/// Longest wait for a request before an idle loop iteration.
const POLL_INTERVAL: Duration = Duration::from_millis(50);
/// The same while a viewer shows what scripts do: about 60 frames per second.
const FRAME_INTERVAL: Duration = Duration::from_millis(16);
/// The same while a real-time step is due soon, or while scripts poll their own sockets.
const SHORT_POLL_INTERVAL: Duration = Duration::from_millis(1);

/// A simulator's loop, with a viewer or without.
pub(in crate::cli) struct Live {
    viewer: Option<Viewer>,
    replayed: ReplayedRequests,
}

impl Live {
    pub(in crate::cli) fn new(viewer: Option<Viewer>) -> Self {
        Self {
            viewer,
            replayed: ReplayedRequests::default(),
        }
    }

    /// Iterates until ctrl-c, SIGTERM or `quitSimulator()`, then ends the simulation and closes the scene. The exit code says which.
    pub(in crate::cli) fn run(mut self, sim: &mut Simulator, interrupt: &Interrupt) -> ExitCode {
        let wants_end = |sim: &Simulator| sim.tape().signal(END, || interrupt.is_requested());
        while !wants_end(sim) && !sim.quit_requested() {
            self.iterate(sim);
        }
        sim.stop();
        sim.clear_scene();
        interrupt.outcome()
    }

    /// One loop iteration, then a rest until there is something to do.
    pub(in crate::cli) fn iterate(&mut self, sim: &mut Simulator) {
        if let Some(viewer) = self.viewer.as_mut().filter(|viewer| viewer.is_held()) {
            return viewer.attend(sim, FRAME_INTERVAL);
        }
        let steps = sim.steps();
        sim.iterate();
        let timeout = if !sim.state().is_advancing() {
            let idle = if self.viewer.is_some() {
                FRAME_INTERVAL
            } else {
                POLL_INTERVAL
            };
            if sim.has_zmq_sockets() {
                SHORT_POLL_INTERVAL
            } else {
                idle
            }
        } else if sim.steps() == steps {
            SHORT_POLL_INTERVAL
        } else {
            Duration::ZERO
        };
        self.rest(sim, timeout);
    }

    fn rest(&mut self, sim: &mut Simulator, timeout: Duration) {
        if sim.tape().is_replaying() {
            return self.replayed.perform(sim);
        }
        let has_rested = !timeout.is_zero() && sim.wait_for_request(timeout);
        let rest = if has_rested { Duration::ZERO } else { timeout };
        match &mut self.viewer {
            Some(viewer) => viewer.attend(sim, rest),
            None if !rest.is_zero() => std::thread::sleep(rest),
            None => {}
        }
    }
}

/// The loop of a run whose simulation pages of the viewer may pause and resume as long as they like.
#[derive(Clone)]
pub(in crate::cli) struct Viewed {
    limits: RunLimits,
    /// Iterations that are left; None for a simulation that runs to its end.
    left: Option<u64>,
    is_stopping: bool,
    totals: RunTotals,
}

impl Viewed {
    /// A run with these limits, or of so many `iterations`.
    pub(in crate::cli) fn new(limits: RunLimits, iterations: Option<u64>) -> Self {
        Self {
            limits,
            left: iterations,
            is_stopping: false,
            totals: RunTotals::default(),
        }
    }

    /// What has been run.
    pub(in crate::cli) fn totals(&self) -> RunTotals {
        self.totals
    }

    /// One iteration; false when the run was over before.
    pub(in crate::cli) fn iterate(
        &mut self,
        sim: &mut Simulator,
        live: &mut Live,
        has_interrupt: impl Fn() -> bool,
    ) -> bool {
        if sim.quit_requested() {
            return false;
        }
        let wants_end = sim.tape().signal(END, has_interrupt);
        let is_over = match self.left {
            Some(left) => left == 0 || wants_end,
            None => sim.state() == SimulationState::Stopped,
        };
        if is_over {
            return false;
        }
        if !self.is_stopping && (wants_end || self.limits.are_reached(sim)) {
            self.is_stopping = true;
            sim.request_stop();
        }
        let (steps, time) = (sim.steps(), sim.time());
        live.iterate(sim);
        self.left = self.left.map(|left| left - 1);
        self.totals.steps += sim.steps().saturating_sub(steps);
        self.totals.time += (sim.time() - time).max(0.0);
        true
    }
}
