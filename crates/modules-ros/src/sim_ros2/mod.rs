//! `simROS2`: a node of ROS 2, without an installation of ROS (spec: ros 1, ros 2).
//!
//! Types come from `crates/ros-interfaces`, the protocol from `crates/rtps`. One node per simulator; it is made by the first function that
//! needs it. Callbacks run at the start of each iteration of the loop, or while a script waits for an answer.

mod actions;
mod discovery;
mod endpoint;
mod graph;
mod images;
mod interfaces;
mod lockstep;
mod names;
mod node;
mod parameter_services;
mod parameters;
mod qos;
mod robot;
mod rosout;
mod services;
mod times;
mod topics;

use super::ros_values;
use super::{ApiError, ApiFn, Cx, Module, Result, functions};
use script::Hooks;

/// The module `simROS2`.
pub static MODULE: Module = Module {
    about: "A node of ROS 2: topics, services, actions, parameters, transforms, images. No installation of ROS is needed.",
    functions: &[
        ("Topics", topics::FUNCTIONS),
        ("Images", images::FUNCTIONS),
        ("Services", services::FUNCTIONS),
        ("Actions", actions::CLIENT_FUNCTIONS),
        ("Action servers", actions::SERVER_FUNCTIONS),
        ("Parameters", parameters::FUNCTIONS),
        ("Interfaces", interfaces::FUNCTIONS),
        ("Node", times::FUNCTIONS),
    ],
    inner: &[rosout::FUNCTIONS],
    constants: include_str!("constants.tsv"),
    hooks: Hooks {
        start_of_iteration: Some(node::start_of_iteration),
        ..Hooks::NONE
    },
    plugin_errors: true,
    ..Module::new("simROS2")
};

/// The module `remote.ros2`.
pub static REMOTE: Module = Module {
    inner: &[services::ANSWERED_LATER],
    ..Module::new("remote.ros2")
};

/// The module `remote.ros2.lockstep`.
pub static REMOTE_LOCKSTEP: Module = Module {
    inner: &[lockstep::FUNCTIONS],
    ..Module::new("remote.ros2.lockstep")
};

/// The module `remote.ros2.robots`.
pub static REMOTE_ROBOTS: Module = Module {
    inner: &robot::FUNCTIONS,
    ..Module::new("remote.ros2.robots")
};
