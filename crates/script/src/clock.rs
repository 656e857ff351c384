//! Simulation time and the seven states of a run (spec: simulation).

use std::cell::Cell;
use std::time::Instant;

use capture::Tape;

use crate::wall_clock;

/// The state of the simulation; numbers are `sim.simulation_*` of 4.10.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SimulationState {
    /// No simulation.
    Stopped = 0x00,
    /// The simulation is paused: no steps run.
    Paused = 0x08,
    /// The first step after the start.
    FirstAfterStop = 0x10,
    /// Any step in between.
    Running = 0x11,
    /// The last step before a pause.
    LastBeforePause = 0x13,
    /// The first step after a pause.
    FirstAfterPause = 0x14,
    /// The end was requested: the step before the last one.
    AboutToStop = 0x15,
    /// The last step before the end.
    LastBeforeStop = 0x16,
}

impl SimulationState {
    /// Whether simulation steps run.
    pub fn is_advancing(self) -> bool {
        self as i64 & 0x10 != 0
    }

    /// The result of `sim.getSimulationStopping`.
    pub fn is_stopping(self) -> bool {
        matches!(
            self,
            Self::Stopped | Self::AboutToStop | Self::LastBeforeStop
        )
    }
}

/// Time, state and pending requests. Readable by all; only the host changes it.
pub struct Clock {
    state: Cell<SimulationState>,
    /// Seconds since the start, by repeated addition of the step.
    time: Cell<f64>,
    steps: Cell<u64>,
    stop_requested: Cell<bool>,
    pause_requested: Cell<bool>,
    /// A viewer plays to this number of steps and pauses there at once.
    pause_at_step: Cell<Option<u64>>,
    /// The pause at a set time happens once per run.
    paused_at_time: Cell<bool>,
    /// True while scripts are notified that the simulation is about to start.
    starting: Cell<bool>,
    /// A script requested the end of the program.
    quit_requested: Cell<bool>,
    /// A client of the legacy remote API must allow the next step.
    waiting_for_trigger: Cell<bool>,
    /// Wall-clock seconds at which a run in real time had simulation time zero.
    real_time_origin: Cell<f64>,
    created: Instant,
    tape: Tape,
    /// Wall-clock seconds that did not count, since a debugger had stopped everything.
    stood_still: Cell<f64>,
}

impl Clock {
    /// Wall time comes by the tape.
    pub(crate) fn new(tape: &Tape) -> Self {
        Self {
            state: Cell::new(SimulationState::Stopped),
            time: Cell::new(0.0),
            steps: Cell::new(0),
            stop_requested: Cell::new(false),
            pause_requested: Cell::new(false),
            pause_at_step: Cell::new(None),
            paused_at_time: Cell::new(false),
            starting: Cell::new(false),
            quit_requested: Cell::new(false),
            waiting_for_trigger: Cell::new(false),
            real_time_origin: Cell::new(0.0),
            created: wall_clock::now(),
            tape: tape.clone(),
            stood_still: Cell::new(0.0),
        }
    }

    /// Whether the simulation is stopped, runs or is paused.
    pub fn state(&self) -> SimulationState {
        self.state.get()
    }

    /// Whether a simulation runs whose end was requested.
    pub fn is_ending(&self) -> bool {
        let state = self.state();
        state.is_advancing() && (self.stop_requested.get() || state.is_stopping())
    }

    /// Whether no simulation runs or is paused.
    pub fn is_stopped(&self) -> bool {
        self.state.get() == SimulationState::Stopped
    }

    /// Simulated seconds since the start.
    pub fn time(&self) -> f64 {
        self.time.get()
    }

    /// Simulation steps since the start.
    pub fn steps(&self) -> u64 {
        self.steps.get()
    }

    /// Seconds since this simulator was made, by the wall clock.
    pub fn wall_seconds(&self) -> f64 {
        let elapsed = || self.created.elapsed().as_secs_f64() - self.stood_still.get();
        self.tape.input("the clock", elapsed).unwrap_or_default()
    }

    /// Leaves out wall-clock seconds in which everything stood still.
    pub fn leave_out(&self, seconds: f64) {
        self.stood_still.set(self.stood_still.get() + seconds);
    }

    /// Whether the simulation was asked to end.
    pub fn stop_is_requested(&self) -> bool {
        self.stop_requested.get()
    }

    /// Whether a script asked for the end of the program.
    pub fn quit_is_requested(&self) -> bool {
        self.quit_requested.get()
    }

    /// Whether a client of the legacy remote API must allow the next step.
    pub fn is_waiting_for_trigger(&self) -> bool {
        self.waiting_for_trigger.get()
    }

    /// Only for the legacy remote API, which decides about that.
    pub fn set_waiting_for_trigger(&self, on: bool) {
        self.waiting_for_trigger.set(on);
    }

    pub(crate) fn set_state(&self, state: SimulationState) {
        self.state.set(state);
    }

    /// Asks for the end of the program, or withdraws that.
    pub fn set_quit_requested(&self, on: bool) {
        self.quit_requested.set(on);
    }

    /// A stop beats a pause that was requested before.
    pub(crate) fn request_stop(&self) {
        self.stop_requested.set(true);
        self.pause_requested.set(false);
    }

    /// The run goes on where only one step was missing to a pause.
    pub(crate) fn cancel_begun_pause(&self) {
        if self.state() == SimulationState::LastBeforePause {
            self.state.set(SimulationState::Running);
        }
    }

    /// The run goes on where a pause was asked for that has not come yet.
    pub(crate) fn cancel_pause(&self) {
        self.pause_requested.set(false);
        self.cancel_begun_pause();
    }

    /// Refused when not running or when a stop is requested.
    pub(crate) fn request_pause(&self) {
        if self.state().is_advancing() && !self.stop_requested.get() {
            self.pause_requested.set(true);
        }
    }

    /// Requests the pause at a set time, once per run.
    pub(crate) fn request_pause_at_time(&self) {
        if !self.paused_at_time.replace(true) {
            self.request_pause();
        }
    }

    /// The run pauses after that many more steps, without the last steps of a pause that a script asks for.
    pub(crate) fn pause_after(&self, steps: u64) {
        self.pause_at_step
            .set(Some(self.steps().saturating_add(steps)));
    }

    /// The run goes on where it would have paused.
    pub(crate) fn cancel_pause_after(&self) {
        self.pause_at_step.set(None);
    }

    /// Marks the beginning of the start procedure; false when it is in progress already.
    pub(crate) fn begin_start(&self) -> bool {
        !self.starting.replace(true)
    }

    pub(crate) fn end_start(&self) {
        self.starting.set(false);
    }

    /// Back to time zero, for a start.
    pub(crate) fn reset(&self) {
        self.time.set(0.0);
        self.steps.set(0);
        self.stop_requested.set(false);
        self.pause_requested.set(false);
        self.pause_at_step.set(None);
        self.paused_at_time.set(false);
        self.state.set(SimulationState::FirstAfterStop);
    }

    /// One simulation step of `dt` seconds is over.
    pub(crate) fn advance(&self, dt: f64) {
        self.time.set(self.time.get() + dt);
        self.steps.set(self.steps.get() + 1);
    }

    /// Real time continues from `wall` scaled seconds, ignoring the time while stopped or paused.
    pub(crate) fn restart_real_time(&self, wall: f64) {
        self.real_time_origin.set(wall - self.time.get());
    }

    /// Whether the next step of `dt` seconds is due in real time, `wall` scaled seconds after the simulator was made. Being late is
    /// forgiven except for one step.
    pub(crate) fn is_due(&self, wall: f64, dt: f64) -> bool {
        let latest_origin = wall - self.time.get() - 2.0 * dt;
        self.real_time_origin
            .set(self.real_time_origin.get().max(latest_origin));
        self.time.get() + dt < wall - self.real_time_origin.get()
    }

    /// The state after a step (spec: simulation 2). `LastBeforeStop` stays: the caller runs the end procedure. A stop beats a pause.
    pub(crate) fn state_after_step(&self) -> SimulationState {
        use SimulationState as S;
        let is_stopping = self.state().is_stopping() || self.stop_requested.get();
        if !is_stopping
            && self
                .pause_at_step
                .get()
                .is_some_and(|at| self.steps() >= at)
        {
            self.pause_at_step.set(None);
            self.pause_requested.set(false);
            return S::Paused;
        }
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
