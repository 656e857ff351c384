//! A debugger of running simulations: an adapter for clients that speak the Debug Adapter Protocol, over a connection or in this process.
//!
//! Lua scripts stop at traps in their bytecode (`script::Debugger`); this crate decides where, and answers the client. While code
//! stands still, so do all scripts, the physics, the simulation time and the clients of the simulator, since one thread owns them all.
#![allow(
    clippy::disallowed_methods,
    reason = "what a person waits for is no part of the simulation"
)]

mod breakpoints;
mod client;
mod data;
mod framing;
mod link;
mod objects;
mod references;
mod request;
mod session;
mod sources;
mod stepping;
mod watch;

pub use client::{Client, Incoming};
pub use link::{Link, Wake};
pub use session::{Ending, Launch, Position, Session, Travel};
pub use watch::{Cause, Watch};
