//! Colours, textures and the environment: what a renderer would show.

pub mod colour;
pub mod environment;
pub mod texture;
pub mod texture_mapping;
