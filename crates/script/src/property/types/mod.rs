//! Accessors of the properties, by what they belong to: the application, the scene, objects of a type, meshes, parameters of engines.

use super::{
    Color, IntPair, Long, PoseArray, PropertyTarget, PropertyValue, Quaternion, Text, Vector3,
    access, table,
};

pub(super) mod app;
pub(super) mod colour;
pub(super) mod display;
pub(super) mod dummy;
pub(super) mod engine;
pub(super) mod force_sensor;
pub(super) mod joint;
pub(super) mod mesh;
pub(super) mod object;
pub(super) mod proximity_sensor;
pub(super) mod scene;
pub(super) mod script;
pub(super) mod shape;
pub(super) mod view;
