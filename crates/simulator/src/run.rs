//! A whole run: loop iterations until scripts, a limit or the caller ends it.

use super::{Error, Simulator};
use script::SimulationState;

/// How a run comes to its end, unless a script ends it.
#[derive(Debug, Clone, Copy, Default)]
pub struct RunLimits {
    /// Simulation steps.
    pub steps: Option<u64>,
    /// Simulated time, seconds.
    pub time: Option<f64>,
    /// Loop iterations of a paused simulation before it is stopped.
    pub idle: u64,
    /// A simulation restarted by a script is another run; this one is over.
    pub once: bool,
}

/// Result of a run, including simulations restarted by scripts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RunTotals {
    /// Simulation steps.
    pub steps: u64,
    /// Simulated time, seconds.
    pub time: f64,
}

/// Observes a run, and may end it.
pub trait RunObserver {
    /// Whether the run is to end now.
    fn should_stop(&self, sim: &Simulator) -> bool;

    /// A loop iteration of an advancing simulation is over; it may have been too early for a step.
    fn iterated(&mut self, sim: &Simulator, stepped: bool) {
        let _ = (sim, stepped);
    }

    /// The simulation will be stopped, because it was paused for too long.
    fn stops_paused(&mut self, sim: &Simulator) {
        let _ = sim;
    }
}

impl RunLimits {
    /// Whether a run of that simulator is as long as it may be.
    pub fn are_reached(self, sim: &Simulator) -> bool {
        // Time is a sum of steps; it may fall short of a round number by its rounding errors.
        let late = |limit: f64| sim.time() * (1.0 + 1e-12) >= limit;
        self.steps.is_some_and(|limit| sim.steps() >= limit) || self.time.is_some_and(late)
    }
}

/// A run of a simulator, iteration by iteration. A copy of it goes on where the simulator was brought back to.
#[derive(Debug, Clone)]
pub struct Run {
    limits: RunLimits,
    totals: RunTotals,
    idle: u64,
    is_stopping: bool,
    phase: Phase,
}

/// What comes next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    Simulation,
    /// One more loop iteration, as in CoppeliaSim when it is closed.
    Last,
    Over,
}

impl Run {
    /// Starts the simulation.
    pub fn begin(sim: &mut Simulator, limits: RunLimits) -> Self {
        sim.start();
        Self {
            limits,
            totals: RunTotals::default(),
            idle: 0,
            is_stopping: false,
            phase: Phase::Simulation,
        }
    }

    /// What has been run.
    pub fn totals(&self) -> RunTotals {
        self.totals
    }

    /// One loop iteration; false when the run was over before.
    pub fn iterate(&mut self, sim: &mut Simulator, observer: &mut dyn RunObserver) -> bool {
        if self.phase == Phase::Over {
            return false;
        }
        let goes_on = sim.state() != SimulationState::Stopped && !sim.quit_requested();
        if self.phase == Phase::Last || !goes_on {
            sim.iterate_watched(&mut self.totals, observer);
            self.phase = Phase::Over;
            return true;
        }
        self.stop_if_due(sim, observer);
        let steps = sim.steps();
        sim.iterate_watched(&mut self.totals, observer);
        // Fewer steps: a script has started the next run.
        if sim.steps() < steps && self.limits.once {
            self.phase = Phase::Over;
        } else if sim.steps() < steps && self.is_stopping {
            self.phase = Phase::Last;
        }
        true
    }

    /// Goes on to that simulated time, seconds; false when the run ends before.
    pub fn go_to(
        &mut self,
        sim: &mut Simulator,
        time: f64,
        observer: &mut dyn RunObserver,
    ) -> bool {
        let there = RunLimits {
            time: Some(time),
            ..RunLimits::default()
        };
        while !there.are_reached(sim) || sim.state() == SimulationState::Stopped {
            if !self.iterate(sim, observer) {
                return false;
            }
        }
        !self.is_stopping
    }

    /// Goes on to the end.
    pub fn finish(mut self, sim: &mut Simulator, observer: &mut dyn RunObserver) -> RunTotals {
        while self.iterate(sim, observer) {}
        self.totals
    }

    fn stop_if_due(&mut self, sim: &mut Simulator, observer: &mut dyn RunObserver) {
        self.idle += u64::from(sim.state() == SimulationState::Paused);
        if self.is_stopping || self.limits.are_reached(sim) || observer.should_stop(sim) {
            self.is_stopping = true;
            sim.request_stop();
        } else if self.idle > self.limits.idle {
            observer.stops_paused(sim);
            sim.request_stop();
            self.idle = 0;
        }
    }
}

impl Simulator {
    /// All random numbers begin again as with this seed, which also holds for scripts to come. Those of scripts in Python begin with the
    /// script only.
    ///
    /// # Errors
    /// When the generator of a script refuses.
    pub fn set_seed(&mut self, seed: u32) -> Result<(), Error> {
        self.copied(|sim| sim.set_seed(seed).map_err(|error| error.text))
            .map_err(Error::Script)
    }

    /// Starts the simulation and runs it to its end; one more loop iteration follows, as in CoppeliaSim when it is closed.
    pub fn run(&mut self, limits: RunLimits, observer: &mut dyn RunObserver) -> RunTotals {
        Run::begin(self, limits).finish(self, observer)
    }

    /// That many loop iterations, in whatever state the scripts bring the simulation into.
    pub fn loop_freely(&mut self, iterations: u64, observer: &mut dyn RunObserver) -> RunTotals {
        let mut totals = RunTotals::default();
        for _ in 0..iterations {
            if self.quit_requested() || observer.should_stop(self) {
                break;
            }
            self.iterate_watched(&mut totals, observer);
        }
        totals
    }

    fn iterate_watched(&mut self, totals: &mut RunTotals, observer: &mut dyn RunObserver) {
        let (state, steps, time) = (self.state(), self.steps(), self.time());
        self.iterate();
        if state.is_advancing() {
            totals.steps += self.steps().saturating_sub(steps);
            totals.time += (self.time() - time).max(0.0);
            observer.iterated(self, self.steps() != steps);
        }
    }
}
