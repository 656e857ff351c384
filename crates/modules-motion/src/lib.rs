//! Modules for motion: inverse kinematics and motion planning.

pub mod sim_ik;
pub mod sim_ompl;

use script::{ApiError, ApiFn, ApiResult as Result, Cx, Module, functions};
