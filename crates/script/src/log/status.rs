//! Log messages of the simulator about its own state, in CoppeliaSim's words.

pub const STARTED: &str = "Simulation started.";
pub const PAUSED: &str = "Simulation paused.";
pub const RESUMED: &str = "Simulation resumed.";
pub const STOPPED: &str = "Simulation stopped.";
