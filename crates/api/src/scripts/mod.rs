//! `sim.*`: scripts, threads, time, the simulation, events.

pub(in crate::api) mod events;
pub(in crate::api) mod global;
pub(in crate::api) mod script;
pub(in crate::api) mod simulation;
pub(in crate::api) mod thread;
pub(in crate::api) mod time;
