//! Modules for motion: inverse kinematics, motion planning, soft things, pieces of MuJoCo's model.

pub mod sim_ik;
pub mod sim_mujoco;
pub mod sim_ompl;
pub mod sim_soft;

use script::{ApiError, ApiFn, ApiResult as Result, Cx, Module, functions};
