//! `simROS`: a node of ROS 1, without an installation of ROS (spec: ros 4, ros 5).
//!
//! Types come from `crates/ros-interfaces`, the protocols from `crates/ros1`. One node per simulator; it is made by the first function that
//! needs it, and needs a master then. Callbacks run at the start of each iteration of the loop, or while a script waits for an answer.

mod images;
mod network;
mod node;
mod parameters;
mod services;
mod topics;

use super::{ApiError, ApiFn, Cx, Module, Result, functions, ros_values};
use script::Hooks;

/// The module `simROS`.
pub static MODULE: Module = Module {
    about: "A node of ROS 1: topics, services, parameters, transforms, images. A master is needed, but no installation of ROS.",
    functions: &[
        ("Topics", topics::FUNCTIONS),
        ("Images", images::FUNCTIONS),
        ("Services", services::FUNCTIONS),
        ("Parameters", parameters::FUNCTIONS),
        ("Node", node::FUNCTIONS),
    ],
    hooks: Hooks {
        start_of_iteration: Some(node::start_of_iteration),
        ..Hooks::NONE
    },
    plugin_errors: true,
    ..Module::new("simROS")
};

fn failed(error: &network::Failure) -> ApiError {
    ApiError::Other(format!("ROS: {error}"))
}
