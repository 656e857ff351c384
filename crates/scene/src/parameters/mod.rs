//! Numbered parameters of objects and of physics engines.

pub(crate) mod display;
pub mod engine;
pub mod engine_blocks;
pub(crate) mod engine_values;
pub(crate) mod joint;
pub(crate) mod kind;
pub mod mujoco;
pub(crate) mod object;
pub(crate) mod shape;
