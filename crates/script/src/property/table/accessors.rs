//! The accessors of the files in `types`, by the part of a class that they belong to.

use std::collections::HashMap;

use super::super::access::Accessor;
use super::super::{
    app, colour, display, dummy, engine, force_sensor, joint, mesh, model_hash, object,
    proximity_sensor, scene, script, shape, view,
};

/// By part and name.
pub type Accessors = HashMap<(&'static str, &'static str), &'static Accessor>;

/// The accessors of the files, by part.
const FILES: &[(&str, &[Accessor])] = &[
    ("app", app::APP),
    ("app", app::VERBOSITY_WORDS),
    ("app", app::PATHS),
    ("app", app::RANDOM),
    ("dynamics", engine::SCENE),
    ("material", engine::MATERIAL),
    ("joint", engine::JOINT),
    ("dummy", engine::DUMMY),
    ("simulation", scene::SIMULATION),
    ("simulation", scene::SIMULATION_SETTINGS),
    ("environment", scene::ENVIRONMENT),
    ("container", scene::CONTAINER),
    ("environment", scene::IDENTITY),
    ("dynamics", scene::DYNAMICS),
    ("dynamics", scene::PHYSICS),
    ("object", object::OWN),
    ("object", object::PLACED),
    ("object", object::FLAGS),
    ("object", object::FLAG_SETS),
    ("object", object::MOVEMENT),
    ("object", object::MOVEMENT_FLAGS),
    ("object", model_hash::MODEL_HASH),
    ("script", script::SCRIPT),
    ("scriptObject", script::SCRIPT_OBJECT),
    ("dummy", dummy::DUMMY),
    ("dummy", dummy::LINK),
    ("colour", colour::COLOUR),
    ("rayColour", colour::RAY_COLOUR),
    ("lightColour", colour::LIGHT_COLOUR),
    ("mesh", mesh::MESH),
    ("mesh", mesh::TEXTURE),
    ("proximitySensor", proximity_sensor::PROXIMITY_SENSOR),
    ("volume", proximity_sensor::VOLUME),
    ("viewable", view::VIEWABLE),
    ("visionSensor", view::VISION_SENSOR),
    ("camera", view::CAMERA),
    ("camera", view::TRACKED),
    ("forceSensor", force_sensor::FORCE_SENSOR),
    ("light", display::LIGHT),
    ("graph", display::GRAPH),
    ("ocTree", display::OCTREE),
    ("pointCloud", display::POINT_CLOUD),
    ("shape", shape::SHAPE),
    ("shape", shape::APPLY),
    ("mass", shape::MASS),
    ("joint", joint::JOINT),
    ("joint", joint::CONTROL),
    ("joint", joint::STATE),
];

/// The accessor of each property that has one, by its part and name.
pub fn accessors() -> Accessors {
    FILES
        .iter()
        .flat_map(|&(part, rows)| rows.iter().map(move |row| ((part, row.name), row)))
        .collect()
}
