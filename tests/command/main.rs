//! The command as its users run it. Nothing here uses the library, so that this program is small and quickly linked.

mod bad;
mod batch;
mod bench;
mod c_modules;
mod capture;
mod cli;
mod conformance;
mod debugger;
mod faults;
mod physics;
mod plugins;
mod python;
mod remote_steps;
mod scene_cli;
mod scene_data;
mod search;
mod sockets;
mod testing;
mod view;
