//! Properties of the scene: simulation, environment, objects, dynamics.

use super::access::{Accessor, subject_properties};
use super::{Color, Vector3};
use crate::error::ApiError;
use crate::host::Sim;
use crate::random::Random;
use scene::parameters::engine::SelectedEngine;
use scene::{Counters, Handle, Layers};

/// Letters and digits of the identifier of a scene.
const SCENE_UID_LETTERS: usize = 16;

impl Sim {
    fn counters(&self) -> Counters {
        self.scene.borrow().journal().counters()
    }

    /// Distinguishes this scene also from those of other simulators with other seeds.
    fn scene_uid_text(&self) -> String {
        Random::new(
            self.options
                .seed
                .wrapping_add(numbers::low_u32(self.scene_uid())),
        )
        .string(SCENE_UID_LETTERS)
    }
}

/// Rows of properties that are scene settings.
macro_rules! settings {
    ($($name:literal: $ty:ty, |$s:ident| $get:expr, |$w:ident, $v:ident| $set:expr;)*) => { subject_properties! { $(
        $name: $ty, |subject| {
            let scene = subject.sim.scene.borrow();
            let $s = scene.settings();
            $get
        }, |subject, $v| subject.sim.scene.borrow_mut().modify_settings(|$w| { $set; });
    )* } };
}

pub(in crate::property) const SIMULATION: &[Accessor] = subject_properties! {
    "realtimeSimulation": bool, |s| s.sim.scene.borrow().settings().real_time, |s, on| {
        s.sim.change_while_stopped(|settings| settings.real_time = on);
    };
    "stepsPerRendering": i64, |s| s.sim.scene.borrow().settings().steps_per_rendering,
        |s, steps| {
            s.sim.change_while_stopped(|settings| settings.set_steps_per_rendering(steps));
        };
    "simulationTime": f64, |s| s.sim.clock.time();
    "timeStep": f64, |s| s.sim.scene.borrow().settings().time_step, |s, step| {
        s.sim.change_while_stopped(|settings| settings.set_time_step(step));
    };
    "stepCount": i64, |s| s.sim.clock.steps().cast_signed();
    "simulationState": i64, |s| s.sim.clock.state() as i64;
};

pub(in crate::property) const SIMULATION_SETTINGS: &[Accessor] = settings! {
    "removeNewObjectsAtEnd": bool, |s| s.remove_new_objects_at_end, |s, on| s.remove_new_objects_at_end = on;
    "pauseSimulationAtTime": bool, |s| s.pause_at_time, |s, on| s.pause_at_time = on;
    "pauseSimulationAtError": bool, |s| s.pause_at_error, |s, on| s.pause_at_error = on;
    "timeToPause": f64, |s| s.time_to_pause, |s, time| s.time_to_pause = time;
    "realtimeModifier": f64, |s| s.real_time_factor, |s, factor| s.real_time_factor = factor.clamp(0.001, 100.0);
};

pub(in crate::property) const ENVIRONMENT: &[Accessor] = settings! {
    "visibilityLayers": i64, |s| s.visibility_layers.number(),
        |s, layers| s.visibility_layers = Layers::from_number(layers);
    "scenePath": String, |s| s.path.clone(), |s, path| s.path = path;
    "ambientLight": Color, |s| Color::from_f32(s.environment.ambient_light),
        |s, light| s.environment.ambient_light = light.to_f32();
    "acknowledgment": String, |s| s.acknowledgment.clone(), |s, text| s.acknowledgment = text;
};

pub(in crate::property) const IDENTITY: &[Accessor] = subject_properties! {
    "sceneUid": i64, |s| s.sim.scene_uid();
    "sceneIsLocked": bool, |s| s.sim.scene.borrow().settings().locked;
    "sceneUidString": String, |s| s.sim.scene_uid_text();
};

/// Settings of the physics that change only while the simulation is stopped.
pub(in crate::property) const PHYSICS: &[Accessor] = subject_properties! {
    "dynamicsEngine": Vec<i64>, |s| s.sim.scene.borrow().settings().dynamics.engine.numbers().to_vec(), |s, engine| {
        let [kind, version, ..] = engine[..] else { return Err(ApiError::PropertyNotWritable) };
        let engine = SelectedEngine::from_numbers(kind, version)?;
        s.sim.change_while_stopped(|settings| settings.dynamics.engine = engine);
    };
    "dynamicsStepSize": f64, |s| s.sim.scene.borrow().settings().dynamics.step, |s, step| {
        s.sim.change_while_stopped(|settings| settings.set_physics_step(step));
    };
};

pub(in crate::property) const CONTAINER: &[Accessor] = subject_properties! {
    "objectCreationCounter": i64, |s| s.sim.counters().creations;
    "objectDestructionCounter": i64, |s| s.sim.counters().destructions;
    "hierarchyChangeCounter": i64, |s| s.sim.counters().hierarchy;
    "objectHandles": Vec<i64>, |s| s.sim.scene.borrow().objects().map(|object| object.handle().raw()).collect();
    "orphanHandles": Vec<i64>, |s| raw(s.sim.scene.borrow().roots());
    "selectionHandles": Vec<i64>, |s| raw(s.sim.scene.borrow().selection()),
        |s, handles| {
            let handles: Vec<Handle> = handles.into_iter().filter_map(Handle::from_raw).collect();
            s.sim.scene.borrow_mut().select(&handles);
        };
};

pub(in crate::property) const DYNAMICS: &[Accessor] = settings! {
    "dynamicsEnabled": bool, |s| s.dynamics.enabled, |s, on| s.dynamics.enabled = on;
    "showContactPoints": bool, |s| s.dynamics.show_contact_points, |s, on| s.dynamics.show_contact_points = on;
    "gravity": Vector3, |s| Vector3(Color::from_f32(s.dynamics.gravity).0),
        |s, gravity| s.dynamics.gravity = gravity.0.map(numbers::single);
};

fn raw(handles: &[Handle]) -> Vec<i64> {
    handles.iter().map(|handle| handle.raw()).collect()
}
