//! Simulation time and the seven states of a run (SPEC-7).

use std::cell::Cell;

/// The state of the simulation; numbers are `sim.simulation_*` of 4.10.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SimulationState {
    Stopped = 0x00,
    Paused = 0x08,
    FirstAfterStop = 0x10,
    Running = 0x11,
    LastBeforePause = 0x13,
    FirstAfterPause = 0x14,
    AboutToStop = 0x15,
    LastBeforeStop = 0x16,
}

impl SimulationState {
    /// Whether passes of the main script run.
    pub fn is_advancing(self) -> bool {
        self as i64 & 0x10 != 0
    }

    /// What `sim.getSimulationStopping` tells.
    pub fn is_stopping(self) -> bool {
        matches!(self, Self::Stopped | Self::AboutToStop | Self::LastBeforeStop)
    }
}

/// Time and requests.
pub(crate) struct Clock {
    pub state: Cell<SimulationState>,
    /// Seconds since the start, by repeated addition of the step.
    pub time: Cell<f64>,
    pub steps: Cell<u64>,
    pub stop_requested: Cell<bool>,
    pub pause_requested: Cell<bool>,
    /// The pause at a set time happens once per run.
    pub paused_at_time: Cell<bool>,
    /// True while scripts are told that the simulation is about to start.
    pub starting: Cell<bool>,
    /// Wall-clock seconds at which a run in real time had simulation time zero.
    pub real_time_origin: Cell<f64>,
}

impl Clock {
    pub(crate) fn new() -> Self {
        Self {
            state: Cell::new(SimulationState::Stopped),
            time: Cell::new(0.0),
            steps: Cell::new(0),
            stop_requested: Cell::new(false),
            pause_requested: Cell::new(false),
            paused_at_time: Cell::new(false),
            starting: Cell::new(false),
            real_time_origin: Cell::new(0.0),
        }
    }

    /// Back to time zero, for a start.
    pub(crate) fn reset(&self) {
        self.time.set(0.0);
        self.steps.set(0);
        self.stop_requested.set(false);
        self.pause_requested.set(false);
        self.paused_at_time.set(false);
        self.state.set(SimulationState::FirstAfterStop);
    }

    /// Whether the next step of `dt` seconds is due in real time, `wall` scaled seconds after the simulator was made. Being late is
    /// forgiven except for one step.
    pub(crate) fn is_due(&self, wall: f64, dt: f64) -> bool {
        let latest_origin = wall - self.time.get() - 2.0 * dt;
        self.real_time_origin.set(self.real_time_origin.get().max(latest_origin));
        self.time.get() + dt < wall - self.real_time_origin.get()
    }

    /// The state after a pass (SPEC-7 7.2). `LastBeforeStop` stays: the caller runs the end procedure. A stop beats a pause.
    pub(crate) fn state_after_pass(&self) -> SimulationState {
        use SimulationState as S;
        match self.state.get() {
            S::FirstAfterStop | S::FirstAfterPause => S::Running,
            S::Running if self.stop_requested.get() => S::AboutToStop,
            S::Running if self.pause_requested.take() => S::LastBeforePause,
            S::AboutToStop => S::LastBeforeStop,
            S::LastBeforePause => S::Paused,
            same => same,
        }
    }
}
