//! The chunks of a file as types, one struct per chunk stream (spec: scene-files 4).
//!
//! A field is `None` where its chunk is missing: its meaning is defined by the loader of the scene. Numbers after
//! `bit` count from the least significant one.

mod cloud;
mod graph;
mod legacy;
mod mechanics;
mod object;
mod path;
mod scene;
mod script;
mod sensor;
mod shape;

pub use cloud::*;
pub use graph::*;
pub use legacy::*;
pub use mechanics::*;
pub use object::*;
pub use path::*;
pub use scene::*;
pub use script::*;
pub use sensor::*;
pub use shape::*;
