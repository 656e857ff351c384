//! Numbered parameters of objects and of physics engines.

pub(in crate::scene) mod display;
pub mod engine;
pub mod engine_blocks;
pub(in crate::scene) mod engine_values;
pub(in crate::scene) mod joint;
pub(in crate::scene) mod kind;
pub(in crate::scene) mod object;
pub(in crate::scene) mod shape;
