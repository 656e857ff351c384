//! Log messages of the simulator about its own state, in CoppeliaSim's words.

/// When a simulation starts.
pub const STARTED: &str = "Simulation started.";
/// When a simulation pauses.
pub const PAUSED: &str = "Simulation paused.";
/// When a paused simulation continues.
pub const RESUMED: &str = "Simulation resumed.";
/// When a simulation has ended.
pub const STOPPED: &str = "Simulation stopped.";
