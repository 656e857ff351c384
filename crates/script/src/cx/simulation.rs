//! The simulation: its clock, its course, and its settings with rules.

use std::cell::Ref;

use super::Cx;
use crate::clock::Clock;
use crate::error::ApiResult;
use dynamics::Dynamics;
use scene::Handle;
use scene::parameters::engine::SelectedEngine;

impl Cx<'_> {
    /// State and time of the simulation.
    pub fn clock(&self) -> &Clock {
        &self.sim.clock
    }

    /// The hash of what scripts can observe now.
    pub fn state_hash(&self) -> u64 {
        self.sim.state_hash()
    }

    /// Starts a stopped simulation or resumes a paused one; otherwise nothing.
    pub fn start_simulation(&mut self) {
        self.sim.start();
    }

    /// Asks for a pause; refused when not running or when a stop is pending.
    pub fn pause_simulation(&mut self) {
        self.sim.clock.request_pause();
    }

    /// Asks for the end of the simulation; a paused one resumes for its last steps.
    pub fn stop_simulation(&mut self) {
        self.sim.stop();
    }

    /// Asks for the end of the program, or withdraws that.
    pub fn request_quit(&mut self, on: bool) {
        self.sim.clock.set_quit_requested(on);
    }

    /// One iteration of the application's loop.
    pub fn run_loop_iteration(&mut self) {
        self.sim.loop_iteration();
    }

    /// Whether a simulation in real-time mode has to step now to keep up with the clock.
    pub fn real_time_step_is_due(&self) -> bool {
        let is_real_time = self.sim.scene.borrow().settings().real_time;
        is_real_time && self.sim.clock.state().is_advancing() && self.sim.step_is_due()
    }

    /// The physics; None during a sub-step.
    pub fn dynamics(&self) -> Option<Ref<'_, Dynamics>> {
        Ref::filter_map(self.sim.dynamics.borrow(), Option::as_ref).ok()
    }

    /// Advances the physics by `time_step` seconds; returns the number of sub-steps.
    ///
    /// # Errors
    /// While the physics steps already.
    pub fn handle_dynamics(&mut self, time_step: f64) -> ApiResult<i64> {
        self.sim.handle_dynamics(time_step)
    }

    /// One step of every joint that is on its way to a target.
    pub fn handle_joint_motion(&mut self) {
        self.sim.handle_joint_motion();
    }

    /// Moves a joint on its way to a target by `dt` seconds, without asking scripts.
    ///
    /// # Errors
    /// When there is no such joint.
    pub fn follow_profile(&mut self, joint: Handle, dt: f64) -> ApiResult<()> {
        Ok(self.sim.follow_profile(joint, dt)?)
    }

    /// Chooses the engine whose parameters count, and its version. Without effect while the simulation is not stopped.
    ///
    /// # Errors
    /// When there is no such engine.
    pub fn set_engine(&mut self, number: i64, version: i64) -> ApiResult<()> {
        let engine = SelectedEngine::from_numbers(number, version)?;
        self.sim
            .change_while_stopped(|settings| settings.dynamics.engine = engine);
        Ok(())
    }

    /// Sets the desired sub-step of the physics, seconds. Without effect while the simulation is not stopped.
    pub fn set_physics_step(&mut self, step: f64) {
        self.sim
            .change_while_stopped(|settings| settings.set_physics_step(step));
    }
}
