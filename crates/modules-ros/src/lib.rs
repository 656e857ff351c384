//! The modules of ROS 1 and ROS 2.

mod ros_compressed;
mod ros_entities;
mod ros_images;
mod ros_values;
#[cfg(feature = "ros1")]
pub mod sim_ros;
#[cfg(feature = "ros2")]
pub mod sim_ros2;

use script::{ApiError, ApiFn, ApiResult as Result, Cx, Module, functions};
