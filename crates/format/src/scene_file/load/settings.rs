//! Settings of a scene: simulation, physics, environment (spec: scene-files 9).

use super::custom_data;
use super::material::load_all;
use crate::ttt::chunks::{self, Dynamics, ModuleSettings, Simulation};
use crate::ttt::{File, Text};
use scene::appearance::environment::{Environment, Fog, FogType};
use scene::parameters::engine::{Engine, SelectedEngine};
use scene::{Calculations, DynamicsSettings, Layers, Scene, SceneResult, Settings};

/// Simulation steps of the presets of old files, seconds; the next number means a step of one's own.
const STEP_PRESETS: [f64; 5] = [0.2, 0.1, 0.05, 0.025, 0.01];
/// The preset of the physics that means settings of one's own.
const CUSTOM: i32 = 5;
const MICROSECOND: f64 = 1e-6;
/// Bits of the environment.
const FOG: u8 = 0x10;
const LOCKED: u8 = 0x20;

pub(super) fn apply(scene: &mut Scene, file: &File) -> SceneResult<()> {
    let contents = &file.contents;
    scene.modify_settings(|settings| {
        if let Some(chunk) = &contents.simulation {
            simulation(settings, chunk);
        }
        if let Some(chunk) = &contents.dynamics {
            dynamics(&mut settings.dynamics, chunk);
        }
        if let Some(chunk) = &contents.environment {
            environment(settings, chunk);
        }
        if let Some(chunk) = &contents.module_settings {
            settings.calculations = calculations(chunk);
        }
    });
    let mut data = std::mem::take(&mut scene.custom_data);
    custom_data::fill(
        &mut data,
        contents.custom_data.as_ref(),
        contents.old_custom_data.as_ref(),
        "_oldSceneCustomData_",
    );
    scene.custom_data = data;
    Ok(())
}

/// Calculations that old versions could switch off.
fn calculations(chunk: &ModuleSettings) -> Calculations {
    let is_on = |switches: Option<u8>, bit: u8| switches.is_none_or(|switches| switches & bit != 0);
    Calculations {
        collision: is_on(chunk.va3, 0x2),
        distance: is_on(chunk.va3, 0x4),
        proximity_sensors: is_on(chunk.va5, 0x1),
        // The bit switches off.
        paths: chunk.va3.is_none_or(|switches| switches & 0x10 == 0),
        inverse_kinematics: is_on(chunk.va2, 0x8),
    }
}

fn simulation(settings: &mut Settings, chunk: &Simulation) {
    settings.time_step = time_step(chunk)
        .filter(|dt| dt.is_finite())
        .unwrap_or(0.05)
        .clamp(0.0001, 10.0);
    settings.steps_per_rendering = chunk.passes_per_frame.unwrap_or(1).max(1).into();
    let switches = chunk.switches.unwrap_or(0);
    settings.real_time = switches & 0x1 != 0;
    settings.pause_at_time = switches & 0x4 != 0;
    settings.pause_at_error = switches & 0x8 != 0;
    settings.remove_new_objects_at_end = switches & 0x80 == 0;
    settings.real_time_factor = chunk
        .rt_coef
        .or(chunk.old_rt_coef.map(f64::from))
        .unwrap_or(1.0);
    let old_pause = chunk
        .pause_us
        .map(|us| us as f64 * MICROSECOND)
        .or(chunk.old_pause.map(f64::from));
    settings.time_to_pause = chunk
        .pause_time
        .or(old_pause)
        .unwrap_or(settings.time_to_pause);
}

/// Seconds; before 4.4 a preset stands before the explicit step.
fn time_step(chunk: &Simulation) -> Option<f64> {
    let preset = || {
        STEP_PRESETS
            .get(usize::try_from(chunk.old_preset?).ok()?)
            .copied()
    };
    let explicit = || {
        chunk
            .dt_us
            .map(|us| us as f64 * MICROSECOND)
            .or(chunk.old_dt.map(f64::from))
    };
    chunk.dt.or_else(preset).or_else(explicit)
}

fn dynamics(settings: &mut DynamicsSettings, chunk: &Dynamics) {
    let old = chunk
        .old_engine
        .or(chunk.oldest_engine)
        .map(|(engine, gravity, mode)| (engine, gravity.map(f64::from), mode + 1));
    let (engine, gravity, preset) = chunk
        .engine
        .or(old)
        .unwrap_or((0, [0.0, 0.0, -9.81], CUSTOM));
    settings.engine = SelectedEngine {
        engine: Engine::from_number(i64::from(engine).clamp(0, 4)).unwrap_or_default(),
        version: chunk.engine_version.unwrap_or(0).into(),
    };
    if gravity.iter().all(|g| g.is_finite()) {
        settings.gravity = gravity.map(numbers::single);
    }
    settings.enabled = chunk.switches.unwrap_or(1) & 0x1 != 0;
    settings.show_contact_points = chunk.switches.unwrap_or(0) & 0x2 != 0;
    let blocks = [
        &chunk.bullet,
        &chunk.ode,
        &chunk.vortex,
        &chunk.newton,
        &chunk.mujoco,
    ];
    if preset >= CUSTOM {
        load_all(settings, blocks);
    }
    let own_step = blocks
        .get(usize::try_from(engine).unwrap_or_default())
        .and_then(|block| block.as_ref()?.reals.first().copied());
    let step = chunk
        .step_size
        .or(own_step.filter(|_| preset >= CUSTOM))
        .unwrap_or(0.005);
    settings.step = if step.is_finite() && step > 0.0 {
        step
    } else {
        0.005
    };
}

fn environment(settings: &mut Settings, chunk: &chunks::Environment) {
    settings.visibility_layers = chunk
        .active_layers
        .map_or(settings.visibility_layers, Layers::from_bits_retain);
    settings.acknowledgment = chunk
        .acknowledgment
        .as_ref()
        .map(Text::decode)
        .unwrap_or_default();
    let switches = chunk.switches.unwrap_or(0);
    settings.locked = switches & LOCKED != 0;
    let (fog_type, [start, density]) = chunk.fog.unwrap_or_default();
    let fog = Fog {
        enabled: switches & FOG != 0,
        fog_type: FogType(fog_type),
        start,
        end: chunk.fog_end,
        density,
        colour: chunk.fog_colour,
    };
    let default = Environment::default();
    let [largest, relative] = default.triangle_sizes;
    settings.environment = Environment {
        fog,
        ambient_light: ambient_light(chunk).unwrap_or(default.ambient_light),
        background: chunk.bg_up.map(|up| [up, chunk.bg_down.unwrap_or(up)]),
        display: switches & !(LOCKED | FOG),
        triangle_sizes: [
            chunk.max_tri_size.unwrap_or(largest),
            chunk.min_rel_tri.unwrap_or(relative),
        ],
        extension_string: chunk
            .extension_string
            .as_ref()
            .map(Text::decode)
            .unwrap_or_default(),
    };
}

/// Before 3.2 it was half as bright.
fn ambient_light(chunk: &chunks::Environment) -> Option<[f32; 3]> {
    chunk.ambient.or(chunk
        .old_ambient
        .map(|light| light.map(|c| (2.0 * c).min(0.4))))
}
