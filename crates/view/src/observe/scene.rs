//! What an observer looks at, and the description of the scene as a whole.

use std::path::Path;

use serde_json::{Value, json};

use perception::vision::views_background;
use scene::Scene;
use scene::appearance::environment::{Fog, FogType};
use script::{SimulationState, Situation};
use simulator::Simulator;

/// The mode of what is recorded.
pub(crate) const RECORDING: &str = "recording";

/// A simulator as pages are to see it.
pub(crate) struct Source<'a> {
    pub now: Situation<'a>,
    /// Pages may only read.
    pub is_read_only: bool,
    /// What is shown is being recorded or viewed live.
    pub mode: &'static str,
    /// Of a capture that is played.
    pub played: Option<Played>,
    /// What can be undone: members of the scene; null where nothing can.
    pub edits: Value,
    /// Whether pages debug scripts.
    pub has_debugger: bool,
}

/// The moment of a capture that is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Played {
    /// Its place on the timeline.
    pub frame: usize,
    /// Whether time goes on.
    pub is_playing: bool,
    /// Beside the wall clock; 0 for as fast as possible.
    pub speed: f64,
    /// Whether pages may go on from here.
    pub goes_on: bool,
}

impl<'a> Source<'a> {
    /// A simulator as it is now, with its scene.
    pub(crate) fn of(sim: &Simulator, scene: &'a Scene) -> Self {
        Self {
            now: sim.situation(scene),
            is_read_only: false,
            mode: "live",
            played: None,
            edits: Value::Null,
            has_debugger: false,
        }
    }

    /// The name of the scene's file.
    pub(crate) fn name(&self) -> String {
        let name = Path::new(&self.now.scene.settings().path).file_name();
        name.map_or_else(
            || "untitled".to_owned(),
            |name| name.to_string_lossy().into_owned(),
        )
    }

    /// The scene as JSON.
    pub(super) fn describe(&self) -> String {
        let settings = self.now.scene.settings();
        let name = self.name();
        // Recordings are passed on, so they do not contain the path of the scene file.
        let path = if self.mode == RECORDING {
            &name
        } else {
            &settings.path
        };
        let mut scene = json!({
            "name": name,
            "path": path,
            "state": state_name(self.now.state),
            "time": self.now.time,
            "steps": self.now.steps,
            "timeStep": settings.time_step,
            "realTime": settings.real_time,
            "speed": if settings.real_time { settings.real_time_factor } else { 0.0 },
            "visibilityLayers": settings.visibility_layers.bits(),
            "background": views_background(self.now.scene),
            "ambient": settings.environment.ambient_light,
            "fog": fog(&settings.environment.fog),
            "mode": self.mode,
            "readOnly": self.is_read_only,
            "errors": self.now.errors,
        });
        if self.has_debugger {
            scene["debugger"] = true.into();
        }
        if let Some(hash) = self.now.state_hash {
            scene["hash"] = format!("{hash:016x}").into();
        }
        if let Value::Object(edits) = &self.edits {
            for (name, value) in edits {
                scene[name] = value.clone();
            }
        }
        if let Some(played) = &self.played {
            played.describe(&mut scene);
        }
        scene.to_string()
    }
}

impl Played {
    fn describe(&self, scene: &mut Value) {
        scene["mode"] = "capture".into();
        scene["readOnly"] = true.into();
        scene["frame"] = self.frame.into();
        scene["playing"] = self.is_playing.into();
        scene["realTime"] = (self.speed > 0.0).into();
        scene["speed"] = self.speed.into();
        scene["goesOn"] = self.goes_on.into();
    }
}

fn state_name(state: SimulationState) -> &'static str {
    match state {
        SimulationState::Stopped => "stopped",
        SimulationState::Paused => "paused",
        _ => "running",
    }
}

fn fog(fog: &Fog) -> Value {
    if !fog.enabled {
        return Value::Null;
    }
    let kind = match fog.fog_type {
        FogType::EXPONENTIAL => "exponential",
        FogType::EXPONENTIAL_SQUARED => "exponentialSquared",
        _ => "linear",
    };
    json!({
        "type": kind, "color": fog.colour.unwrap_or_default(), "start": fog.start, "end": fog.end, "density": fog.density,
    })
}
