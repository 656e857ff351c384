//! Swanilda: a headless robot simulator that runs CoppeliaSim's Lua scripts and scenes unchanged.

pub mod api;
pub mod cli;
pub mod docs;
mod dynamics;
mod format;
mod ik;
mod io;
mod modules;
mod perception;
mod permissions;
mod plugin;
pub mod scene;
pub mod script;
mod simulator;
pub mod testing;
mod ui;
mod view;
pub(crate) mod wire;

pub use format::scene_file::SceneFile;
/// The library for Lua modules in Rust, see [`Simulator::builder`].
pub use mlua;
pub use perception::vision::{Channels, Picture};
pub use permissions::{Denied, HostRule, Permissions};
pub use script::{
    Console, EmbeddedScript, Limits, LogLine, Options, PythonHost, RosOptions, ScriptCalls, Silent, SimulationState,
    VideoFailure, VideoOptions, VideoView,
};
pub use simulator::{
    ApiFunction, Builder, Caller, Error, ModuleMember, NativeScript, NativeScriptFactory, Progress, RunLimits,
    RunObserver, RunTotals, ScriptKind, ScriptRef, Simulator,
};
pub use view::Viewer;
