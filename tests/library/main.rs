//! The library as programs in Rust use it.

mod determinism;
mod legacy_remote_api;
mod lines;
mod old_scenes;
mod old_scripts;
mod own_module;
mod permissions;
mod playback;
mod real_scenes;
mod saving;
mod sensing;
mod serial;
mod snapshots;
mod subprocess;
mod wrong_arguments;

/// As programs declare it whose simulators can be brought back.
#[global_allocator]
static ALLOCATOR: swanilda::Allocator = swanilda::Allocator;
