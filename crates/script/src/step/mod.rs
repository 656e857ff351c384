//! The application's loop: idle iterations, simulation steps, start, pause and stop (spec: callbacks 2, spec: simulation).

mod calculation_objects;
pub(crate) mod dynamics;
mod hooks;
pub(crate) mod joint_motion;
mod proximity;
mod taped;

use std::rc::Rc;

use super::log::{status, verbosity};
use crate::clock::SimulationState;
use crate::host::{Script, ScriptGroup, Sim, state};
use crate::lifecycle::selection_data;
use crate::sys_call::SysCall;
use c_interface::Moment;
use scene::object::script_object::ScriptType;

impl Sim {
    /// One iteration of the application's loop: idle, paused or advancing.
    pub fn loop_iteration(self: &Rc<Self>) {
        self.notify_debugger(|debugger| {
            debugger.answer_requests(self, None);
        });
        self.options.permissions.tape().turn();
        self.notify_plugins_of_pass();
        self.run_hooks(|hooks| hooks.start_of_iteration);
        if !self.clock.state().is_advancing() {
            self.scene.borrow_mut().button_interfaces_mut().next_pass();
            self.dispatch_events();
        }
        match self.clock.state() {
            SimulationState::Stopped => self.broadcast(SysCall::NonSimulation, &[]),
            SimulationState::Paused => self.notify(SysCall::Suspended),
            _ => {}
        }
        self.notify_changed_data();
        self.notify_selection();
        if self.clock.state().is_advancing() {
            self.step_if_due();
        }
        self.remove_delayed();
        self.save_app_storage();
        self.deliver_ui_events();
        self.notify_debugger(|debugger| debugger.scene_changed(self, None));
    }

    fn step_if_due(self: &Rc<Self>) {
        if !self.step_is_due() || self.step_is_held() {
            self.broadcast(SysCall::RealTimeIdle, &[]);
        } else if !self.main_script_is_vetoed() {
            self.scene.borrow_mut().button_interfaces_mut().next_pass();
            self.simulation_step();
            self.run_hooks(|hooks| hooks.after_step);
            self.advance();
            self.options.permissions.tape().step(|| self.taped_hash());
            self.film();
            self.show_to_watcher();
        }
    }

    /// Always, except in real-time mode.
    pub(crate) fn step_is_due(&self) -> bool {
        let scene = self.scene.borrow();
        let settings = scene.settings();
        !settings.real_time
            || self.clock.is_due(
                self.clock.wall_seconds() * settings.real_time_factor,
                settings.time_step,
            )
    }

    fn notify_selection(self: &Rc<Self>) {
        let selection = self.scene.borrow().selection().to_vec();
        if self.scripts.note_selection(&selection) {
            let selection = selection_data(&self.scene.borrow());
            self.broadcast(SysCall::SelChange, &[selection]);
        }
    }

    /// One simulation step as the main script defines it.
    fn simulation_step(self: &Rc<Self>) {
        let Some(main) = self.scripts.detached(ScriptType::Main) else {
            return;
        };
        if self.clock.state() == SimulationState::FirstAfterStop {
            self.run_phase(&main, SysCall::Init, Moment::SimulationInit);
        }
        if main.base_state() != state::INITIALIZED {
            return;
        }
        self.run_phase(&main, SysCall::Actuation, Moment::SimulationActuation);
        self.dispatch_events();
        self.run_phase(&main, SysCall::Sensing, Moment::SimulationSensing);
        if self.clock.state() == SimulationState::LastBeforeStop {
            self.run_phase(&main, SysCall::Cleanup, Moment::SimulationCleanup);
        }
    }

    /// One callback of the main script, with a message to plugins before and after.
    fn run_phase(self: &Rc<Self>, main: &Rc<Script>, call: SysCall, moment: Moment) {
        let milliseconds = numbers::truncated_i32((self.clock.time() * 1000.0).round());
        self.notify_plugins(moment, [0, milliseconds, 0, 0]);
        self.deliver(main, call, &[]);
        self.notify_plugins(moment, [1, milliseconds, 0, 0]);
    }

    /// Completes a simulation step: time goes on and the state changes.
    fn advance(self: &Rc<Self>) {
        self.request_pause_at_time();
        let clock = &self.clock;
        clock.advance(self.scene.borrow().settings().time_step);
        if clock.state() == SimulationState::LastBeforeStop {
            return self.finish();
        }
        let next = clock.state_after_step();
        let pauses = next == SimulationState::Paused && clock.state() != next;
        clock.set_state(next);
        if pauses {
            if !self.main_script_failed() {
                self.notify(SysCall::Suspend);
            }
            self.log_status(status::PAUSED);
        }
    }

    fn request_pause_at_time(&self) {
        let scene = self.scene.borrow();
        let settings = scene.settings();
        if settings.pause_at_time && self.clock.time() >= settings.time_to_pause {
            self.clock.request_pause_at_time();
        }
    }

    fn main_script_failed(&self) -> bool {
        let main = self.scripts.detached(ScriptType::Main);
        main.is_some_and(|main| main.state() & state::ERROR != 0)
    }

    /// Suspend, suspended, resume: through the main script, or directly when it does not care.
    fn notify(self: &Rc<Self>, call: SysCall) {
        let handled = self
            .scripts
            .detached(ScriptType::Main)
            .is_some_and(|main| self.deliver(&main, call, &[]).ran);
        if !handled {
            self.deliver_to_embedded(call, &[]);
            self.deliver_to(ScriptGroup::AddOn, call, &[]);
            self.deliver_to(ScriptGroup::Sandbox, call, &[]);
        }
    }

    /// Starts a stopped simulation or resumes a paused one; otherwise nothing.
    pub fn start(self: &Rc<Self>) {
        match self.clock.state() {
            SimulationState::Stopped if self.clock.begin_start() => {
                self.begin();
                self.clock.end_start();
            }
            SimulationState::Paused => self.resume(),
            _ => {}
        }
    }

    /// The start procedure (spec: simulation 4).
    fn begin(self: &Rc<Self>) {
        self.notify_plugins(Moment::SimulationAboutToStart, [0; 4]);
        for group in [
            ScriptGroup::Customization,
            ScriptGroup::AddOn,
            ScriptGroup::Sandbox,
        ] {
            self.deliver_to(group, SysCall::BeforeSimulation, &[]);
        }
        self.removals.note_start(&self.scene.borrow());
        self.scene.borrow_mut().stop_joint_motions();
        self.scene.borrow_mut().store_initial_state();
        for script in self.scripts_in(ScriptGroup::Simulation).iter() {
            self.reset(script);
        }
        if let Some(main) = self.scripts.detached(ScriptType::Main) {
            self.reset(&main);
        }
        if let Some(dynamics) = self.dynamics.borrow_mut().as_mut() {
            dynamics.reset();
        }
        self.warn_of_unusual_settings();
        self.clock.reset();
        self.restart_real_time();
        self.log_status(status::STARTED);
    }

    /// Real time continues from now, ignoring the time while stopped or paused.
    fn restart_real_time(&self) {
        let wall = self.clock.wall_seconds() * self.scene.borrow().settings().real_time_factor;
        self.clock.restart_real_time(wall);
    }

    fn warn_of_unusual_settings(&self) {
        if self.scene.borrow().settings().time_step != 0.05 {
            let text =
                "Detected non-default settings (time steps and/or dyn. engine global settings).";
            self.log(verbosity::SCRIPT_WARNINGS, text);
        }
    }

    fn resume(self: &Rc<Self>) {
        self.notify(SysCall::Resume);
        self.clock.set_state(SimulationState::FirstAfterPause);
        self.restart_real_time();
        self.log_status(status::RESUMED);
    }

    /// Asks for a pause; refused when not running or when a stop is pending.
    pub fn pause(&self) {
        self.clock.request_pause();
    }

    /// Starts or resumes the simulation for that many steps, and pauses it.
    pub fn step_and_pause(self: &Rc<Self>, steps: u64) {
        self.start();
        self.clock.pause_after(steps);
    }

    /// Starts or resumes the simulation for as long as it lasts, also where a pause was asked for that has not come yet.
    pub fn play(self: &Rc<Self>) {
        self.clock.cancel_pause_after();
        self.clock.cancel_pause();
        self.start();
    }

    /// Runs so many times as fast as the wall clock from now on; as fast as possible if that is 0.
    pub fn set_pace(&self, factor: f64) {
        self.scene
            .borrow_mut()
            .modify_settings(|settings| settings.set_pace(factor));
        self.restart_real_time();
    }

    /// Asks for the end of the run as a person does, who does not see that a pause has begun: a script's request would wait until the
    /// simulation resumes (spec: simulation 2).
    pub fn stop_in_place_of_pause(self: &Rc<Self>) {
        self.clock.cancel_begun_pause();
        self.stop();
    }

    /// Asks for the end of the run; a paused one resumes for its last steps.
    pub fn stop(self: &Rc<Self>) {
        match self.clock.state() {
            SimulationState::Stopped => {}
            SimulationState::Paused => {
                self.clock.request_stop();
                self.resume();
            }
            _ => self.clock.request_stop(),
        }
    }

    /// The stop procedure (spec: simulation 5).
    fn finish(self: &Rc<Self>) {
        self.notify_plugins(Moment::SimulationAboutToEnd, [0; 4]);
        if let Some(main) = self.scripts.detached(ScriptType::Main) {
            self.reset(&main);
        }
        for script in self.scripts_in(ScriptGroup::Simulation).iter() {
            self.reset(script);
        }
        self.clock.set_state(SimulationState::Stopped);
        self.remove_new_objects();
        if let Some(dynamics) = self.dynamics.borrow_mut().as_mut() {
            dynamics.reset();
        }
        self.scene.borrow_mut().stop_joint_motions();
        self.scene.borrow_mut().collision_objects_mut().reset(false);
        self.scene.borrow_mut().distance_objects_mut().reset(false);
        self.scene.borrow_mut().restore_initial_state();
        for group in [
            ScriptGroup::Customization,
            ScriptGroup::AddOn,
            ScriptGroup::Sandbox,
        ] {
            self.deliver_to(group, SysCall::AfterSimulation, &[]);
        }
        self.restart_failed_customization_scripts();
        self.close_consoles();
        self.run_hooks(|hooks| hooks.end_of_simulation);
        self.notify_plugins(Moment::SimulationEnded, [0; 4]);
        self.log_status(status::STOPPED);
    }

    fn restart_failed_customization_scripts(self: &Rc<Self>) {
        for script in self.scripts_in(ScriptGroup::Customization).iter() {
            let wants = script.object.is_some_and(|handle| {
                self.scene
                    .borrow()
                    .object(handle)
                    .and_then(|o| o.script())
                    .is_ok_and(|s| s.reset_after_sim_error)
            });
            if wants && script.state() & state::ERROR != 0 {
                self.reset(script);
                self.deliver(script, SysCall::Init, &[]);
            }
        }
    }
}
