//! Modules for motion: inverse kinematics, motion planning, ropes.

pub mod sim_ik;
pub mod sim_ompl;
pub mod sim_soft;

use script::{ApiError, ApiFn, ApiResult as Result, Cx, Module, functions};
