//! Programs of others against Swanilda: the Python files of this folder; and the Python package.
//!
//! Needs python3 with `venv`, and the Python index once: the environment stays in `target/`. Without python3 the tests are skipped,
//! except where `CI` is set.

#![allow(
    clippy::disallowed_methods,
    reason = "tests start programs and look at the environment"
)]

mod agents;
mod capture;
mod debugger;
mod foreign;
mod gltf;
mod library;
mod motion;
mod package;
mod qml;
mod recordings;
mod reports;
mod ros1;
mod ros2;
mod rust_client;
mod server;
mod simzmq;
mod sockets;
mod typed;
mod view;
mod web;
mod zmq;
