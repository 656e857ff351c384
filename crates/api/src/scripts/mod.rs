//! `sim.*`: scripts, threads, time, the simulation, events.

pub(crate) mod events;
pub(crate) mod global;
pub(crate) mod help;
pub(crate) mod script;
pub(crate) mod simulation;
pub(crate) mod thread;
pub(crate) mod time;
