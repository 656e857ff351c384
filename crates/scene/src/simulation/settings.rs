//! Settings of a scene, as in CoppeliaSim's simulation dialog.

use crate::appearance::environment::Environment;
use crate::parameters::engine::SelectedEngine;
use crate::{InertValues, Layers};

/// Scene-wide settings. Times in seconds.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Simulation step, 0.0001 to 10 s.
    pub time_step: f64,
    /// The simulation is slowed down to real time.
    pub real_time: bool,
    /// Simulated seconds per second of real time, where it is slowed down.
    pub real_time_factor: f64,
    /// Objects that were made during a simulation are removed at its end.
    pub remove_new_objects_at_end: bool,
    /// A script error pauses the simulation.
    pub pause_at_error: bool,
    /// The simulation pauses at `time_to_pause`.
    pub pause_at_time: bool,
    /// Simulation time at which it pauses, seconds.
    pub time_to_pause: f64,
    /// Settings of the physics.
    pub dynamics: DynamicsSettings,
    /// The layers that are shown.
    pub visibility_layers: Layers,
    /// Where the file of the scene is; empty without a file.
    pub path: String,
    /// Simulation steps per drawn image. Kept for scripts, without effect.
    pub steps_per_rendering: i64,
    /// Authors and licence, as the scene states them.
    pub acknowledgment: String,
    /// The scene may not be saved.
    pub locked: bool,
    /// Background, ambient light and fog.
    pub environment: Environment,
    /// Which calculations are on.
    pub calculations: Calculations,
}

impl Settings {
    /// Sets the simulation step: the nearest one that there is.
    pub fn set_time_step(&mut self, step: f64) {
        if !step.is_nan() {
            self.time_step = step.clamp(0.0001, 10.0);
        }
    }

    /// Sets the desired sub-step of the physics, at most the simulation step.
    pub fn set_physics_step(&mut self, step: f64) {
        if !step.is_nan() {
            self.dynamics.step = step.clamp(0.00001, self.time_step.max(0.00001));
        }
    }

    /// Sets how many simulation steps there are to an image, at least one.
    pub fn set_steps_per_rendering(&mut self, steps: i64) {
        self.steps_per_rendering = steps.max(1);
    }

    /// Runs so many times as fast as the wall clock; as fast as possible if that is 0.
    pub fn set_pace(&mut self, factor: f64) {
        self.real_time = factor > 0.0;
        if self.real_time {
            self.real_time_factor = factor;
        }
    }
}

/// Which calculations are not switched off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Calculations {
    /// Collision detection.
    pub collision: bool,
    /// Distance measurement.
    pub distance: bool,
    /// Proximity sensors.
    pub proximity_sensors: bool,
    /// Motion along paths of V-REP.
    pub paths: bool,
    /// Groups of inverse kinematics of V-REP.
    pub inverse_kinematics: bool,
}

impl Default for Calculations {
    fn default() -> Self {
        Self {
            collision: true,
            distance: true,
            proximity_sensors: true,
            paths: true,
            inverse_kinematics: true,
        }
    }
}

/// Settings of the physics.
#[derive(Debug, Clone, PartialEq)]
pub struct DynamicsSettings {
    /// The physics runs.
    pub enabled: bool,
    /// Wished length of a sub-step, seconds; the real one divides the simulation step.
    pub step: f64,
    /// m/s^2, world axes. Kept in 32 bits as the original does, so that it reads back the same.
    pub gravity: [f32; 3],
    /// Rapier does the work; this decides which parameters it reads.
    pub engine: SelectedEngine,
    /// Contact points are displayed.
    pub show_contact_points: bool,
    /// Parameters of physics engines, as they were set.
    pub engine_values: InertValues,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            time_step: 0.05,
            real_time: false,
            real_time_factor: 1.0,
            remove_new_objects_at_end: true,
            pause_at_error: true,
            pause_at_time: false,
            time_to_pause: 3600.0,
            dynamics: DynamicsSettings::default(),
            visibility_layers: Layers::SHOWN_BY_DEFAULT,
            path: String::new(),
            steps_per_rendering: 1,
            acknowledgment: String::new(),
            locked: false,
            environment: Environment::default(),
            calculations: Calculations::default(),
        }
    }
}

impl Default for DynamicsSettings {
    fn default() -> Self {
        Self {
            enabled: true,
            step: 0.005,
            gravity: [0.0, 0.0, -9.81],
            engine: SelectedEngine::default(),
            show_contact_points: false,
            engine_values: InertValues::default(),
        }
    }
}

impl DynamicsSettings {
    /// How many sub-steps make up a simulation step of `time_step` seconds.
    pub fn sub_steps(&self, time_step: f64) -> u32 {
        (time_step / self.step + 0.5).floor().max(1.0) as u32
    }
}
