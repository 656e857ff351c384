//! The descriptions of the common packages, which are part of the library.

use crate::{Generation, Interface, parse};

/// Names and texts of packages.
type Packages = &'static [(&'static str, &'static str)];

macro_rules! packages {
    ($folder:literal: $($package:literal),* $(,)?) => {
        &[$(($package, include_str!(concat!("../../descriptions/", $folder, "/", $package, ".txt")))),*]
    };
}

const ROS1: Packages = packages! { "ros1":
    "actionlib_msgs", "beginner_tutorials", "control_msgs", "diagnostic_msgs", "dynamic_reconfigure",
    "geometry_msgs", "nav_msgs", "roscpp", "roscpp_tutorials", "rosgraph_msgs", "rospy_tutorials",
    "sensor_msgs", "shape_msgs", "std_msgs", "std_srvs", "stereo_msgs", "tf", "tf2_msgs", "trajectory_msgs",
    "turtlesim", "visualization_msgs",
};

const ROS2: Packages = packages! { "ros2":
    "action_msgs", "action_tutorials_interfaces", "actionlib_msgs", "builtin_interfaces", "control_msgs",
    "diagnostic_msgs", "example_interfaces", "geometry_msgs", "lifecycle_msgs", "nav_msgs", "rcl_interfaces",
    "rmw_dds_common", "rosgraph_msgs", "sensor_msgs", "service_msgs", "shape_msgs", "simulation_interfaces", "statistics_msgs",
    "std_msgs", "std_srvs", "stereo_msgs", "tf2_msgs", "trajectory_msgs", "turtlesim",
    "type_description_interfaces", "unique_identifier_msgs", "visualization_msgs",
};

/// All types that are built in.
pub(super) fn interfaces(generation: Generation) -> Vec<Interface> {
    let packages = match generation {
        Generation::Ros1 => ROS1,
        Generation::Ros2 => ROS2,
    };
    let parse = |&(package, text): &(&str, &str)| {
        parse::parse_package(package, text, generation).expect("tests read every description")
    };
    packages.iter().flat_map(parse).collect()
}
