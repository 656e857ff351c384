//! Swanilda: a headless robot simulator that runs CoppeliaSim's Lua scripts and scenes unchanged.

pub use format::scene_file::SceneFile;
pub use heap::{Allocator, outside};
/// The library for Lua modules in Rust, see [`Simulator::builder`].
pub use mlua;
pub use permissions::{Denied, HostRule, Permissions};
pub use scene;
pub use simulator::{
    ApiFunction, Builder, CacheFolder, Caller, ChangedValue, Channels, Console, EmbeddedScript,
    Error, Limits, LogLine, ModuleMember, NativeScript, NativeScriptFactory, Options, Picture,
    Progress, PythonHost, RosOptions, RunLimits, RunObserver, RunTotals, SceneMut, ScriptCalls,
    ScriptKind, ScriptRef, Silent, SimulationState, Simulator, Snapshot, VideoFailure,
    VideoOptions, VideoView,
};
pub use view::Viewer;
