//! Swanilda: a headless robot simulator that runs CoppeliaSim's Lua scripts and scenes unchanged.

pub mod api;
pub mod cli;
pub mod docs;
mod dynamics;
mod format;
mod io;
mod modules;
pub mod scene;
pub mod script;
mod simulator;
pub mod testing;
pub(crate) mod wire;

pub use format::scene_file::SceneFile;
pub use script::{Console, Limits, LogLine, Options, Silent, SimulationState};
pub use simulator::{Error, Onlooker, RunLimits, RunTotals, ScriptKind, ScriptRef, Simulator};
